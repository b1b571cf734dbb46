// What a report holds its images against: a picture that was given, or one of its own.
#pragma once

#include "app/report.h"

namespace meander {

/// Reads a reference for the job's images, of which `mask` counts the pixels. Error (input) when its size is
/// another, a value is not finite or a variance below 0, or when it holds samples that the job will draw as
/// well, so that its error would hide theirs.
[[nodiscard]] ReportReference read_reference(const std::string& path, const Job& job, const Budget& budget,
                                             std::span<const std::uint8_t> mask);

/// Renders one with the implicit estimator and another seed, the job's plus one. Error (runtime) when `stop`
/// became true before it was done: nothing can be said without it.
[[nodiscard]] ReportReference make_reference(Job job, const Budget& budget, bool quiet,
                                             const std::atomic<bool>& stop);

/// What the reference takes to be beyond doubt beside images of `budget`: 16 times the samples and the time,
/// a quarter of the noise; or `spp` samples a pixel where that is given.
[[nodiscard]] Budget reference_budget(const Budget& budget, std::optional<std::uint64_t> spp) noexcept;

}  // namespace meander
