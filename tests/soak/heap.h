// What the process holds, and whether it grows.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace meander {

/// Bytes in the heap that are in use.
[[nodiscard]] double heap_bytes();
/// Bytes of physical memory.
[[nodiscard]] double resident_bytes();

struct MemorySample {
  double seconds = 0;
  double heap = 0;
  double resident = 0;
};

struct Growth {
  double bytes = 0;
  double error = 0;  // one standard error, if what scatters about the line does so independently
};

/// What a straight line through the samples (least squares) gains from the first to the last.
[[nodiscard]] Growth growth(const std::vector<MemorySample>& samples, double MemorySample::*quantity);

/// The median of each quarter of the samples, the earliest first: what fills once and then stays differs from
/// what grows for ever.
[[nodiscard]] std::array<double, 4> quarters(const std::vector<MemorySample>& samples,
                                             double MemorySample::*quantity);

}  // namespace meander
