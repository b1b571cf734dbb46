#include "stats/hypothesis.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "math/random.h"

namespace meander {

TEST_CASE("Chi-square of a small table equals the hand-computed one") {
  const std::array observed = {18.0, 22.0, 30.0, 30.0};
  const std::array expected = {25.0, 25.0, 25.0, 25.0};
  const ChiSquareTest test = chi_square_test(observed, expected);
  CHECK(test.statistic == doctest::Approx(4.32).epsilon(1e-14));
  CHECK(test.degrees == 3);
  CHECK(test.p == doctest::Approx(0.228918864336105).epsilon(1e-13));
}

TEST_CASE("Chi-square pools cells of small expectation") {
  const std::array observed = {10.0, 3.0, 1.0, 4.0, 2.0};
  const std::array expected = {9.0, 2.0, 2.5, 4.5, 2.0};
  // 2 + 2 + 2.5 come together first, then 4.5 + 9.
  const ChiSquareTest test = chi_square_test(observed, expected);
  CHECK(test.degrees == 1);
  CHECK(test.statistic == doctest::Approx(0.5 * 0.5 / 6.5 + 0.5 * 0.5 / 13.5).epsilon(1e-14));
}

TEST_CASE("Chi-square leaves nothing out when the last cells stay small") {
  const std::array observed = {1.0, 1.0};
  const std::array expected = {1.0, 1.0};
  CHECK(chi_square_test(observed, expected).degrees == 0);
  CHECK(chi_square_test(observed, expected).p == 1);
}

TEST_CASE("A sample where none can fall fails the chi-square test") {
  const std::array observed = {99.0, 1.0};
  const std::array expected = {100.0, 0.0};
  CHECK(chi_square_test(observed, expected).p == 0);
}

TEST_CASE("Chi-square p-values of uniform counts are themselves uniform") {
  constexpr int kCells = 37;
  constexpr int kRuns = 2000;
  std::vector<double> p_values;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    Random random = stream(11, run, 0);
    std::vector<double> observed(kCells, 0.0);
    for (int i = 0; i < 100 * kCells; ++i) ++observed[static_cast<std::size_t>(random.next() * kCells)];
    p_values.push_back(chi_square_test(observed, std::vector<double>(kCells, 100.0)).p);
  }
  std::sort(p_values.begin(), p_values.end());
  CHECK(kolmogorov_smirnov(p_values).p > 1e-3);
}

TEST_CASE("The Kolmogorov statistic of three samples equals the hand-computed one") {
  const std::array cdf = {0.1, 0.4, 0.9};
  CHECK(kolmogorov_smirnov(cdf).statistic == doctest::Approx(2.0 / 3 - 0.4).epsilon(1e-14));
  const std::array late = {0.5, 0.8, 0.9};
  CHECK(kolmogorov_smirnov(late).statistic == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("Kolmogorov p-values of uniform samples are themselves uniform, and those of biased ones are not") {
  std::vector<double> p_values;
  double largest_biased_p = 0;
  for (std::uint32_t run = 0; run < 1000; ++run) {
    Random random = stream(12, run, 0);
    std::vector<double> samples(1000);
    for (double& sample : samples) sample = random.next();
    std::sort(samples.begin(), samples.end());
    p_values.push_back(kolmogorov_smirnov(samples).p);
    for (double& sample : samples) sample = std::pow(sample, 1.3);
    largest_biased_p = std::max(largest_biased_p, kolmogorov_smirnov(samples).p);
  }
  std::sort(p_values.begin(), p_values.end());
  CHECK(kolmogorov_smirnov(p_values).p > 1e-3);
  CHECK(largest_biased_p < 0.1);
}

TEST_CASE("A cdf value out of range or NaN fails the Kolmogorov test") {
  CHECK(kolmogorov_smirnov(std::array{0.2, 1.1}).p == 0);
  CHECK(kolmogorov_smirnov(std::array{std::numeric_limits<double>::quiet_NaN()}).p == 0);
}

TEST_CASE("z-scores count standard errors, with and without any") {
  CHECK(z_score(1.3, 1, 0.1) == doctest::Approx(3).epsilon(1e-14));
  CHECK(z_score(1, 1, 0) == 0);
  CHECK(z_score(1, 2, 0) == -std::numeric_limits<double>::infinity());
  CHECK(two_sample_z(2, 0.3, 1, 0.4) == doctest::Approx(2).epsilon(1e-14));
}

}  // namespace meander
