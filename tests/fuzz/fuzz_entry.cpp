// libFuzzer's way in: one program a target, MEANDER_FUZZ_TARGET. A finding is a crash, too much processor
// time on one input, or what targets.h says must hold and does not.
#include <sys/time.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>

#include "fuzz/targets.h"

namespace {

// Of processor time, children apart: readers in a child have a limit of their own. The sanitizers and the
// counting of edges slow the code down by more than three; the second that counts is asked of an ordinary
// build, by replay.cpp. By the clock nothing is asked: the machine may be busy, or the process stopped.
constexpr time_t kMostSeconds = 3;
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

void limit_seconds(time_t seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

[[noreturn]] void finding(const char* what) {
  std::fprintf(stderr, "finding: %s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const meander::FuzzFolder folder;
  std::signal(SIGPROF, [](int) { finding("too much processor time"); });
  limit_seconds(kMostSeconds);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    count_outcome(meander::try_input(*meander::fuzz_target_of(MEANDER_FUZZ_TARGET), folder, bytes));
  } catch (const std::exception& error) {
    finding(error.what());
  }
  limit_seconds(0);
  return 0;
}
