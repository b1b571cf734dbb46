#include "app/navigation.h"

#include <doctest/doctest.h>

using namespace meander;

namespace {

struct Mouse {
  Navigation state;
  PictureArea area{100, 50, 400, 200, false, false, -1};
  std::vector<PictureMove> moves;

  void send(InputEvent event) {
    for (const PictureMove& move : navigate(state, event, area)) moves.push_back(move);
  }
  void move(double x, double y) { send({InputKind::move, x, y, 0, false, {}, 0, {}}); }
  void button(int code, bool down, Modifiers modifiers = {}) {
    send({InputKind::button, state.x, state.y, code, down, modifiers, 0, {}});
  }
  void key(int code, bool down) { send({InputKind::key, 0, 0, code, down, {}, 0, {}}); }
  template <class T>
  int count() const {
    int n = 0;
    for (const PictureMove& move : moves) n += std::holds_alternative<T>(move);
    return n;
  }
};

}  // namespace

TEST_CASE("a left drag orbits by fractions of the picture's height, as one gesture") {
  Mouse mouse;
  mouse.move(200, 100);
  mouse.button(0, true);
  mouse.move(220, 100);
  mouse.move(240, 150);
  mouse.move(900, 900);  // outside: the drag goes on
  mouse.button(0, false);
  CHECK(mouse.count<GestureBegin>() == 1);
  CHECK(mouse.count<GestureEnd>() == 1);
  REQUIRE(mouse.count<CameraDrag>() == 3);
  const auto& first = std::get<CameraDrag>(mouse.moves[1]);
  CHECK(first.kind == DragKind::orbit);
  CHECK(first.dx == doctest::Approx(0.1));
  double dx = 0;
  double dy = 0;
  for (const PictureMove& move : mouse.moves)
    if (const auto* drag = std::get_if<CameraDrag>(&move)) dx += drag->dx, dy += drag->dy;
  CHECK(dx == doctest::Approx(700.0 / 200));
  CHECK(dy == doctest::Approx(800.0 / 200));
  CHECK(mouse.count<PictureClick>() == 0);
}

TEST_CASE("buttons and modifiers choose the move") {
  const auto kind_of = [](int button, Modifiers modifiers) {
    Mouse mouse;
    mouse.move(200, 100);
    mouse.button(button, true, modifiers);
    return mouse.state.drag;
  };
  CHECK(kind_of(0, {}) == DragKind::orbit);
  CHECK(kind_of(0, {true}) == DragKind::pan);
  CHECK(kind_of(1, {}) == DragKind::dolly);
  CHECK(kind_of(2, {}) == DragKind::pan);
  CHECK(kind_of(3, {}) == DragKind::none);
}

TEST_CASE(
    "L turns the key light, Shift+L the environment, until it is let go or the window loses the keyboard") {
  Mouse mouse;
  mouse.move(200, 100);
  mouse.key('L', true);
  mouse.button(0, true);
  mouse.move(230, 100);
  mouse.button(0, false);
  mouse.button(0, true, {true});
  mouse.move(260, 100);
  mouse.button(0, false);
  REQUIRE(mouse.count<LightDrag>() == 2);
  CHECK_FALSE(std::get<LightDrag>(mouse.moves[1]).environment);
  CHECK(std::get<LightDrag>(mouse.moves[4]).environment);
  mouse.send({InputKind::focus, 0, 0, 0, false, {}, 0, {}});
  mouse.button(0, true);
  CHECK(mouse.state.drag == DragKind::orbit);
}

TEST_CASE("the rectangle tool and the wipe line take the left button") {
  Mouse mouse;
  mouse.area.rectangle_tool = true;
  mouse.move(200, 100);
  mouse.button(0, true);
  mouse.move(260, 140);
  mouse.button(0, false);
  REQUIRE(mouse.count<RectangleDrag>() == 1);
  CHECK(std::get<RectangleDrag>(mouse.moves[1]).x0 == 200);
  CHECK(std::get<RectangleDrag>(mouse.moves[1]).y1 == 140);
  mouse.area.wipe_x = 262;
  mouse.button(0, true);
  mouse.move(300, 140);
  CHECK(mouse.count<WipeDrag>() == 1);
}

TEST_CASE("nothing happens under the interface or outside the picture") {
  Mouse mouse;
  mouse.move(50, 100);
  mouse.button(0, true);
  mouse.move(200, 100);
  mouse.button(0, false);
  mouse.area.blocked = true;
  mouse.button(0, true);
  mouse.send({InputKind::scroll, 0, 1, 0, false, {}, 0, {}});
  CHECK(mouse.moves.empty());
  mouse.area.blocked = false;
  mouse.send({InputKind::scroll, 0, -2, 0, false, {}, 0, {}});
  REQUIRE(mouse.count<WheelDolly>() == 1);
  CHECK(std::get<WheelDolly>(mouse.moves[0]).steps == -2);
}

TEST_CASE("a press that hardly moves is a click") {
  Mouse mouse;
  mouse.move(200, 100);
  mouse.button(0, true);
  mouse.move(201, 101);
  mouse.button(0, false);
  CHECK(mouse.count<PictureClick>() == 1);
  CHECK(mouse.count<CameraDrag>() == 0);
}
