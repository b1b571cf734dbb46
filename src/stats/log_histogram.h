// Quantiles of a great many positive numbers, in little memory.
#pragma once

#include <cstdint>
#include <vector>

namespace meander {

/// Counts in bins of equal ratio, 32 an octave from 2^-20 to 2^44, and the exact largest value.
class LogHistogram {
 public:
  LogHistogram() : counts_(kBins) {}

  /// NaN counts as 0.
  void add(double value) noexcept;
  void merge(const LogHistogram& other) noexcept;

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double largest() const noexcept { return largest_; }

  /// The smallest value that at least the fraction q in (0, 1] of all values do not exceed, within 1.1 %
  /// (half a bin); 0 for a value below 2^-20, at most `largest`. 0 while there are no values.
  [[nodiscard]] double quantile(double q) const noexcept;

 private:
  static constexpr int kPerOctave = 32;
  static constexpr int kLowestOctave = -20;
  static constexpr int kBins = 64 * kPerOctave + 1;  // the first holds what is below all others

  std::vector<std::uint64_t> counts_;
  std::uint64_t count_ = 0;
  double largest_ = 0;
};

}  // namespace meander
