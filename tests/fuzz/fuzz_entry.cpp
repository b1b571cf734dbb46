// libFuzzer's way in: one program a target, MEANDER_FUZZ_TARGET. A finding is a crash, a second of processor
// time on one input, or what targets.h says must hold and does not.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>

#include "fuzz/targets.h"

namespace {

constexpr double kMostSeconds = 1;
constexpr std::size_t kCounters = 4096;

// libFuzzer counts these as it counts edges: the libraries behind the readers are not instrumented, and what
// they say of a file has to tell one input from another. The section is libFuzzer's interface, hence a
// global.
__attribute__((section("__libfuzzer_extra_counters"))) std::uint8_t outcome_counters[kCounters];

void count_outcome(const meander::FuzzOutcome& outcome) {
  std::string words;
  for (const char c : outcome.words)
    if (outcome.read || c < '0' || c > '9') words += c;
  outcome_counters[std::hash<std::string>()(words) % kCounters] = 1;
}

[[noreturn]] void finding(const char* what) {
  std::fprintf(stderr, "finding: %s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const meander::FuzzFolder folder;
  const double before = meander::processor_seconds();
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    count_outcome(meander::try_input(*meander::fuzz_target_of(MEANDER_FUZZ_TARGET), folder, bytes));
  } catch (const std::exception& error) {
    finding(error.what());
  }
  if (meander::processor_seconds() - before > kMostSeconds) finding("more than a second of processor time");
  return 0;
}
