#include "stats/error_picture.h"

#include <algorithm>
#include <cassert>

#include "math/color.h"
#include "math/color_scale.h"
#include "stats/counted_pixels.h"

namespace meander {
namespace {

constexpr Level3 kNotFinite{0, 255, 0};  // on neither scale

double luminance_at(const Image& image, std::size_t pixel) {
  const float* value = &image.values[pixel * image.channels];
  return luminance(Rgb(value[0], value[1], value[2]));
}

Level3 error_color(double error, bool absolute) {
  if (!std::isfinite(error)) return kNotFinite;
  return absolute ? color_scale(std::abs(error)) : diverging_scale(error);
}

}  // namespace

Image8 error_picture(const Image& a, const Image& reference, double full_scale, bool absolute) {
  assert(full_scale > 0);
  [[maybe_unused]] const CountedPixels checked(a, reference, {}, 3);
  Image8 picture(a.width, a.height);
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(a.width) * a.height; ++pixel) {
    const double error =
        relative_luminance_error(luminance_at(a, pixel), luminance_at(reference, pixel)) / full_scale;
    std::ranges::copy(error_color(error, absolute), &picture.rgb[pixel * 3]);
  }
  return picture;
}

}  // namespace meander
