// What the mouse does over the picture: input events in, moves of camera and lights out.
#pragma once

#include <variant>
#include <vector>

#include "gl/input.h"

namespace meander {

enum class DragKind { none, orbit, pan, dolly, key_light, environment };

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
struct WheelDolly {
  double steps;
};
struct GestureBegin {};
struct GestureEnd {};

using PictureMove = std::variant<CameraDrag, LightDrag, WheelDolly, GestureBegin, GestureEnd>;

/// The mouse and the keys that change what it does, between events.
struct Navigation {
  double x = 0;
  double y = 0;
  DragKind drag = DragKind::none;
  int button = 0;
  bool light_key = false;  // L is held
};

/// Where the picture is when an event arrives. Window points.
struct PictureArea {
  double x = 0, y = 0, width = 1, height = 1;
  bool blocked = false;  // the interface has the mouse

  [[nodiscard]] bool contains(double px, double py) const noexcept {
    return px >= x && px < x + width && py >= y && py < y + height;
  }
};

/// Takes one event. Left drag orbits; middle or Shift+left pans; right dollies; with L held the key light
/// orbits, with Shift+L the environment turns. A drag that has begun goes on outside the picture.
[[nodiscard]] std::vector<PictureMove> navigate(Navigation& state, const InputEvent& event,
                                                const PictureArea& area);

}  // namespace meander
