// What oracles say, and the program that is made of some of them: each compares the walk with a number that
// no walk made, or holds it to what must be true of every walk.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "stats/moments.h"
#include "walk/lanes.h"

namespace meander {

inline constexpr double kBound = 4.5;  // of |z|; 60 scores of the true walk exceed it with probability 4e-4

/// What one oracle found: the worst of its scores, or what was not exact.
class Verdict {
 public:
  void score(const char* what, const Moments& measured, double exact) {
    score(what, measured.mean, exact, measured.standard_error());
  }
  void score(const char* what, double measured, double exact, double error) {
    const double z = (measured - exact) / std::max(error, 1e-6 * std::abs(exact) + 1e-12);
    if (!std::isnan(z) && !(std::abs(z) >= std::abs(worst_))) return;  // what is no number stays
    worst_ = z;
    say("%s %.5g, exact %.5g, z %.1f", what, measured, exact, z);
  }
  /// The value must lie in [low, high].
  void require(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    broken_ = true;
    say("%s %.6g, not in [%.6g, %.6g]", what, value, low, high);
  }
  [[nodiscard]] bool passed() const { return !broken_ && std::abs(worst_) < kBound; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  // A broken requirement is not talked over.
  template <class... Values>
  void say(const char* format, Values... values) {
    if (settled_) return;
    settled_ = broken_;
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    message_ = text;
  }

  double worst_ = 0;
  bool broken_ = false;
  bool settled_ = false;
  std::string message_ = "as it must be";
};

/// A check of walks by either code; of scalar ones alone where lanes have nothing to do with it.
struct Oracle {
  const char* name;
  void (*check)(Verdict& verdict, WalkCode code);
  bool in_lanes = true;
};

/// PROGRAM lists the names of the oracles, those of walks in lanes with _lanes behind; PROGRAM NAME prints
/// "NAME passed|FAILED MESSAGE", exit code 0 or 1.
inline int answer(std::span<const Oracle> oracles, int argc, char** argv) {
  for (const Oracle& oracle : oracles) {
    for (const WalkCode code : {WalkCode::scalar, WalkCode::batch}) {
      if (code == WalkCode::batch && !oracle.in_lanes) continue;
      const std::string name = std::string(oracle.name) + (code == WalkCode::batch ? "_lanes" : "");
      if (argc != 2) std::printf("%s\n", name.c_str());
      if (argc != 2 || name != argv[1]) continue;
      Verdict verdict;
      oracle.check(verdict, code);
      std::printf("%s %s %s\n", name.c_str(), verdict.passed() ? "passed" : "FAILED",
                  verdict.message().c_str());
      return verdict.passed() ? 0 : 1;
    }
  }
  if (argc != 2) return 0;
  std::fprintf(stderr, "no oracle is called %s\n", argv[1]);
  return 2;
}

}  // namespace meander
