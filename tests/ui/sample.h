// A previewer's state to draw: the default scene's wax, lights and a film that converges.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "ui/draw.h"
#include "ui/interface.h"

namespace meander {

/// Everything open to view, nothing selected, compared or asked for.
[[nodiscard]] UiModel sample_model();
/// The same with an overlay of every kind, snapshots, messages and a false-colour view.
[[nodiscard]] UiModel busy_model();

/// An interface with what it shows and remembers, and a window.
struct TestWindow {
  explicit TestWindow(int width, int height, float scale = 1);

  /// Feeds the events and draws until none is pending; the actions of all these frames together.
  UiActions frame(const std::vector<InputEvent>& events = {});
  [[nodiscard]] Layout layout() const;

  UiModel model = sample_model();
  UiState state;
  FrameShape shape;
  Interface interface;
  const ImDrawData* drawn = nullptr;
  int frames = 0;
};

[[nodiscard]] InputEvent move_to(float x, float y, bool shift = false);
[[nodiscard]] InputEvent button(float x, float y, bool down, Modifiers modifiers = {});
[[nodiscard]] InputEvent press_key(int code, Modifiers modifiers = {});
[[nodiscard]] InputEvent release_key(int code, Modifiers modifiers = {});
[[nodiscard]] InputEvent type_character(char32_t character);

}  // namespace meander
