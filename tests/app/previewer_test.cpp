// The previewer as a whole, off-screen; preview_storm has the rest.
#include "app/previewer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/preview_desk.h"

namespace meander {
namespace {

// A picture of one sample a pixel of all that was asked, within a minute.
void await_sample(Previewer& previewer) {
  for (const Timer timer; timer.seconds() < 60 && previewer.spp() < 1;) {
    (void)previewer.update(timer.seconds());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(previewer.spp() == 1);
}

// A previewer that is drawn 1280 x 720, and what is done to it between frames, as often as none.
struct Desktop {
  Offscreen context{1280, 720};
  Previewer previewer{context.functions(), Desk::small(kKnot), options(), 1};

  static PreviewOptions options() {
    PreviewOptions options;
    options.settings.threads = 1;
    options.settings.budget.spp = 1;
    return options;
  }
  void draw() {
    FrameShape shape;
    shape.pixels_wide = 1280;
    shape.pixels_high = 720;
    for (int frame = 0; frame < 6; ++frame) previewer.draw(shape);
  }
  void send(InputKind kind, double x, double y, int code = 0, bool down = false) {
    InputEvent event;
    event.kind = kind;
    event.x = x;
    event.y = y;
    event.code = code;
    event.down = down;
    event.modifiers.control = control;
    previewer.feed(event);
  }
  void drag_from(double x, double y) {
    send(InputKind::move, x, y);
    send(InputKind::button, x, y, 0, true);
    send(InputKind::move, x + 60, y);
    send(InputKind::button, x + 60, y);
  }
  void control_click(double x, double y) {
    control = true;
    send(InputKind::move, x, y);
    send(InputKind::button, x, y, 0, true);
    send(InputKind::button, x, y);
    control = false;
  }
  void press(int code) {
    send(InputKind::key, 0, 0, code, true);
    send(InputKind::key, 0, 0, code);
  }

  bool control = false;
};

}  // namespace

TEST_CASE("an edit before the first frame is in the first picture") {
  const Offscreen context(1, 1);
  PreviewOptions options;
  options.settings.threads = 2;
  options.settings.budget.spp = 1;
  Previewer previewer(context.functions(), Desk::small(kKnot), options, 1);
  previewer.apply("light.key.radiance=0.5");
  await_sample(previewer);
  const Scene& shown = *previewer.pictures().newest()->scene;
  REQUIRE(shown.lights.size() == 2);
  CHECK(std::get<RectangleLight>(shown.lights[1].shape).radiance == Rgb(0.5f));
}

TEST_CASE("a scene is warned of once for as long as there is cause, whichever way it came to be") {
  const Offscreen context(1, 1);
  PreviewOptions options;
  options.settings.threads = 1;
  options.settings.budget.spp = 1;
  Previewer previewer(context.functions(), Desk::small(kKnot), options, 1);
  const auto told = [&] {
    return std::ranges::count(previewer.state().messages, MessageKind::warning, &Message::kind);
  };
  CHECK(told() == 0);
  previewer.apply("material.wax.mean_free_path=1e-7");
  CHECK(told() == 1);
  CHECK(previewer.state().messages.back().text.find("is finite but not accurate") != std::string::npos);
  previewer.apply("light.key.radiance=0.5");
  CHECK(told() == 1);
  previewer.apply("material.wax.mean_free_path=0.1");
  CHECK(told() == 0);
}

TEST_CASE("bodies that overlap are warned of with the first full picture, until they are moved apart") {
  const Offscreen context(1, 1);
  const SceneDocument document = SceneDocument::from_text(
      "[camera]\nlook_from = [0, 0, 6]\nlook_at = [0, 0, 0]\n[film]\nwidth = 16\nheight = 9\n"
      "[[material]]\nname = \"wax\"\nalbedo = 0.5\nmean_free_path = 0.5\n"
      "[[object]]\nname = \"a\"\nshape = \"sphere\"\nmaterial = \"wax\"\n"
      "[[object]]\nname = \"b\"\nshape = \"sphere\"\nmaterial = \"wax\"\ntransform = { translate = [1.5, 0, "
      "0] }\n",
      "two.toml");
  PreviewOptions options;
  options.settings.threads = 1;
  options.settings.budget.spp = 1;
  Previewer previewer(context.functions(), document, options, 1);
  const auto warnings_of_picture = [&] {
    await_sample(previewer);
    return previewer.warnings();
  };
  CHECK(previewer.warnings().empty());
  REQUIRE(warnings_of_picture().size() == 1);
  CHECK(previewer.warnings()[0].find("'a' and 'b' overlap") != std::string::npos);
  CHECK(previewer.state().messages.back().text == previewer.warnings()[0]);
  previewer.apply("object.b.transform={ translate = [2.5, 0, 0] }");
  CHECK(warnings_of_picture().empty());
  CHECK(previewer.state().messages.empty());
}

TEST_CASE("the slider of the threads at its lower end means all of them") {
  const Offscreen context(1, 1);
  PreviewOptions options;
  options.settings.budget.spp = 1;
  Previewer previewer(context.functions(), Desk::small(kKnot), options, 1);
  previewer.carry_out({CommandKind::threads, 0, 0, {}, {}});
  await_sample(previewer);
}

TEST_CASE("a press is the picture's or the interface's by where it was made, however slow the frames are") {
  Desktop desktop;
  const auto edited = [&] { return desktop.previewer.title().starts_with('*'); };
  desktop.draw();
  desktop.send(InputKind::move, 600, 708);  // the status line
  desktop.draw();
  desktop.drag_from(450, 330);
  CHECK(edited());
  desktop.draw();
  desktop.previewer.carry_out({CommandKind::undo, 0, 0, {}, {}});
  CHECK_FALSE(edited());
  desktop.previewer.carry_out({CommandKind::help, 0, 0, {}, {}});
  desktop.draw();
  desktop.drag_from(640, 360);  // over the picture, were it not for the help
  CHECK_FALSE(edited());
}

TEST_CASE("a key in the frame of a click is the field's that was clicked, a shortcut where there is none") {
  Desktop desktop;
  const auto typing = [&] { return desktop.previewer.pointer_shape() == PointerShape::text; };
  const auto selecting = [&] { return desktop.previewer.state().look.selecting; };
  desktop.draw();
  double field = 52;  // its height in the side panel
  while (!typing()) {
    field += 8;
    REQUIRE(field < 700);
    desktop.control_click(1150, field);
    desktop.draw();
  }
  desktop.press(key::kEscape);
  desktop.draw();
  desktop.control_click(1150, field);
  desktop.press('X');
  desktop.draw();
  CHECK_FALSE(selecting());
  CHECK(typing());
  desktop.press(key::kEscape);
  desktop.draw();
  CHECK_FALSE(desktop.previewer.closing());
  desktop.control_click(400, 300);  // the picture
  desktop.press('X');
  CHECK_FALSE(selecting());  // not known yet whose it is
  desktop.draw();
  CHECK(selecting());
  desktop.press('X');
  CHECK_FALSE(selecting());
}

}  // namespace meander
