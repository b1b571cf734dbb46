#include "math/henyey_greenstein.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "math/frame.h"
#include "math/random.h"
#include "math/warp.h"
#include "stats/moments.h"
#include "support/check_sampler.h"
#include "support/csv.h"

namespace meander {
namespace {

constexpr Real kForward[] = {Real(0), Real(1e-7), Real(0.3), Real(0.9), Real(0.999), Real(0.9999)};
constexpr double kPrecision = 5e-7 / 0x1p-23 * kRealEpsilon;  // 5e-7 in float

// The terms of a deflection in 64-bit mantissas. The table of 60-digit values vouches for them in the first
// test.
struct Exact {
  long double one_minus_mu;
  long double one_plus_mu;
};

Exact exact_deflection(long double g, long double xi) {
  const long double a = std::abs(g);
  const long double forward = g < 0 ? 1 - xi : xi;
  const long double backward = g < 0 ? xi : 1 - xi;
  const long double q = (1 - a) + 2 * a * forward;
  const long double minus = 2 * (1 - a) * (1 - a) * backward * (1 + a * forward) / (q * q);
  const long double plus = 2 * (1 + a) * (1 + a) * forward * ((1 - a) + a * forward) / (q * q);
  return g < 0 ? Exact{plus, minus} : Exact{minus, plus};
}

long double exact_density(long double g, const Exact& at) {
  const long double a = std::abs(g);
  const long double d = (1 - a) * (1 - a) + 2 * a * (g < 0 ? at.one_plus_mu : at.one_minus_mu);
  return (1 - a) * (1 + a) / (2 * d * std::sqrt(d));
}

long double exact_cdf(long double g, const Exact& at) {
  if (g < 0) return 1 - exact_cdf(-g, {at.one_plus_mu, at.one_minus_mu});
  const long double root = std::sqrt((1 - g) * (1 - g) + 2 * g * at.one_minus_mu);
  return at.one_plus_mu * (1 - g) / (root * (1 + g + root));
}

double relative_error(Real value, long double expected) {
  if (expected == 0) return value == 0 ? 0 : 1;
  return static_cast<double>(std::abs(value / expected - 1));
}

template <class Visit>
void for_each_g(const Visit& visit) {
  for (const Real a : kForward) {
    CAPTURE(a);
    visit(a);
    if (a != 0) visit(-a);
  }
}

}  // namespace

TEST_CASE("The positive form is the inverse cdf, to 60 digits") {
  const CsvTable table = reference_table("d2_hg_inverse_cdf.csv");
  REQUIRE(table.rows.size() == 195);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const long double g = std::stold(table.text(row, "g"));
    const long double xi = std::stold(table.text(row, "xi"));
    const Exact exact = exact_deflection(g, xi);
    // What rounding of xi near 1 to 64 bits does to the small term: eps / (1 - xi), relative.
    const double tolerance = 1e-15 + (xi > 0.5L && xi < 1 ? 1e-19 / static_cast<double>(1 - xi) : 0);
    const auto check = [&](long double value, const char* column) {
      const long double expected = std::stold(table.text(row, column));
      CAPTURE(row);
      CHECK(std::abs(value - expected) <= tolerance * expected);
    };
    check(exact.one_minus_mu, "one_minus_mu");
    check(exact.one_plus_mu, "one_plus_mu");
  }
}

TEST_CASE("Sampled deflections are the tabulated ones within the rounding of g and xi") {
  const CsvTable table = reference_table("d2_hg_inverse_cdf.csv");
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto g = static_cast<Real>(table.number(row, "g"));
    const double xi = table.number(row, "xi");
    const Deflection sampled = sample_henyey_greenstein(g, static_cast<Real>(xi));
    const double tolerance = 4 * kRealEpsilon +
                             std::abs(table.number(row, "dmu_dxi")) * kRealEpsilon * std::max(xi, 0.5) +
                             table.number(row, "abs_dmu_dg") * kRealEpsilon;
    CAPTURE(row);
    CHECK(std::abs(sampled.mu - table.number(row, "mu")) <= tolerance);
  }
}

TEST_CASE("Every term of a deflection keeps its relative precision for every random number") {
  double worst = 0;
  for_each_g([&](Real g) {
    Random random = stream(1, 0, 0);
    for (int i = 0; i < 200'000; ++i) {
      const Real xi = i < 1000   ? Real(i) * Real(0x1p-24)
                      : i < 2000 ? 1 - Real(i - 1000) * Real(0x1p-24)
                                 : random.next();
      const Deflection sampled = sample_henyey_greenstein(g, xi);
      const Exact exact = exact_deflection(g, xi);
      const long double sine = std::sqrt(exact.one_minus_mu * exact.one_plus_mu);
      const long double mu = exact.one_minus_mu < 1 ? 1 - exact.one_minus_mu : exact.one_plus_mu - 1;
      const double mu_error = static_cast<double>(std::abs(sampled.mu - mu));
      worst = larger_error(worst, relative_error(sampled.one_minus_mu, exact.one_minus_mu));
      worst = larger_error(worst, relative_error(sampled.one_plus_mu, exact.one_plus_mu));
      worst = larger_error(worst, relative_error(sampled.sin_theta, sine));
      worst = larger_error(worst, mu_error);
    }
  });
  MESSAGE("worst error: ", worst);
  CHECK(worst <= kPrecision);
}

TEST_CASE("Extreme random numbers give deflections in range") {
  for_each_g([](Real g) {
    check_extremes<1>([&](const auto& u) { return sample_henyey_greenstein(g, u[0]); },
                      [](const Deflection& d) {
                        return std::abs(d.mu) <= 1 && d.one_minus_mu >= 0 && d.one_plus_mu >= 0 &&
                               d.sin_theta >= 0 && d.sin_theta <= 1 + 4 * kRealEpsilon;
                      });
    CHECK(sample_henyey_greenstein(g, 0).mu == -1);
    CHECK(sample_henyey_greenstein(g, 1).mu == 1);
  });
}

TEST_CASE("Density and cdf are the tabulated ones within the rounding of g") {
  const CsvTable table = reference_table("d1b_hg_cdf.csv");
  REQUIRE(table.rows.size() == 150);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const long double g = std::stold(table.text(row, "g"));
    const long double mu = std::stold(table.text(row, "mu"));
    const Exact at{1 - mu, 1 + mu};
    const long double pi = std::acos(-1.0L);
    CAPTURE(row);
    // First the oracle against the table, then the code against the oracle at the g the code was given.
    CHECK(exact_density(g, at) / (2 * pi) ==
          doctest::Approx(table.number(row, "phase_function_per_steradian")).epsilon(1e-14));
    CHECK(std::abs(exact_cdf(g, at) - std::stold(table.text(row, "cdf_from_minus1"))) < 1e-14L);
    const auto rounded = static_cast<Real>(g);
    const auto minus = static_cast<Real>(at.one_minus_mu);
    const auto plus = static_cast<Real>(at.one_plus_mu);
    CHECK(relative_error(pdf_henyey_greenstein_cosine(rounded, minus, plus),
                         exact_density(rounded, {minus, plus})) <= kPrecision);
    CHECK(std::abs(invert_henyey_greenstein(rounded, minus, plus) - exact_cdf(rounded, {minus, plus})) <=
          kPrecision);
  }
}

TEST_CASE("The density integrates to 1 and the samples follow it, however narrow the peak") {
  TestFamily family;
  for_each_g([&](Real g) {
    // In t = ln(c + term) the peak of width c = (1 - |g|)^2 is as wide as everything else.
    const double c = std::pow(1 - std::abs(double{g}), 2);
    const auto density = [&](double t, double) {
      const double toward = std::exp(t) - c;
      const auto minus = static_cast<Real>(g < 0 ? 2 - toward : toward);
      const auto plus = static_cast<Real>(g < 0 ? toward : 2 - toward);
      return pdf_henyey_greenstein_cosine(g, minus, plus) * std::exp(t);
    };
    const CellGrid grid{{std::log(c), 0}, {std::log(c + 2), 1}, 101, 3};
    check_unit_integral([&](double t) { return density(t, 0); }, grid.low[0], grid.high[0], 1e-6);
    const auto sample = [&](const Vec2& u) {
      const Deflection d = sample_henyey_greenstein(g, u.x);
      return std::array<double, 2>{std::log(c + (g < 0 ? d.one_plus_mu : d.one_minus_mu)), u.y};
    };
    family.add("g " + std::to_string(g), chi_square_p(sample, density, grid, 1'000'000));
  });
  family.check();
}

TEST_CASE("The density of a sampled deflection is the phase function of its two directions") {
  for (const Real g : {Real(-0.9), Real(-0.3), Real(0), Real(0.3), Real(0.9)}) {
    Random random = stream(3, 0, 0);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 from = sample_sphere({random.next(), random.next()});
      const Frame frame = make_frame(from);
      const Deflection d = sample_henyey_greenstein(g, random.next());
      const Vec2 azimuth = sample_azimuth(random.next());
      const Vec3 to = frame.to_world({d.sin_theta * azimuth.x, d.sin_theta * azimuth.y, d.mu});
      const double reported =
          pdf_henyey_greenstein_cosine(g, d.one_minus_mu, d.one_plus_mu) / (2 * glm::pi<double>());
      // Rounded directions move D = (1 - |g|)^2 + …, at least 0.01, by up to 2 sin theta eps: 5e-5 is ten
      // times that.
      check_same_density(reported, eval_henyey_greenstein(g, from, to), 5e-5);
    }
  }
}

TEST_CASE("Scattered directions about a tilted axis follow the phase function over the sphere") {
  TestFamily family;
  for (const Real g : {Real(-0.5), Real(0), Real(0.7)}) {
    const Vec3 from = glm::normalize(Vec3(Real(0.3), Real(-0.8), Real(-0.5)));
    const Frame frame = make_frame(from);
    const auto sample = [&](const Vec2& u) {
      const Deflection d = sample_henyey_greenstein(g, u.x);
      const Vec2 azimuth = sample_azimuth(u.y);
      const Vec3 to = frame.to_world({d.sin_theta * azimuth.x, d.sin_theta * azimuth.y, d.mu});
      return std::array<double, 2>{to.z, std::atan2(double{to.y}, double{to.x})};
    };
    const auto density = [&](double z, double phi) {
      const double sine = std::sqrt(std::max(0.0, 1 - z * z));
      return double{eval_henyey_greenstein(g, from, Vec3(sine * std::cos(phi), sine * std::sin(phi), z))};
    };
    const double pi = glm::pi<double>();
    family.add("g " + std::to_string(g),
               chi_square_p(sample, density, {{-1, -pi}, {1, pi}}, 1'000'000, 1e-4));
  }
  family.check();
}

TEST_CASE("Legendre moments of the samples are the powers of g") {
  const CsvTable table = reference_table("d1_hg_moments.csv");
  constexpr int kCount = 400'000;
  TestFamily family;
  for (std::size_t row = 0; row < table.rows.size(); row += 6) {
    const auto g = static_cast<Real>(table.number(row, "g"));
    std::array<double, 6> sums{};
    Random random = stream(8, static_cast<std::uint32_t>(row), 0);
    for (int i = 0; i < kCount; ++i) {
      const double mu = sample_henyey_greenstein(g, random.next()).mu;
      double before = 1, current = mu;  // Bonnet's recurrence
      for (int order = 1; order <= 6; ++order) {
        sums[order - 1] += current;
        const double next = ((2 * order + 1) * mu * current - order * before) / (order + 1);
        before = current;
        current = next;
      }
    }
    for (int order = 1; order <= 6; ++order) {
      const std::size_t at = row + order - 1;
      REQUIRE(table.text(at, "legendre_order").substr(1) == std::to_string(order));
      REQUIRE(table.text(at, "g") == table.text(row, "g"));
      const double error = table.number(at, "standard_deviation_of_one_sample") / std::sqrt(double(kCount));
      family.add("g " + table.text(at, "g") + " P" + std::to_string(order),
                 two_sided_p(z_score(sums[order - 1] / kCount, table.number(at, "expected_mean"), error)));
    }
  }
  family.check();
}

TEST_CASE("Inverting a deflection gives its random number back") {
  // Half the relative error of the terms is the sampler's, the other half room for the inverse's own
  // rounding.
  for_each_g([](Real g) {
    check_round_trip(
        [&](Real xi) { return sample_henyey_greenstein(g, xi); },
        [&](const Deflection& d) { return invert_henyey_greenstein(g, d.one_minus_mu, d.one_plus_mu); },
        2 * kPrecision);
  });
}

}  // namespace meander
