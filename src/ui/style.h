// How everything looks: neutral greys, by which colours are judged well, and one accent.
#pragma once

#include <imgui.h>

#include <array>
#include <string>

namespace meander {

inline constexpr ImU32 kSurround = IM_COL32(29, 29, 29, 255);
inline constexpr ImU32 kPanelColor = IM_COL32(40, 40, 40, 255);
inline constexpr ImU32 kBarColor = IM_COL32(34, 34, 34, 255);
inline constexpr ImU32 kDialogColor = IM_COL32(36, 36, 36, 255);
inline constexpr ImU32 kFrameColor = IM_COL32(56, 56, 56, 255);
inline constexpr ImU32 kHoverColor = IM_COL32(68, 68, 68, 255);
inline constexpr ImU32 kHeldColor = IM_COL32(80, 80, 80, 255);
inline constexpr ImU32 kLineColor = IM_COL32(20, 20, 20, 255);
inline constexpr ImU32 kTextColor = IM_COL32(222, 222, 222, 255);
inline constexpr ImU32 kDimColor = IM_COL32(156, 156, 156, 255);
inline constexpr ImU32 kFaintColor = IM_COL32(104, 104, 104, 255);
inline constexpr ImU32 kAccent = IM_COL32(94, 164, 226, 255);
inline constexpr ImU32 kTrackFill = IM_COL32(88, 88, 90, 255);
inline constexpr ImU32 kAccentFill = IM_COL32(62, 98, 130, 255);
inline constexpr ImU32 kWarnColor = IM_COL32(232, 176, 84, 255);
inline constexpr ImU32 kErrorColor = IM_COL32(236, 108, 96, 255);

/// Sizes in points.
inline constexpr float kTextSize = 13;
inline constexpr float kSmallSize = 11;
inline constexpr float kRounding = 3;
inline constexpr float kRowHeight = 20;
inline constexpr float kListLine = 17;
inline constexpr float kLeastPanel = 200;  // in a window narrower than its panel, that is cut off

/// The fonts of the current context: for everything, for what is secondary, for headings.
[[nodiscard]] ImFont* plain_font();
[[nodiscard]] ImFont* small_font();
[[nodiscard]] ImFont* strong_font();

/// Of the current context.
void apply_style();
/// Loads the fonts for `scale` pixels a point, the file named by the environment variable MEANDER_FONT
/// first. Digits get one width, so that numbers do not dance. Error (runtime) naming the package when no
/// font is found.
void load_fonts(float scale);

}  // namespace meander
