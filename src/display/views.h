// The ways of looking at a film.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "math/tone.h"

namespace meander {

/// image: radiance through the tone curve. noise: the standard error of each pixel relative to its value,
/// sqrt(mean over channels of v / (m^2 + 1e-4)). samples. scatterings: their mean number. length: the mean
/// length of the walks inside bodies, in scene units. normals: as colours. luminance: the image in grey.
/// clipping: the image in grey, what the display cannot show in red (too bright) and blue (negative, or no
/// number).
enum class View : std::uint8_t { image, noise, samples, scatterings, length, normals, luminance, clipping };

inline constexpr std::array<std::string_view, 8> kViewNames{"image",  "noise",   "samples",   "scatterings",
                                                            "length", "normals", "luminance", "clipping"};

/// The ends of the logarithmic colour scale of a view.
struct ViewRange {
  float low = 0;
  float high = 0;
};

/// True where the colours of the view are those of math/color_scale.h, and a legend is of use.
[[nodiscard]] constexpr bool has_scale(View view) noexcept {
  return view == View::noise || view == View::samples || view == View::scatterings || view == View::length;
}

/// The range that fits most films: noise 0.1 % to 100 %, 1 to 4096 samples, 1 to 1000 scatterings, lengths
/// 0.01 to 100.
[[nodiscard]] constexpr ViewRange default_range(View view) noexcept {
  if (view == View::noise) return {0.001f, 1.0f};
  if (view == View::samples) return {1.0f, 4096.0f};
  if (view == View::scatterings) return {1.0f, 1000.0f};
  return {0.01f, 100.0f};
}

struct ViewOptions {
  float exposure = 0;  // stops: every value is multiplied by 2^exposure
  Tone tone = Tone::srgb;
  View view = View::image;
  float low = 0;  // range of the colour scale, 0 < low < high; both 0: default_range of the view
  float high = 0;
  bool smooth = false;  // interpolate where one film pixel covers several pixels, as a coarse level wants

  bool operator==(const ViewOptions&) const = default;
};

/// wipe: one film left of a line, the other right of it. difference: |a - b| of the radiance, through
/// exposure and tone curve.
enum class Comparison : std::uint8_t { none, wipe, difference, only_b };

inline constexpr std::array<std::string_view, 4> kComparisonNames{"none", "wipe", "difference", "b"};

}  // namespace meander
