// Which samples an image is made of: ranges of sample numbers, each of a seed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meander {

/// Samples first to last of a seed, both included.
struct SampleRange {
  std::uint64_t seed = 0;
  std::uint64_t first = 0;
  std::uint64_t last = 0;

  [[nodiscard]] bool operator==(const SampleRange&) const noexcept = default;
};

using SampleRanges = std::vector<SampleRange>;

/// Sorted by seed and first sample, those that meet joined into one.
[[nodiscard]] SampleRanges joined(SampleRanges ranges);

/// The lowest samples that two lists share, as one range; nothing when they share none.
[[nodiscard]] std::optional<SampleRange> shared_samples(const SampleRanges& a, const SampleRanges& b);

/// "0:0-63,7:128-255": seed, first and last.
[[nodiscard]] std::string ranges_text(const SampleRanges& ranges);

/// Nothing when the text is not such a list, or a range ends before it begins.
[[nodiscard]] std::optional<SampleRanges> read_ranges(std::string_view text);

}  // namespace meander
