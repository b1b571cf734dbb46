#include "stats/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stats/counted_pixels.h"

namespace meander {

ImageError image_error(const Image& a, const Image& reference, std::span<const std::uint8_t> mask) {
  const CountedPixels counted(a, reference, mask, 3);
  ImageError error;
  double reference_sum = 0;
  std::size_t values = 0;
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(a.width) * a.height; ++pixel) {
    if (!counted.counts(pixel)) continue;
    ++error.pixels;
    for (int channel = 0; channel < 3; ++channel) {
      const double x = a.values[pixel * a.channels + channel];
      const double b = reference.values[pixel * reference.channels + channel];
      if (!std::isfinite(x) || !std::isfinite(b)) {
        ++error.non_finite;
        continue;
      }
      const double d = x - b;
      ++values;
      error.mse += d * d;
      error.relmse += d * d / (b * b + 1e-4);
      error.mae += std::abs(d);
      error.mean_signed += d;
      if (std::abs(d) > error.max_abs) {
        error.max_abs = std::abs(d);
        error.max_x = static_cast<int>(pixel % a.width);
        error.max_y = static_cast<int>(pixel / a.width);
        error.max_channel = channel;
      }
      reference_sum += std::abs(b);
    }
  }
  const double n = static_cast<double>(values);  // 0 makes every mean NaN, as promised
  error.mse /= n;
  error.relmse /= n;
  error.mae /= n;
  error.mean_signed /= n;
  error.rmse = std::sqrt(error.mse);
  error.relative_rmse = error.rmse == 0 ? 0 : error.rmse / (reference_sum / n);
  error.psnr = -10 * std::log10(error.mse);
  if (values == 0) error.max_abs = std::numeric_limits<double>::quiet_NaN();
  return error;
}

std::size_t pixels_beyond(const Image& a, const Image& reference, double threshold,
                          std::span<const std::uint8_t> mask) {
  const CountedPixels counted(a, reference, mask, 3);
  std::size_t beyond = 0;
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(a.width) * a.height; ++pixel) {
    if (!counted.counts(pixel)) continue;
    double largest = 0;
    for (int channel = 0; channel < 3; ++channel) {
      const double d = std::abs(double{a.values[pixel * a.channels + channel]} -
                                reference.values[pixel * reference.channels + channel]);
      largest = std::isfinite(d) ? std::max(largest, d) : std::numeric_limits<double>::infinity();
    }
    beyond += largest > threshold;
  }
  return beyond;
}

}  // namespace meander
