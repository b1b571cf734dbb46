#include "stats/log_histogram.h"

#include <algorithm>
#include <cmath>

namespace meander {

void LogHistogram::add(double value) noexcept {
  ++count_;
  if (!(value > 0)) {
    ++counts_[0];
    return;
  }
  largest_ = std::max(largest_, value);
  const double place = std::floor(kPerOctave * (std::log2(value) - kLowestOctave)) + 1;
  ++counts_[static_cast<std::size_t>(std::clamp(place, 0.0, double{kBins - 1}))];
}

void LogHistogram::merge(const LogHistogram& other) noexcept {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  count_ += other.count_;
  largest_ = std::max(largest_, other.largest_);
}

double LogHistogram::quantile(double q) const noexcept {
  if (count_ == 0) return 0;
  const double wanted = std::max(std::ceil(q * static_cast<double>(count_)), 1.0);
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
    below += counts_[bin];
    if (static_cast<double>(below) < wanted) continue;
    if (bin == 0) return 0;
    const double middle = std::exp2((static_cast<double>(bin) - 0.5) / kPerOctave + kLowestOctave);
    return std::min(middle, largest_);
  }
  return largest_;
}

}  // namespace meander
