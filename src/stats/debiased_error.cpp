#include "stats/debiased_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stats/counted_pixels.h"
#include "stats/moments.h"

namespace meander {
namespace {

constexpr double kNormal95 = 1.959963984540054;

constexpr double kFloor = 1e-4;  // of m^2
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// 0 below 0; NaN stays.
double root(double square) noexcept { return square < 0 ? 0 : std::sqrt(square); }

using Channels = std::array<double, 3>;

// w of a pixel's channels; a neighbour with a value that is not finite is left out.
Channels weights_at(const Image& reference, const CountedPixels& counted, int x, int y) {
  Channels sum{};
  double pixels = 0;
  for (int row = std::max(y - 1, 0); row < std::min(y + 2, reference.height); ++row)
    for (int column = std::max(x - 1, 0); column < std::min(x + 2, reference.width); ++column) {
      const float* value = reference.at(column, row);
      const bool counts = counted.counts(static_cast<std::size_t>(row) * reference.width + column);
      if (!counts || !std::isfinite(value[0] + value[1] + value[2])) continue;
      for (int c = 0; c < 3; ++c) sum[c] += double{value[c]};
      ++pixels;
    }
  Channels weights{};
  for (int c = 0; c < 3; ++c) {
    const double m = sum[c] / pixels;
    weights[c] = 1 / (m * m + kFloor);
  }
  return weights;
}

}  // namespace

double DebiasedError::rms() const noexcept { return root(mse); }
double DebiasedError::rms_low() const noexcept { return root(mse - kNormal95 * standard_error); }
double DebiasedError::rms_high() const noexcept { return root(mse + kNormal95 * standard_error); }
double DebiasedError::reference_rms() const noexcept { return root(reference_mse.value_or(0)); }
bool DebiasedError::reference_is_a_third() const noexcept {
  return reference_mse && 9 * *reference_mse <= mse;
}

DebiasedError debiased_error(const Image& a, const Image& reference, std::span<const std::uint8_t> mask) {
  const CountedPixels counted(a, reference, mask, 3);
  const bool known = reference.channels >= 6;
  Moments errors;
  Moments subtracted;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (!counted.counts(static_cast<std::size_t>(y) * a.width + x)) continue;
      const Channels weights = weights_at(reference, counted, x, y);
      const float* value = a.at(x, y);
      const float* truth = reference.at(x, y);
      double error = 0;
      double own = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = double{value[c]} - truth[c];
        const double v = known ? truth[c + 3] : 0.0;
        error += weights[c] * (d * d - v) / 3;
        own += weights[c] * v / 3;
      }
      if (!std::isfinite(error)) continue;
      errors.add(error);
      subtracted.add(own);
    }
  }
  DebiasedError result{kUnknown, kUnknown, {}, static_cast<std::size_t>(errors.count)};
  if (errors.count > 0) result.mse = errors.mean;
  if (errors.count > 1) result.standard_error = errors.standard_error();
  if (known) result.reference_mse = errors.count > 0 ? subtracted.mean : kUnknown;
  return result;
}

}  // namespace meander
