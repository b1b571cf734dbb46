// What the mouse does over the picture: input events in, moves of camera, lights, rectangle and wipe line
// out.
#pragma once

#include <variant>
#include <vector>

#include "gl/input.h"

namespace meander {

enum class DragKind { none, orbit, pan, dolly, key_light, environment, rectangle, wipe };

/// Moves are in fractions of the picture's height, y down.
struct CameraDrag {
  DragKind kind;  // orbit, pan or dolly
  double dx;
  double dy;
};
struct LightDrag {
  bool environment;  // otherwise the key light
  double dx;
  double dy;
};
/// Corners in window points.
struct RectangleDrag {
  double x0, y0, x1, y1;
};
struct WipeDrag {
  double x;  // window points
};
struct WheelDolly {
  double steps;
};
/// A press and release that moved nothing.
struct PictureClick {
  double x, y;
};
struct GestureBegin {};
struct GestureEnd {};

using PictureMove = std::variant<CameraDrag, LightDrag, RectangleDrag, WipeDrag, WheelDolly, PictureClick,
                                 GestureBegin, GestureEnd>;

/// The mouse and the keys that change what it does, between events.
struct Navigation {
  double x = 0;
  double y = 0;
  DragKind drag = DragKind::none;
  int button = 0;
  double start_x = 0;
  double start_y = 0;
  bool moved = false;
  bool light_key = false;  // L is held
};

/// Where the picture is and which tools are on, when an event arrives. Window points.
struct PictureArea {
  double x = 0, y = 0, width = 1, height = 1;
  bool blocked = false;         // the interface has the mouse
  bool rectangle_tool = false;  // the left button draws the rectangle
  double wipe_x = -1;           // the wipe line, negative when there is none

  [[nodiscard]] bool contains(double px, double py) const noexcept {
    return px >= x && px < x + width && py >= y && py < y + height;
  }
};

/// Takes one event. Left drag orbits; middle or Shift+left pans; right dollies; with L held the key light
/// orbits, with Shift+L the environment turns; near the wipe line the left button moves that. A drag that has
/// begun goes on outside the picture.
[[nodiscard]] std::vector<PictureMove> navigate(Navigation& state, const InputEvent& event,
                                                const PictureArea& area);

}  // namespace meander
