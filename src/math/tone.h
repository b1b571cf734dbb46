// From linear radiance to the levels of a display: the curves, as the shaders have them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace meander {

/// srgb: plain IEC 61966-2-1, clipped at white. filmic: `filmic` below, then the same encoding.
enum class Tone : std::uint8_t { srgb, filmic };

inline constexpr std::array<std::string_view, 2> kToneNames{"srgb", "filmic"};

/// K. Narkowicz's fit of the ACES film curve ("ACES Filmic Tone Mapping Curve", 2015), its input scaled so
/// that middle grey, 0.18, stays 0.18. Linear to linear, of x >= 0; beyond 10.02 it exceeds 1.
[[nodiscard]] inline double filmic(double x) noexcept {
  const double y = std::min(x, 1e6) * 0.7231535;
  return y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14);
}

/// The curve alone: what of it is outside [0, 1] a display cannot show.
[[nodiscard]] inline double tone_curve(Tone tone, double x) noexcept {
  return tone == Tone::filmic && x > 0 ? filmic(x) : x;
}

/// The level, 0 to 255, at which a display shows a linear value; NaN is 0.
[[nodiscard]] inline int display_level(Tone tone, double linear) noexcept {
  if (std::isnan(linear)) return 0;
  const double x = std::clamp(tone_curve(tone, linear), 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * encoded));
}

}  // namespace meander
