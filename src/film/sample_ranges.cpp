#include "film/sample_ranges.h"

#include <algorithm>
#include <charconv>
#include <tuple>

namespace meander {
namespace {

auto place_of(const SampleRange& range) noexcept { return std::tuple(range.seed, range.first); }

// Takes a number from the front of the text.
std::optional<std::uint64_t> take_number(std::string_view& text) noexcept {
  std::uint64_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take(std::string_view& text, char wanted) noexcept {
  if (text.empty() || text.front() != wanted) return false;
  text.remove_prefix(1);
  return true;
}

std::optional<SampleRange> take_range(std::string_view& text) noexcept {
  const auto seed = take_number(text);
  if (!seed || !take(text, ':')) return std::nullopt;
  const auto first = take_number(text);
  if (!first || !take(text, '-')) return std::nullopt;
  const auto last = take_number(text);
  if (!last || *last < *first) return std::nullopt;
  return SampleRange{*seed, *first, *last};
}

}  // namespace

SampleRanges joined(SampleRanges ranges) {
  std::ranges::sort(ranges, {}, place_of);
  SampleRanges result;
  for (const SampleRange& range : ranges) {
    const bool meets = !result.empty() && result.back().seed == range.seed &&
                       (range.first <= result.back().last || range.first - result.back().last == 1);
    if (meets)
      result.back().last = std::max(result.back().last, range.last);
    else
      result.push_back(range);
  }
  return result;
}

std::optional<SampleRange> shared_samples(const SampleRanges& a, const SampleRanges& b) {
  std::optional<SampleRange> lowest;
  for (const SampleRange& x : a)
    for (const SampleRange& y : b) {
      if (x.seed != y.seed || x.last < y.first || y.last < x.first) continue;
      const SampleRange both{x.seed, std::max(x.first, y.first), std::min(x.last, y.last)};
      if (!lowest || place_of(both) < place_of(*lowest)) lowest = both;
    }
  return lowest;
}

std::string ranges_text(const SampleRanges& ranges) {
  std::string text;
  for (const SampleRange& range : ranges)
    text += (text.empty() ? "" : ",") + std::to_string(range.seed) + ':' + std::to_string(range.first) + '-' +
            std::to_string(range.last);
  return text;
}

std::optional<SampleRanges> read_ranges(std::string_view text) {
  SampleRanges ranges;
  do {
    const auto range = take_range(text);
    if (!range) return std::nullopt;
    ranges.push_back(*range);
  } while (take(text, ','));
  if (!text.empty()) return std::nullopt;
  return ranges;
}

}  // namespace meander
