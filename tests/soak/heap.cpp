#include "soak/heap.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#ifdef __SANITIZE_ADDRESS__
extern "C" std::size_t
__sanitizer_get_current_allocated_bytes();  // of its runtime; GCC 12 has no header for it
#endif

namespace meander {

double heap_bytes() {
#ifdef __SANITIZE_ADDRESS__
  return static_cast<double>(__sanitizer_get_current_allocated_bytes());
#else
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
#endif
}

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0;
  double resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Growth growth(const std::vector<MemorySample>& samples, double MemorySample::*quantity) {
  const auto count = static_cast<double>(samples.size());
  if (samples.size() < 3) return {};
  double mean_time = 0;
  double mean = 0;
  for (const MemorySample& sample : samples) {
    mean_time += sample.seconds / count;
    mean += sample.*quantity / count;
  }
  double covariance = 0;
  double variance = 0;
  for (const MemorySample& sample : samples) {
    covariance += (sample.seconds - mean_time) * (sample.*quantity - mean);
    variance += (sample.seconds - mean_time) * (sample.seconds - mean_time);
  }
  if (!(variance > 0)) return {};
  const double slope = covariance / variance;
  double residual = 0;
  for (const MemorySample& sample : samples) {
    const double off = sample.*quantity - mean - slope * (sample.seconds - mean_time);
    residual += off * off;
  }
  const double span = samples.back().seconds - samples.front().seconds;
  return {slope * span, std::sqrt(residual / (count - 2) / variance) * span};
}

std::array<double, 4> quarters(const std::vector<MemorySample>& samples, double MemorySample::*quantity) {
  std::array<double, 4> medians{};
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    std::vector<double> values;
    for (std::size_t i = quarter * samples.size() / 4; i < (quarter + 1) * samples.size() / 4; ++i)
      values.push_back(samples[i].*quantity);
    if (values.empty()) continue;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    medians[quarter] = *middle;
  }
  return medians;
}

}  // namespace meander
