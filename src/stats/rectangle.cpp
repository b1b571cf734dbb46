#include "stats/rectangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "stats/distributions.h"

namespace meander {
namespace {

// Sums over the pixels of one channel.
struct Sums {
  double mean = 0;
  double variance = 0;
  double welch = 0;  // of variance^2 / degrees of freedom
};

double half_width(const Sums& sums, std::size_t pixels, bool known) {
  if (!known) return std::numeric_limits<double>::infinity();
  if (sums.variance == 0) return 0;
  const double degrees = sums.variance * sums.variance / sums.welch;
  return student_threshold(0.05, degrees) * std::sqrt(sums.variance) / static_cast<double>(pixels);
}

}  // namespace

RectangleMean rectangle_mean(const Image& radiance, const Image& variance, PixelRectangle area) {
  assert(radiance.channels >= 4 && variance.channels >= 3);
  assert(radiance.width == variance.width && radiance.height == variance.height);
  RectangleMean result;
  std::array<Sums, 3> sums;
  bool known = true;
  for (int y = std::max(area.y0, 0); y < std::min(area.y1, radiance.height); ++y) {
    for (int x = std::max(area.x0, 0); x < std::min(area.x1, radiance.width); ++x) {
      const float* value = radiance.at(x, y);
      const float* error = variance.at(x, y);
      const double degrees = double{value[3]} - 1;
      known = known && degrees > 0;
      ++result.pixels;
      for (int c = 0; c < 3; ++c) {
        sums[c].mean += value[c];
        sums[c].variance += error[c];
        if (degrees > 0) sums[c].welch += double{error[c]} * error[c] / degrees;
      }
    }
  }
  if (result.pixels == 0) return result;
  for (int c = 0; c < 3; ++c) {
    result.mean[c] = sums[c].mean / static_cast<double>(result.pixels);
    result.half_width[c] = half_width(sums[c], result.pixels, known);
  }
  return result;
}

}  // namespace meander
