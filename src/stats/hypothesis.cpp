#include "stats/hypothesis.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "stats/distributions.h"

namespace meander {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastExpected = 5;

struct Cell {
  double observed = 0;
  double expected = 0;
};

std::vector<Cell> pool_small_cells(std::vector<Cell> cells) {
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
  std::vector<Cell> pooled;
  Cell pool;
  for (const Cell& cell : cells) {
    pool.observed += cell.observed;
    pool.expected += cell.expected;
    if (pool.expected < kLeastExpected) continue;
    pooled.push_back(pool);
    pool = {};
  }
  if (pooled.empty()) {
    pooled.push_back(pool);
  } else {
    pooled.back().observed += pool.observed;
    pooled.back().expected += pool.expected;
  }
  return pooled;
}

}  // namespace

ChiSquareTest chi_square_test(std::span<const double> observed, std::span<const double> expected) {
  assert(observed.size() == expected.size());
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (!(expected[i] >= 0) || (expected[i] == 0 && observed[i] > 0)) return {kInfinity, 0, 0};
    cells.push_back({observed[i], expected[i]});
  }
  const std::vector<Cell> pooled = pool_small_cells(std::move(cells));
  if (pooled.size() < 2) return {};
  ChiSquareTest test;
  for (const Cell& cell : pooled) {
    const double difference = cell.observed - cell.expected;
    test.statistic += difference * difference / cell.expected;
  }
  test.degrees = static_cast<int>(pooled.size()) - 1;
  test.p = chi_square_survival(test.statistic, test.degrees);
  return test;
}

KolmogorovTest kolmogorov_smirnov(std::span<const double> cdf) {
  if (cdf.empty()) return {};
  const double n = static_cast<double>(cdf.size());
  double largest = 0;
  for (std::size_t i = 0; i < cdf.size(); ++i) {
    if (!(cdf[i] >= 0 && cdf[i] <= 1)) return {1, 0};
    const double k = static_cast<double>(i);
    largest = std::max({largest, cdf[i] - k / n, (k + 1) / n - cdf[i]});
  }
  return {largest, kolmogorov_survival(largest, cdf.size())};
}

double z_score(double mean, double reference, double standard_error) noexcept {
  const double difference = mean - reference;
  if (standard_error > 0) return difference / standard_error;
  return difference == 0 ? 0 : std::copysign(kInfinity, difference);
}

double two_sample_z(double mean_a, double error_a, double mean_b, double error_b) noexcept {
  return z_score(mean_a, mean_b, std::hypot(error_a, error_b));
}

}  // namespace meander
