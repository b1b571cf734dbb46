// What an estimator's error is worth in time.
#pragma once

#include <limits>

namespace meander {

/// 1 / (mse x seconds): what stays the same however long an unbiased estimator runs. NaN unless both are
/// above 0.
[[nodiscard]] inline double efficiency(double mse, double seconds) noexcept {
  return mse > 0 && seconds > 0 ? 1 / (mse * seconds) : std::numeric_limits<double>::quiet_NaN();
}

/// The seconds after which the noise is `wanted` (above 0), by its fall as the root of the time from what it
/// was after `seconds`.
[[nodiscard]] inline double seconds_to_noise(double seconds, double noise, double wanted) noexcept {
  const double ratio = noise / wanted;
  return seconds * ratio * ratio;
}

}  // namespace meander
