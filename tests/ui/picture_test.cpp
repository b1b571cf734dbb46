// The interface as pixels, drawn off-screen; the pictures stay in the build folder to be looked at.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "display/interface_view.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "gl/state.h"
#include "io/image_file.h"
#include "ui/sample.h"

namespace meander {
namespace {

// Everything that pixels need, in the order in which it must go.
struct Pixels {
  Offscreen context{1, 1};
  InterfaceView view{context.functions()};

  Image8 draw(TestWindow& window) {
    const FontBitmap font = window.interface.font();
    window.interface.set_font_texture(view.upload_font(font.width, font.height, font.coverage));
    window.frame();
    window.frame();  // sizes of scrolled content settle
    const int width = window.shape.pixels_wide;
    const int height = window.shape.pixels_high;
    const Framebuffer target(context.functions(), width, height);
    target.bind(width, height);
    clear(context.functions(), 0.12f);
    view.draw(*window.drawn, width, height);
    return target.read(width, height);
  }
};

void save(const Image8& frame, const std::string& name) { write_png(name + ".png", frame, {}); }

// Whether any pixel in the area (points) differs from the surround.
bool has_drawing(const Image8& frame, const Area& area, float scale) {
  const auto at = [&](float points) { return static_cast<int>(points * scale); };
  const std::uint8_t* first = frame.at(at(area.x) + 1, at(area.y) + 1);
  for (int y = at(area.y); y < at(area.y + area.height); ++y)
    for (int x = at(area.x); x < at(area.x + area.width); ++x)
      if (!std::equal(first, first + 3, frame.at(x, y))) return true;
  return false;
}

Area film_of(const Layout& layout) { return fitted_area(layout.image, 960, 540); }

}  // namespace

TEST_CASE("the interface has pixels in each of its regions, at every size and scale") {
  struct Size {
    int width, height;
    float scale;
  };
  for (const Size& size : {Size{960, 540, 1}, Size{1280, 720, 1}, Size{1920, 1080, 1}, Size{2560, 1440, 2},
                           Size{640, 400, 1}, Size{1600, 900, 1.25f}}) {
    for (const bool busy : {false, true}) {
      Pixels pixels;
      TestWindow window(size.width, size.height, size.scale);
      if (busy) window.model = busy_model();
      const Layout layout = window.layout();
      window.model.overlay.film = film_of(layout);
      if (busy) {
        window.state.open.fill(true);
        window.state.open[0] = window.state.open[1] = window.state.open[2] = false;
        window.interface.feed(move_to(layout.image.width / 3 * size.scale, 200 * size.scale));
        window.shape.pointer_scale = 1 / size.scale;
      }
      const Image8 frame = pixels.draw(window);
      CAPTURE(size.width);
      CHECK(has_drawing(frame, layout.toolbar, size.scale));
      CHECK(has_drawing(frame, layout.panel, size.scale));
      CHECK(has_drawing(frame, layout.status, size.scale));
      CHECK(has_drawing(frame, layout.image, size.scale));
      if (layout.strip.height > 0) CHECK(has_drawing(frame, layout.strip, size.scale));
      save(frame, "ui_" + std::to_string(size.width) + (busy ? "_busy" : ""));
    }
  }
}

TEST_CASE("menus, lists and pickers open over the rest") {
  struct Place {
    const char* name;
    float x, y;
  };
  for (const Place& place : {Place{"picker", 1075, 153}, Place{"presets", 1150, 75}, Place{"copy", 77, 19},
                             Place{"boundary", 1150, 314}, Place{"views", 300, 19}}) {
    Pixels pixels;
    TestWindow window(1280, 720);
    const Image8 before = pixels.draw(window);
    window.frame({button(place.x, place.y, true), button(place.x, place.y, false)});
    for (int i = 0; i < 3; ++i) window.frame();
    const Image8 after = pixels.draw(window);
    CAPTURE(place.name);
    int changed = 0;
    for (std::size_t i = 0; i < after.rgb.size(); ++i) changed += before.rgb[i] != after.rgb[i];
    CHECK(changed > 10000);
    save(after, std::string("ui_") + place.name);
  }
}

TEST_CASE("help, browser and the other parametrisations") {
  Pixels pixels;
  TestWindow window(1280, 720);
  window.model.overlay.film = film_of(window.layout());
  window.state.help = true;
  save(pixels.draw(window), "ui_help");
  window.state.help = false;
  window.state.browser = BrowserUse::open;
  window.model.browser.folder = "/home/artist/looks";
  window.model.browser.entries = {
      {"meshes", true, 0}, {"bunny.ply", false, 3'100'000}, {"wax.toml", false, 1200}};
  save(pixels.draw(window), "ui_browser");
  window.state.browser = BrowserUse::closed;
  window.model.material.now.given = Parametrisation::albedo;
  window.model.material.now.surface = {Boundary::dielectric, 1.4};
  window.state.lengths_linked = false;
  window.model.light.environment.kind = EnvironmentKind::softbox;
  save(pixels.draw(window), "ui_albedo");
  window.model.material.now.given = Parametrisation::sigma;
  window.state.open[3] = window.state.open[4] = true;
  window.state.open[0] = window.state.open[2] = false;
  save(pixels.draw(window), "ui_sigma");
}

}  // namespace meander
