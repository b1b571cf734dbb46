#include "math/free_path.h"

#include <doctest/doctest.h>
#include <cmath>
#include <limits>
#include <string>

#include "math/random.h"
#include "stats/moments.h"
#include "support/check_sampler.h"
#include "support/csv.h"

namespace meander {
namespace {

constexpr int kDigits = std::numeric_limits<Real>::digits;
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
constexpr Real kSigmas[] = {Real(1e-6), Real(0.01), Real(1), Real(37.5), Real(1e6)};

}  // namespace

TEST_CASE("Free paths are the tabulated quantiles") {
  const CsvTable table = reference_table("d3_free_path_quantiles.csv");
  REQUIRE(table.rows.size() == 11);
  int compared = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double u = table.number(row, "u");
    const double expected = table.number(row, "sigma_t_times_distance");
    if (u > double{kLargestRandom}) continue;  // beyond the generator's grid
    ++compared;
    const double distance = sample_free_path(1, static_cast<Real>(u));
    // Off the grid the rounding of u, and of 1 - u, moves the quantile by ds/du = 1 / (1 - u) times half a
    // unit each.
    const double tolerance = 2 * kRealEpsilon * expected + kRealEpsilon / (1 - u);
    CAPTURE(u);
    CHECK(std::abs(distance - expected) <= (u == 0 ? 0 : tolerance));
  }
  CHECK(compared == (kDigits < 40 ? 10 : 11));  // the last is 1 - 1e-12
}

TEST_CASE("On the generator's grid a free path is exact to two units in the last place") {
  Random random = stream(1, 0, 0);
  for (const Real sigma : kSigmas) {
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
      const Real xi = i < 64 ? Real(i + 1) * Real(0x1p-24) : i == 64 ? kLargestRandom : random.next();
      if (xi == 0) continue;
      const long double expected =
          -std::log1p(-static_cast<long double>(xi)) / static_cast<long double>(sigma);
      const double error = static_cast<double>(std::abs(sample_free_path(sigma, xi) / expected - 1));
      worst = larger_error(worst, error);
    }
    CAPTURE(sigma);
    CHECK(worst <= 2 * kRealEpsilon);
  }
}

TEST_CASE("Extreme random numbers give finite free paths at extreme extinctions") {
  for (const Real sigma : kSigmas) {
    check_extremes<1>(
        [&](const auto& u) { return sample_free_path(sigma, u[0]); },
        [&](Real s) { return s >= 0 && s * sigma < kDigits * Real(0.6932) && std::isfinite(s); });
    CHECK(sample_free_path(sigma, 0) == 0);
  }
}

TEST_CASE("In a body far thinner than the mean free path as many flights end inside as should") {
  // Every first word of a generator that may matter, in turn.
  for (const double tau : {1e-4, 3.7e-6, 1e-6, 1.5e-7}) {
    double inside = 0;
    for (std::uint32_t word = 0; word < 2 * tau * 0x1p32; ++word) {
      Random random({0, 1, 1, (word >> 7) | (word << 25)});
      inside += static_cast<double>(sample_free_path(1, random.next_fine())) < tau;
    }
    CAPTURE(tau);
    CHECK(std::abs(inside - 0x1p32 * -std::expm1(-tau)) <= 1);
  }
}

TEST_CASE("A vacuum is never hit and transmits everything") {
  for (const Real xi : {Real(0), Real(0.5), kLargestRandom}) {
    CHECK(sample_free_path(0, xi) == kInfinity);
    CHECK(sample_free_path(0, FineNumber{xi, Real(0x1p-33)}) == kInfinity);
  }
  CHECK(transmittance(0, 3) == 1);
  CHECK(transmittance(0, kInfinity) == 1);
  CHECK(pdf_free_path(0, 3) == 0);
  CHECK(pdf_free_path(0, kInfinity) == 0);
  CHECK(invert_free_path(0, 3) == 0);
  CHECK(transmittance(2, kInfinity) == 0);
}

TEST_CASE("A million free paths follow the exponential cdf, with mean and variance 1") {
  TestFamily family;
  for (const Real sigma : kSigmas) {
    const double rate = sigma;
    const auto cdf = [&](Real s) { return -std::expm1(-rate * s); };
    const auto sample = [&](Real xi) { return sample_free_path(sigma, xi); };
    family.add("sigma " + std::to_string(rate), kolmogorov_p(sample, cdf, 1'000'000));
  }
  Moments length, squared_deviation;
  Random random = stream(2, 0, 0);
  for (int i = 0; i < 1'000'000; ++i) {
    const double s = sample_free_path(1, random.next());
    length.add(s);
    squared_deviation.add((s - 1) * (s - 1));
  }
  family.add("mean", two_sided_p(z_score(length.mean, 1, length.standard_error())));
  family.add("variance", two_sided_p(z_score(squared_deviation.mean, 1, squared_deviation.standard_error())));
  family.check();
}

TEST_CASE("The density of free paths integrates to 1 and is the slope of the cdf") {
  for (const Real sigma : kSigmas) {
    const double scale = 1 / double{sigma};
    const auto density = [&](double t) { return pdf_free_path(sigma, static_cast<Real>(t * scale)) * scale; };
    check_unit_integral(density, 0, 40, 1e-6);
    const double slope =
        (double{transmittance(sigma, Real(0.5 * scale))} - double{transmittance(sigma, Real(1.5 * scale))});
    CHECK(integrate(density, 0.5, 1.5, 1e-7) == doctest::Approx(slope).epsilon(1e-6));
  }
}

TEST_CASE("Inverting a free path gives its random number back") {
  for (const Real sigma : kSigmas) {
    check_round_trip([&](Real xi) { return sample_free_path(sigma, xi); },
                     [&](Real s) { return invert_free_path(sigma, s); }, 2 * kRealEpsilon);
  }
}

}  // namespace meander
