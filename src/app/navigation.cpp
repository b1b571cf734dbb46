#include "app/navigation.h"

#include <cmath>

namespace meander {
namespace {

constexpr double kWipeReach = 6;   // points beside the wipe line that still take hold of it
constexpr double kStillClick = 3;  // points that a click may move

DragKind drag_of(const Navigation& state, const InputEvent& event, const PictureArea& area) {
  if (event.code == 1) return DragKind::dolly;
  if (event.code == 2) return DragKind::pan;
  if (event.code != 0) return DragKind::none;
  if (state.light_key) return event.modifiers.shift ? DragKind::environment : DragKind::key_light;
  if (area.wipe_x >= 0 && std::abs(state.x - area.wipe_x) <= kWipeReach) return DragKind::wipe;
  if (area.rectangle_tool) return DragKind::rectangle;
  return event.modifiers.shift ? DragKind::pan : DragKind::orbit;
}

std::vector<PictureMove> press(Navigation& state, const InputEvent& event, const PictureArea& area) {
  if (state.drag != DragKind::none || area.blocked || !area.contains(state.x, state.y)) return {};
  state.drag = drag_of(state, event, area);
  if (state.drag == DragKind::none) return {};
  state.button = event.code;
  state.start_x = state.x;
  state.start_y = state.y;
  state.moved = false;
  return {GestureBegin{}};
}

std::vector<PictureMove> release(Navigation& state, const InputEvent& event) {
  if (state.drag == DragKind::none || event.code != state.button) return {};
  std::vector<PictureMove> moves;
  if (!state.moved && event.code == 0) moves.emplace_back(PictureClick{state.x, state.y});
  state.drag = DragKind::none;
  moves.emplace_back(GestureEnd{});
  return moves;
}

std::vector<PictureMove> move(Navigation& state, const InputEvent& event, const PictureArea& area) {
  const double dx = (event.x - state.x) / area.height;
  const double dy = (event.y - state.y) / area.height;
  state.x = event.x;
  state.y = event.y;
  if (state.drag == DragKind::none) return {};
  if (!state.moved && std::hypot(state.x - state.start_x, state.y - state.start_y) < kStillClick) return {};
  // The first move makes up for what the click's tolerance held back.
  const double whole_dx = state.moved ? dx : (state.x - state.start_x) / area.height;
  const double whole_dy = state.moved ? dy : (state.y - state.start_y) / area.height;
  state.moved = true;
  switch (state.drag) {
    case DragKind::key_light:
    case DragKind::environment:
      return {LightDrag{state.drag == DragKind::environment, whole_dx, whole_dy}};
    case DragKind::rectangle:
      return {RectangleDrag{state.start_x, state.start_y, state.x, state.y}};
    case DragKind::wipe:
      return {WipeDrag{state.x}};
    default:
      return {CameraDrag{state.drag, whole_dx, whole_dy}};
  }
}

}  // namespace

std::vector<PictureMove> navigate(Navigation& state, const InputEvent& event, const PictureArea& area) {
  switch (event.kind) {
    case InputKind::move:
      return move(state, event, area);
    case InputKind::button:
      return event.down ? press(state, event, area) : release(state, event);
    case InputKind::scroll:
      if (area.blocked || !area.contains(state.x, state.y) || event.y == 0) return {};
      return {WheelDolly{event.y}};
    case InputKind::key:
      if (event.code == 'L') state.light_key = event.down;
      return {};
    case InputKind::focus:  // keys released elsewhere are never told
      if (!event.down) state.light_key = false;
      return {};
    default:
      return {};
  }
}

}  // namespace meander
