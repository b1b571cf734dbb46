#include <hwy/targets.h>

#include <array>

#include "walk/lanes.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 4> kNames{"baseline", "sse4", "avx2", "avx512"};
constexpr std::array<InstructionSet, 4> kSets{InstructionSet::baseline, InstructionSet::sse4,
                                              InstructionSet::avx2, InstructionSet::avx512};

}  // namespace

std::string_view name_of(InstructionSet set) noexcept { return kNames[static_cast<std::size_t>(set)]; }

std::optional<InstructionSet> instruction_set(std::string_view name) noexcept {
  for (const InstructionSet set : kSets)
    if (name_of(set) == name) return set;
  return std::nullopt;
}

std::span<const InstructionSet> instruction_sets() noexcept {
  const std::int64_t supported = hwy::SupportedTargets();
  const std::size_t count = (supported & HWY_AVX3)   ? 4
                            : (supported & HWY_AVX2) ? 3
                            : (supported & HWY_SSE4) ? 2
                                                     : 1;
  return std::span(kSets).first(count);
}

}  // namespace meander
