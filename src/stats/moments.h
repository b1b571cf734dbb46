// A running mean and variance of one quantity.
#pragma once

#include <cmath>
#include <cstdint>

namespace meander {

/// Count, mean, and sum of squared deviations from the mean (Welford 1962).
struct Moments {
  std::uint64_t count = 0;
  double mean = 0;
  double m2 = 0;

  void add(double value) noexcept {
    ++count;
    const double delta = value - mean;
    mean += delta / static_cast<double>(count);
    m2 += delta * (value - mean);
  }

  /// Takes in the samples of another set (Chan, Golub, LeVeque 1983, eq. 2.1).
  void merge(const Moments& other) noexcept {
    if (other.count == 0) return;
    const double n = static_cast<double>(count);
    const double m = static_cast<double>(other.count);
    const double delta = other.mean - mean;
    count += other.count;
    mean += delta * (m / (n + m));
    m2 += other.m2 + delta * delta * (n * m / (n + m));
  }

  /// Unbiased variance of one sample; 0 below two samples.
  [[nodiscard]] double variance() const noexcept {
    return count < 2 ? 0 : m2 / static_cast<double>(count - 1);
  }

  /// Standard error of the mean; 0 below two samples.
  [[nodiscard]] double standard_error() const noexcept {
    return count < 2 ? 0 : std::sqrt(variance() / static_cast<double>(count));
  }
};

}  // namespace meander
