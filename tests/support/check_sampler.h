// The contract of every sampler, as checks a test calls: (1) finite and in range at the extreme random
// numbers, (2) the density it reports is the density it has, (3) that density integrates to 1, (4) its
// samples follow it, (5) its inverse undoes it. A sampler is seen through coordinates of the test's choice,
// in which its density is smooth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "math/random.h"
#include "math/types.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "support/quadrature.h"

namespace meander {

inline constexpr Real kLargestRandom = Real(1) - std::numeric_limits<Real>::epsilon() / 2;
inline constexpr Real kRealEpsilon = std::numeric_limits<Real>::epsilon();

/// The larger of two errors, where NaN is the largest.
[[nodiscard]] inline double larger_error(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

/// p-values of tests that are judged together: the family fails with probability `alpha` when all hypotheses
/// hold.
class TestFamily {
 public:
  explicit TestFamily(double alpha = 1e-3) : alpha_(alpha) {}

  void add(const std::string& name, double p) { members_.push_back({name, p}); }

  /// Checks every member at the Sidak level. Call once, at the end.
  void check() const {
    REQUIRE(!members_.empty());
    const double level = sidak_level(alpha_, members_.size());
    for (const Member& member : members_) {
      INFO(member.name, ": p = ", member.p, ", level ", level);
      CHECK(member.p > level);
    }
  }

 private:
  struct Member {
    std::string name;
    double p;
  };
  double alpha_;
  std::vector<Member> members_;
};

/// (1) Calls in_range(sample(u)) for every corner of the unit cube of random numbers; u is an array of N.
template <std::size_t N, class Sample, class InRange>
void check_extremes(const Sample& sample, const InRange& in_range) {
  for (unsigned corner = 0; corner < (1u << N); ++corner) {
    std::array<Real, N> u;
    for (std::size_t i = 0; i < N; ++i) u[i] = (corner >> i & 1) != 0 ? kLargestRandom : Real(0);
    CAPTURE(corner);
    CHECK(in_range(sample(u)));
  }
}

/// (2) Two routes to the same density, within a relative tolerance.
inline void check_same_density(double reported, double recomputed, double tolerance) {
  CAPTURE(reported);
  CAPTURE(recomputed);
  CHECK(reported > 0);
  CHECK(std::abs(reported - recomputed) <= tolerance * reported);
}

/// (3) The density over [low, high] integrates to 1, in one dimension.
template <class Density>
void check_unit_integral(const Density& density, double low, double high, double tolerance) {
  const double integral = integrate(density, low, high, 0.1 * tolerance);
  CAPTURE(integral);
  CHECK(std::abs(integral - 1) <= tolerance);
}

/// A rectangle of coordinates cut into columns x rows cells.
struct CellGrid {
  std::array<double, 2> low;
  std::array<double, 2> high;
  int columns = 31;  // odd, so that symmetric errors do not fall on cell borders
  int rows = 17;

  /// Index of the cell of a point; the border and what rounding puts just outside belong to the outermost
  /// cells.
  [[nodiscard]] std::size_t cell_of(const std::array<double, 2>& p) const {
    const auto clamped = [](double t, int n) {
      return std::clamp(static_cast<int>(std::floor(t * n)), 0, n - 1);
    };
    const int i = clamped((p[0] - low[0]) / (high[0] - low[0]), columns);
    const int j = clamped((p[1] - low[1]) / (high[1] - low[1]), rows);
    return static_cast<std::size_t>(j) * columns + i;
  }

  /// Integral of the density over every cell.
  template <class Density>
  [[nodiscard]] std::vector<double> integrals(const Density& density, int panels = 2) const {
    std::vector<double> result;
    const double width = (high[0] - low[0]) / columns;
    const double height = (high[1] - low[1]) / rows;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const std::array<double, 2> from = {low[0] + i * width, low[1] + j * height};
        result.push_back(integrate_rectangle(density, from, {from[0] + width, from[1] + height}, panels));
      }
    }
    return result;
  }
};

/// (3, 4) sample(Vec2 u) gives the coordinates of a sample, density(x, y) its density in them. The density
/// must integrate to 1 over the grid within `tolerance`; `count` samples must follow it. Returns the
/// chi-square p-value.
template <class Sample, class Density>
[[nodiscard]] double chi_square_p(const Sample& sample, const Density& density, const CellGrid& grid,
                                  std::size_t count, double tolerance = 1e-5) {
  std::vector<double> expected = grid.integrals(density);
  double total = 0;
  for (const double integral : expected) total += integral;
  CAPTURE(total);
  CHECK(std::abs(total - 1) <= tolerance);
  // Pearson's test wants equal totals; what is divided out here has just been checked.
  for (double& integral : expected) integral *= static_cast<double>(count) / total;
  std::vector<double> observed(expected.size(), 0.0);
  Random random = stream(4, 0, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Real first = random.next();
    ++observed[grid.cell_of(sample(Vec2(first, random.next())))];
  }
  return chi_square_test(observed, expected).p;
}

/// (4) In one dimension: sample(xi) against the cdf, by Kolmogorov and Smirnov.
template <class Sample, class Cdf>
[[nodiscard]] double kolmogorov_p(const Sample& sample, const Cdf& cdf, std::size_t count) {
  std::vector<double> values(count);
  Random random = stream(5, 0, 0);
  for (double& value : values) value = cdf(sample(random.next()));
  std::sort(values.begin(), values.end());
  return kolmogorov_smirnov(values).p;
}

/// (5) |invert(sample(xi)) - xi| <= tolerance for random xi and both extremes.
template <class Sample, class Invert>
void check_round_trip(const Sample& sample, const Invert& invert, double tolerance, int count = 10'000) {
  Random random = stream(6, 0, 0);
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const Real xi = i == 0 ? Real(0) : i == 1 ? kLargestRandom : random.next();
    const double error = std::abs(double{invert(sample(xi))} - double{xi});
    worst = larger_error(worst, error);
  }
  CAPTURE(worst);
  CHECK(worst <= tolerance);
}

/// (5) In two dimensions. The second number is an azimuth, on which 0 and 1 are the same place; `skip(u)`
/// says where the azimuth is lost, at a pole.
template <class Sample, class Invert, class Skip>
void check_round_trip_2d(const Sample& sample, const Invert& invert, double tolerance, const Skip& skip) {
  Random random = stream(7, 0, 0);
  double worst = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Real first = random.next();
    const Vec2 u(first, random.next());
    if (skip(u)) continue;
    const Vec2 back = invert(sample(u));
    const double turn = std::abs(double{back.y} - double{u.y});
    const double error = std::max(std::abs(double{back.x} - double{u.x}), std::min(turn, 1 - turn));
    worst = larger_error(worst, error);
  }
  CAPTURE(worst);
  CHECK(worst <= tolerance);
}

}  // namespace meander
