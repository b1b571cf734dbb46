#include "app/navigation.h"

namespace meander {
namespace {

DragKind drag_of(const Navigation& state, const InputEvent& event) {
  if (event.code == 1) return DragKind::dolly;
  if (event.code == 2) return DragKind::pan;
  if (event.code != 0) return DragKind::none;
  if (state.light_key) return event.modifiers.shift ? DragKind::environment : DragKind::key_light;
  return event.modifiers.shift ? DragKind::pan : DragKind::orbit;
}

std::vector<PictureMove> press(Navigation& state, const InputEvent& event, const PictureArea& area) {
  if (state.drag != DragKind::none || area.blocked || !area.contains(state.x, state.y)) return {};
  state.drag = drag_of(state, event);
  if (state.drag == DragKind::none) return {};
  state.button = event.code;
  return {GestureBegin{}};
}

std::vector<PictureMove> release(Navigation& state, const InputEvent& event) {
  if (state.drag == DragKind::none || event.code != state.button) return {};
  state.drag = DragKind::none;
  return {GestureEnd{}};
}

std::vector<PictureMove> move(Navigation& state, const InputEvent& event, const PictureArea& area) {
  const double dx = (event.x - state.x) / area.height;
  const double dy = (event.y - state.y) / area.height;
  state.x = event.x;
  state.y = event.y;
  if (state.drag == DragKind::none || (dx == 0 && dy == 0)) return {};
  if (state.drag == DragKind::key_light || state.drag == DragKind::environment)
    return {LightDrag{state.drag == DragKind::environment, dx, dy}};
  return {CameraDrag{state.drag, dx, dy}};
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
