#include "math/random.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "stats/moments.h"
#include "support/check_sampler.h"

namespace meander {
namespace {

using Counter = std::array<std::uint32_t, 4>;

constexpr int kDigits = std::numeric_limits<Real>::digits;

// Pearson's correlation of `count` pairs, times sqrt(count): standard normal when there is none.
template <class Pair>
double correlation_p(const Pair& pair_at, int count) {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_yy = 0, sum_xy = 0;
  for (int i = 0; i < count; ++i) {
    const std::array<double, 2> pair = pair_at(i);
    sum_x += pair[0];
    sum_y += pair[1];
    sum_xx += pair[0] * pair[0];
    sum_yy += pair[1] * pair[1];
    sum_xy += pair[0] * pair[1];
  }
  const double covariance = sum_xy - sum_x * sum_y / count;
  const double variances = (sum_xx - sum_x * sum_x / count) * (sum_yy - sum_y * sum_y / count);
  return two_sided_p(covariance / std::sqrt(variances) * std::sqrt(double(count)));
}

double number_at(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, int dimension) {
  Random random = stream(seed, pixel, sample);
  for (int i = 0; i < dimension; ++i) (void)random.next();
  return random.next();
}

}  // namespace

TEST_CASE("Philox gives the known answers of its authors") {
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  constexpr std::uint32_t kOnes = 0xffffffff;
  CHECK(philox({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}) ==
        Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("xoshiro128++ from the state 1, 2, 3, 4 gives the known sequence") {
  Random random({1, 2, 3, 4});
  for (const std::uint32_t expected : {641u, 1573767u, 3222811527u, 3517856514u, 836907274u, 4247214768u,
                                       3867114732u, 1355841295u, 495546011u, 621204420u}) {
    CHECK(random.next_bits() == expected);
  }
}

TEST_CASE("A stream is a pure function of its address, and every part of the address matters") {
  const auto first = [](std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample) {
    return stream(seed, pixel, sample).next_bits();
  };
  CHECK(first(7, 8, 9) == first(7, 8, 9));
  CHECK(first(7, 8, 9) != first(8, 8, 9));
  CHECK(first(7, 8, 9) != first(7, 9, 9));
  CHECK(first(7, 8, 9) != first(7, 8, 10));
  CHECK(first(7, 8, 9) != first(7, 9, 8));
  CHECK(first(7, 8, 9) != first(7 + (std::uint64_t{1} << 32), 8, 9));
}

TEST_CASE("Numbers lie on the grid of Real's digits in [0, 1), and 1 minus them is exact") {
  Random random = stream(1, 2, 3);
  bool on_grid = true;
  bool in_range = true;
  bool exact = true;
  for (int i = 0; i < 2'000'000; ++i) {
    const Real u = random.next();
    in_range = in_range && u >= 0 && u <= kLargestRandom;
    on_grid = on_grid && std::ldexp(u, kDigits) == std::floor(std::ldexp(u, kDigits));
    exact = exact && static_cast<long double>(Real(1) - u) == 1 - static_cast<long double>(u);
  }
  CHECK(in_range);
  CHECK(on_grid);
  CHECK(exact);
  // The largest bits there are, twice: rotate(s0 + s3) + s0 = 2^32 - 1 with s0 = 2^32 - 1, s3 = 1, and again
  // with the next state's s0 = 0, s3 = 2^32 - 1.
  CHECK(Random({0xffffffffu, 0xfffffffeu, 1, 1}).next() == kLargestRandom);
}

TEST_CASE("A fine number is the next number and a point of the step after it") {
  Random plain = stream(3, 2, 1);
  Random fine = plain;
  double rests = 0;
  constexpr int kCount = 1'000'000;
  for (int i = 0; i < kCount; ++i) {
    const FineNumber number = fine.next_fine();
    REQUIRE(number.number == plain.next());
    REQUIRE(number.rest > 0);
    REQUIRE(number.rest < 0.5 * kRealEpsilon);
    rests += number.rest / (0.5 * kRealEpsilon) - 0.5;
  }
  CHECK(fine.state() == plain.state());
  CHECK(std::abs(rests) < 4 * std::sqrt(kCount / 12.0));
}

TEST_CASE("Numbers have the mean and variance of the uniform distribution and fill it evenly") {
  constexpr int kCount = 8'000'000;
  constexpr std::size_t kCells = 4096;
  std::vector<double> high(kCells), low(kCells), first(kCells);
  double sum = 0, sum_squares = 0;
  Random random = stream(2, 0, 0);
  for (int i = 0; i < kCount; ++i) {
    const double u = random.next();
    const auto k = static_cast<std::uint64_t>(std::ldexp(u, kDigits));
    ++high[k >> (kDigits - 12)];
    ++low[k & 4095];
    sum += u - 0.5;
    sum_squares += (u - 0.5) * (u - 0.5);
  }
  constexpr int kStreams = 1'000'000;
  for (std::uint32_t pixel = 0; pixel < kStreams; ++pixel) {
    ++first[static_cast<std::size_t>(number_at(2, pixel, 0, 0) * kCells)];
  }
  TestFamily family;
  // The grid's mean is half a step below 1/2; (u - 1/2)^2 has mean 1/12 and variance 1/180.
  family.add("mean", two_sided_p(z_score(sum / kCount, -0.25 * kRealEpsilon, std::sqrt(1.0 / 12 / kCount))));
  family.add("variance", two_sided_p(z_score(sum_squares / kCount, 1.0 / 12, std::sqrt(1.0 / 180 / kCount))));
  const auto uniform_p = [](const std::vector<double>& counts, double count) {
    return chi_square_test(counts, std::vector<double>(counts.size(), count / double(counts.size()))).p;
  };
  family.add("high bits", uniform_p(high, kCount));
  family.add("low bits", uniform_p(low, kCount));
  family.add("first number of neighbouring pixels", uniform_p(first, kStreams));
  family.check();
}

TEST_CASE("No two streams of 256 x 256 pixels, 64 samples and 3 seeds start alike") {
  // Two outputs stand for the state: 12.6 million random fingerprints of 64 bits would collide once in
  // 230,000 runs.
  std::vector<std::uint64_t> fingerprints;
  fingerprints.reserve(3u * 64 * 65536);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    for (std::uint32_t sample = 0; sample < 64; ++sample) {
      for (std::uint32_t pixel = 0; pixel < 65536; ++pixel) {
        Random random = stream(seed, pixel, sample);
        const std::uint64_t high = random.next_bits();
        fingerprints.push_back(high << 32 | random.next_bits());
      }
    }
  }
  std::sort(fingerprints.begin(), fingerprints.end());
  CHECK(std::adjacent_find(fingerprints.begin(), fingerprints.end()) == fingerprints.end());
}

TEST_CASE("Neighbouring pixels, samples, seeds and dimensions are uncorrelated") {
  constexpr int kCount = 300'000;
  TestFamily family;
  for (const int dimension : {0, 1, 2, 5}) {
    const auto add = [&](const std::string& name, const auto& other) {
      const auto pair = [&](int i) {
        return std::array{number_at(5, static_cast<std::uint32_t>(i), 0, dimension),
                          other(static_cast<std::uint32_t>(i))};
      };
      family.add(name + ", dimension " + std::to_string(dimension), correlation_p(pair, kCount));
    };
    add("next pixel", [&](std::uint32_t i) { return number_at(5, i + 1, 0, dimension); });
    add("pixel below", [&](std::uint32_t i) { return number_at(5, i + 256, 0, dimension); });
    add("next sample", [&](std::uint32_t i) { return number_at(5, i, 1, dimension); });
    add("next seed", [&](std::uint32_t i) { return number_at(6, i, 0, dimension); });
    add("next dimension", [&](std::uint32_t i) { return number_at(5, i, 0, dimension + 1); });
  }
  family.check();
}

TEST_CASE("Consecutive pairs of one stream fill the unit square evenly") {
  const CellGrid grid{{0, 0}, {1, 1}, 101, 101};
  const auto density = [](double, double) { return 1.0; };
  const auto sample = [](const Vec2& u) { return std::array<double, 2>{u.x, u.y}; };
  CHECK(chi_square_p(sample, density, grid, 2'000'000) > 1e-3);
}

}  // namespace meander
