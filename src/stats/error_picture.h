// Where one image differs from another, in false colours.
#pragma once

#include <cmath>

#include "math/image.h"

namespace meander {

/// What an error picture shows of a pixel, from the luminances (Rec. 709) of both images: (a - b) / (|b| +
/// 0.01). The 0.01 keeps the noise of black pixels from shouting.
[[nodiscard]] inline double relative_luminance_error(double a, double reference) noexcept {
  return (a - reference) / (std::abs(reference) + 0.01);
}

/// Relative luminance error of every pixel, in colours (math/color_scale.h) that are even to the eye: signed,
/// dark grey where the images agree, orange where `a` is brighter and blue where it is darker; absolute, dark
/// violet over red to light yellow. `full_scale` (above 0) is the relative error of the last colour; larger
/// ones look the same. Pure green: the error is not finite. The first three channels are R G B in linear
/// light. Images of different sizes or with too few channels throw Error (input).
[[nodiscard]] Image8 error_picture(const Image& a, const Image& reference, double full_scale, bool absolute);

}  // namespace meander
