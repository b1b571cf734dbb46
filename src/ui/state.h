// What the interface remembers from one frame to the next: choices that are no part of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "medium/color_map.h"
#include "ui/actions.h"

namespace meander {

enum class PanelName : std::uint8_t { preset, material, light, camera, render, statistics, coefficients };
inline constexpr std::array<std::string_view, 7> kPanelNames{"preset", "material",   "light",       "camera",
                                                             "render", "statistics", "coefficients"};

enum class BrowserUse : std::uint8_t { closed, open, save_scene, save_picture };

/// The slider that the pointer holds, and where it holds it.
struct SliderDrag {
  std::uint32_t id = 0;
  double place = 0;
  std::uint32_t pressed = 0;  // the slider that was pressed last
};

/// The slider that is being typed into.
struct SliderTyping {
  std::uint32_t id = 0;
  std::string text;
};

/// The colour map that was used last.
struct KeptColorMap {
  double g = 0;
  Surface surface;
  ColorMap map{0};
};

struct UiState {
  bool hidden = false;
  bool help = false;
  BrowserUse browser = BrowserUse::closed;
  std::string path;  // as typed in the browser
  std::string preset_search;
  std::array<bool, kPanelNames.size()> open{true, true, true, false, false, false, false};
  Parametrisation parametrisation = Parametrisation::color;  // where the scene names none
  bool lengths_linked = true;
  double target_noise = 0.01;
  SliderDrag drag;
  SliderTyping typing;
  KeptColorMap color_map;
  std::uint32_t last_active = 0;  // the control that was held in the frame before
};

/// Does what is for the interface alone, and says whether it was that: help, hide_interface, the browsers
/// (whose folder the previewer then lists into BrowserModel), and a quit that closes something.
[[nodiscard]] bool carry_out(UiState& state, const Command& command);

}  // namespace meander
