#include <doctest/doctest.h>

#include "stats/moments.h"
#include "walk/path_weight.h"

using namespace meander;

TEST_CASE("a grey path has free-path weights of exactly 1") {
  const Medium medium{Rgb(3), Rgb(Real(0.9)), 0};
  PathWeight weight;
  for (int i = 0; i < 10000; ++i) weight.collide(medium, Real(0.7));
  weight.pass(medium, Real(0.2));
  CHECK(weight.ratio == Rgb(1));
  for (int c = 0; c < 3; ++c) CHECK(weight.free_path_weight()[c] == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("ratios survive thousands of collisions under extreme ratios of sigma_t") {
  const Medium medium{Rgb(1, 100, 10000), Rgb(1), 0};
  Random random = stream(1, 1, 1);
  PathWeight weight;
  for (int i = 0; i < 20000; ++i) weight.collide(medium, sample_free_path(100, random.next()));
  const Rgb w = weight.free_path_weight();
  CHECK(w.x + w.y + w.z == doctest::Approx(3));
  CHECK(w.y == doctest::Approx(3));  // only the second channel is likely to fly so
}

TEST_CASE("roulette keeps the expectation") {
  Moments mean;
  for (std::uint32_t i = 0; i < 200000; ++i) {
    Random random = stream(2, 0, i);
    PathWeight weight;
    weight.albedo = Rgb(Real(0.03), Real(0.01), 0);
    mean.add(weight.survives_roulette(random, Real(0.1)) ? double{weight.carried().x} : 0.0);
  }
  CHECK(std::abs(mean.mean - 0.03) < 4 * mean.standard_error());
  PathWeight none;
  none.albedo = Rgb(0);
  Random random = stream(2, 1, 0);
  CHECK_FALSE(none.survives_roulette(random, Real(0.1)));
}
