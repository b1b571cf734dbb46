#include "walk/shadow_roulette.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "stats/moments.h"

using namespace meander;

TEST_CASE("every shadow ray counts 1 on average, and as many are traced as their worths add up to") {
  constexpr std::array<Real, 12> kWorths{0.3f, 1.9f, 0.02f, 2, 7, 0, 0.9f, 1e-3f, 0.4f, 1.2f, 2.5f, 0.7f};
  std::array<Moments, kWorths.size()> counts;
  double expected = 0;
  for (const Real worth : kWorths) expected += std::min(double{worth / kShadowThreshold}, 1.0);
  for (std::uint32_t i = 0; i < 200000; ++i) {
    Random random = stream(1, 0, i);
    ShadowRoulette roulette(random.next());
    int traced = 0;
    for (std::size_t k = 0; k < kWorths.size(); ++k) {
      const Real count = roulette.draw(kWorths[k]);
      counts[k].add(count);
      if (count > 0) ++traced;
      if (kWorths[k] >= kShadowThreshold) CHECK(count == 1);
    }
    CHECK(std::abs(traced - expected) < 1);
  }
  for (std::size_t k = 0; k < kWorths.size(); ++k) {
    if (kWorths[k] == 0) {
      CHECK(counts[k].mean == 0);
      continue;
    }
    const double p = std::min(double{kWorths[k] / kShadowThreshold}, 1.0);
    CHECK(std::abs(counts[k].mean - 1) <= 4 * std::sqrt((1 - p) / p / 200000) + 1e-6);
  }
}

TEST_CASE("rays of the least worth add up as well") {
  ShadowRoulette roulette(Real(0.5));
  const Real worth = kShadowThreshold * Real(0x1p-30);
  for (int i = 0; i < 1000; ++i) CHECK(roulette.draw(worth) == 0);
  CHECK(roulette.draw(kShadowThreshold * (Real(0.5) - Real(0x1p-21))) > 0);
}

TEST_CASE("what a walk carries to a light fades with the depth, per channel, and is 1 without a history") {
  PathWeight weight;
  CHECK(most_carried(weight, Rgb(1, 2, 3), 0) == 1);
  CHECK(most_carried(weight, Rgb(1, 2, 3), 2) == doctest::Approx(std::exp(-2)));
  weight.albedo = Rgb(Real(0.1), 1, 1);
  CHECK(most_carried(weight, Rgb(1, 2, 3), 2) == doctest::Approx(std::exp(-4)));
  // The hero's channel leads: its weight is 3 where the others' densities are gone.
  weight.albedo = Rgb(1);
  weight.ratio = Rgb(0, 1, 0);
  CHECK(most_carried(weight, Rgb(1, 2, 3), 0) == 3);
  CHECK(most_carried(weight, Rgb(1, 2, 3), Real(0.5)) == doctest::Approx(3 * std::exp(-1)));
}
