// Icons as strokes of the draw list: no font, crisp at any scale.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace meander {

enum class Icon : std::uint8_t {
  open,
  save,
  copy,
  undo,
  redo,
  compare,
  camera,
  region,
  pause,
  play,
  help,
  eye,
  eye_shut,
  link,
  unlink,
  close,
  chevron_right,
  chevron_down,
  folder,
  file,
  up
};

/// In a square of 16 points about `center`.
void draw_icon(ImDrawList& list, Icon icon, const ImVec2& center, ImU32 color);

}  // namespace meander
