// The previewer under random edits, resizes, gestures and reloads, off-screen, for MEANDER_SOAK_SECONDS (10;
// see run.sh) from the seed MEANDER_SOAK_SEED (1): no error, no stale frame, and memory that stays as it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "soak/heap.h"
#include "soak/soak.h"

namespace meander {
namespace {

constexpr int kStepsBetween = 25;  // two verifications
constexpr double kMebibyte = 1 << 20;
constexpr double kHeapPerHour = 32;       // MiB that the heap may gain by its straight line, and as it ends
constexpr double kResidentPerHour = 96;   // likewise the process: fragments, and the sanitizer's quarantine
constexpr double kLeftBehind = 8;         // MiB by which one previewer more may raise what is left of all
constexpr double kSecondsThatTell = 600;  // a shorter run says nothing of a line
constexpr int kScreensThatTell = 20;      // of fewer, chance may make all alike
constexpr double kWarmUp = 0.3;           // of a previewer's time: undo keeps 500 steps, caches fill
constexpr std::array<double, 3> kParts{0.1, 0.8, 0.1};  // of the whole: one previewer after another

double number_of(const char* name, double otherwise) {
  const char* asked = std::getenv(name);
  return asked == nullptr ? otherwise : std::atof(asked);
}

struct SoakTally {
  int steps = 0;
  int longest_wait = 0;
  int reloads = 0;
  int pictures = 0;
  int screens = 0;
  int compared = 0;
  int told_apart = 0;
  int grey = 0;
};

// One previewer for so long; the memory at its verifications.
std::vector<MemorySample> soak_for(double seconds, unsigned seed, SoakTally& tally) {
  const Folder folder;
  Soak soak(folder, seed);
  const Timer timer;
  std::vector<MemorySample> samples;
  while (timer.seconds() < seconds) {
    for (int i = 0; i < kStepsBetween && timer.seconds() < seconds; ++i, ++tally.steps) {
      CAPTURE(seed);
      CAPTURE(tally.steps);
      REQUIRE_NOTHROW(soak.step());
    }
    REQUIRE_NOTHROW(soak.verify());
    samples.push_back({timer.seconds(), heap_bytes(), resident_bytes()});
  }
  tally.longest_wait = std::max(tally.longest_wait, soak.longest_wait);
  tally.reloads += soak.reloads;
  tally.pictures += soak.pictures;
  tally.screens += soak.screens;
  tally.compared += soak.compared;
  tally.told_apart += soak.told_apart;
  tally.grey += soak.grey();
  return samples;
}

void judge(std::vector<MemorySample> samples) {
  const double begin = kWarmUp * samples.back().seconds;
  std::erase_if(samples, [&](const MemorySample& sample) { return sample.seconds < begin; });
  const double span = samples.back().seconds - samples.front().seconds;
  const Growth heap = growth(samples, &MemorySample::heap);
  const Growth resident = growth(samples, &MemorySample::resident);
  const auto said = [&](const char* name, double MemorySample::*quantity, const Growth& line) {
    std::ostringstream text;
    text << name << ' ' << samples.front().*quantity / kMebibyte << " to "
         << samples.back().*quantity / kMebibyte << " MiB, by its line " << line.bytes / kMebibyte << " +- "
         << line.error / kMebibyte << ", medians of its quarters";
    for (const double median : quarters(samples, quantity)) text << ' ' << median / kMebibyte;
    return text.str();
  };
  MESSAGE(samples.size() << " samples over " << span << " s: " << said("heap", &MemorySample::heap, heap)
                         << "; " << said("resident", &MemorySample::resident, resident));
  if (span < kSecondsThatTell) return;
  CHECK(heap.bytes / kMebibyte < kHeapPerHour * std::max(1.0, span / 3600));
  CHECK(resident.bytes / kMebibyte < kResidentPerHour * std::max(1.0, span / 3600));
}

}  // namespace

TEST_CASE("the growth of samples is that of their line") {
  std::vector<MemorySample> samples;
  for (int i = 0; i <= 10; ++i) samples.push_back({10.0 * i, 500.0 + 3 * i + (i % 2 == 0 ? 1 : -1), 7});
  const Growth heap = growth(samples, &MemorySample::heap);
  CHECK(heap.bytes == doctest::Approx(30).epsilon(0.01));
  CHECK(heap.error == doctest::Approx(std::sqrt(120.0 / 11 / 9 / 11000) * 100).epsilon(0.01));
  CHECK(growth(samples, &MemorySample::resident).bytes == doctest::Approx(0));
  CHECK(growth({}, &MemorySample::heap).bytes == 0);
  CHECK(quarters(samples, &MemorySample::resident) == std::array<double, 4>{7, 7, 7, 7});
  CHECK(quarters(samples, &MemorySample::heap)[3] == 526);
}

TEST_CASE("the heap's bytes are seen") {
  const double before = heap_bytes();
  const std::vector<char> block(std::size_t{64} << 20, 'x');
  CHECK(heap_bytes() - before >= static_cast<double>(block.size()));
  CHECK(heap_bytes() - before < 1.1 * static_cast<double>(block.size()));
}

TEST_CASE("under random use no frame is stale, nothing fails, and memory stays as it is") {
  const double seconds = number_of("MEANDER_SOAK_SECONDS", 10);
  const auto seed = static_cast<unsigned>(number_of("MEANDER_SOAK_SEED", 1));
  SoakTally tally;
  std::vector<double> left;  // in the heap when a previewer is gone
  for (std::size_t part = 0; part < kParts.size(); ++part) {
    const auto samples = soak_for(seconds * kParts[part], seed + static_cast<unsigned>(part), tally);
    left.push_back(heap_bytes() / kMebibyte);
    if (part == 1) judge(samples);
  }
  MESSAGE(tally.steps << " steps, " << tally.reloads << " reloads, " << tally.pictures
                      << " pictures verified, " << tally.screens << " screens, " << tally.compared
                      << " of images of which " << tally.told_apart << " could be told from the one before; "
                      << tally.grey << " frames as grey as their surround; longest wait "
                      << tally.longest_wait << " frames; heap left " << left[0] << ", " << left[1] << ", "
                      << left[2] << " MiB");
  CHECK(left[2] - left[1] < kLeftBehind);
  CHECK(tally.reloads > 0);
  if (tally.compared < kScreensThatTell) return;
  CHECK(tally.told_apart * 2 >= tally.compared);
}

}  // namespace meander
