// How bright the brightest samples are beside the pixels they fall on.
#pragma once

#include <optional>
#include <span>

#include "render/progressive.h"
#include "stats/log_histogram.h"

namespace meander {

/// Traces the job's first `spp` samples of every pixel that `mask` counts (one byte a pixel, as first_hits
/// gives it; all where none does), the very samples its passes take, and counts their luminance over
/// sqrt(l^2 + 1e-4), l the luminance of that pixel in `reference` (R G B first, of the size of the job's
/// area). A sample that is not finite counts as 0. Nothing once `stop` is true before all are traced.
[[nodiscard]] std::optional<LogHistogram> sample_tail(const Job& job, const Image& reference,
                                                      std::span<const std::uint8_t> mask, std::uint64_t spp,
                                                      const std::atomic<bool>& stop);

}  // namespace meander
