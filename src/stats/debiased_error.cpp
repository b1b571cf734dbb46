#include "stats/debiased_error.h"

#include <algorithm>
#include <cmath>

#include "stats/counted_pixels.h"
#include "stats/moments.h"

namespace meander {
namespace {

constexpr double kNormal95 = 1.959963984540054;

double root(double square) noexcept { return std::sqrt(std::max(square, 0.0)); }

}  // namespace

double DebiasedError::rms() const noexcept { return root(mse); }
double DebiasedError::rms_low() const noexcept { return root(mse - kNormal95 * standard_error); }
double DebiasedError::rms_high() const noexcept { return root(mse + kNormal95 * standard_error); }
double DebiasedError::reference_rms() const noexcept { return root(reference_mse.value_or(0)); }
bool DebiasedError::reference_suffices() const noexcept { return reference_mse && 9 * *reference_mse <= mse; }

DebiasedError debiased_error(const Image& a, const Image& reference, std::span<const std::uint8_t> mask) {
  const CountedPixels counted(a, reference, mask, 3);
  const bool known = reference.channels >= 6;
  Moments errors;
  Moments subtracted;
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(a.width) * a.height; ++pixel) {
    if (!counted.counts(pixel)) continue;
    const float* value = &a.values[pixel * a.channels];
    const float* truth = &reference.values[pixel * reference.channels];
    double error = 0;
    double own = 0;
    for (int c = 0; c < 3; ++c) {
      const double r = truth[c];
      const double d = value[c] - r;
      const double w = 1 / (r * r + 1e-4);
      const double v = known ? truth[c + 3] : 0.0;
      error += w * (d * d - v) / 3;
      own += w * v / 3;
    }
    if (!std::isfinite(error)) continue;
    errors.add(error);
    subtracted.add(own);
  }
  DebiasedError result{errors.mean, errors.standard_error(), {}, static_cast<std::size_t>(errors.count)};
  if (known) result.reference_mse = subtracted.mean;
  return result;
}

}  // namespace meander
