#include "math/fresnel.h"

#include <doctest/doctest.h>
#include <cmath>

#include "support/check_sampler.h"
#include "support/csv.h"

namespace meander {
namespace {

constexpr Real kIndices[] = {Real(1.1), Real(1.33), Real(1.5), Real(2)};

// Twice the integral of F(mu) mu over [from, 1], with mu = from + (1 - from) t^2, which smooths the square
// root at grazing and at the critical angle.
double lambertian_average(Real eta, double from) {
  const auto integrand = [&](double t) {
    const double mu = from + (1 - from) * t * t;
    return double{eval_fresnel(static_cast<Real>(mu), eta).reflectance} * 2 * mu * 2 * (1 - from) * t;
  };
  return integrate(integrand, 0, 1, 1e-8, 12);
}

// The same by Snell's law and both amplitudes, in 64-bit mantissas; the cosine behind from the sine.
long double exact_reflectance(long double cos_i, long double eta) {
  const long double cos2_t = 1 - (1 - cos_i * cos_i) / (eta * eta);
  if (cos2_t <= 0) return 1;
  const long double cos_t = std::sqrt(cos2_t);
  const long double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const long double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

}  // namespace

TEST_CASE("Fresnel averages over Lambertian light are the tabulated ones, from outside and from inside") {
  const CsvTable table = reference_table("e1b_fresnel_averages.csv");
  REQUIRE(table.rows.size() == 4);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double eta = table.number(row, "eta");
    const auto outside = static_cast<Real>(eta);
    const auto inside = static_cast<Real>(1 / eta);
    const double critical = std::sqrt(1 - 1 / (eta * eta));
    CAPTURE(eta);
    CHECK(std::abs(eval_fresnel(1, outside).reflectance - table.number(row, "F_normal")) < 2e-7);
    CHECK(std::abs(eval_fresnel(1, inside).reflectance - table.number(row, "F_normal")) < 2e-7);
    CHECK(std::abs(lambertian_average(outside, 0) - table.number(row, "F_diffuse_external")) < 1e-6);
    const double internal = critical * critical + lambertian_average(inside, critical);
    CHECK(std::abs(internal - table.number(row, "F_diffuse_internal")) < 2e-6);
  }
}

TEST_CASE("Fresnel reflectance agrees with extended precision at all angles and indices") {
  for (const Real eta : {Real(1.0001), Real(1.1), Real(1.5), Real(3)}) {
    double worst = 0;
    for (int i = 1; i <= 10'000; ++i) {
      for (const Real cos_i : {Real(i * 1e-4), Real(i * 1e-8)}) {
        const double expected = static_cast<double>(exact_reflectance(cos_i, eta));
        worst = larger_error(worst, std::abs(eval_fresnel(cos_i, eta).reflectance - expected));
      }
    }
    CAPTURE(eta);
    CHECK(worst < 8 * kRealEpsilon);
  }
}

TEST_CASE("Nothing passes beyond the critical angle, and something before it") {
  for (const Real eta : kIndices) {
    const double critical = std::sqrt(1 - 1 / (double{eta} * eta));
    for (const double below : {0.0, 0.5, 0.9, 0.9999}) {
      const Fresnel total = eval_fresnel(static_cast<Real>(critical * below), 1 / eta);
      CHECK(total.reflectance == 1);
      CHECK(total.cos_t == 0);
    }
    const Fresnel partial = eval_fresnel(static_cast<Real>(critical * 1.0001), 1 / eta);
    CHECK(partial.reflectance < 1);
    CHECK(partial.cos_t > 0);
  }
}

TEST_CASE("At grazing incidence everything is reflected") {
  for (const Real eta : kIndices) CHECK(eval_fresnel(0, eta).reflectance == 1);
}

TEST_CASE("Equal indices reflect nothing and bend nothing, at grazing angles too") {
  for (const double cos_i : {1.0, 0.7, 0.1, 1e-2, 1e-3, 1e-4, 1e-6}) {
    const auto c = static_cast<Real>(cos_i);
    CAPTURE(c);
    CHECK(eval_fresnel(c, 1).reflectance < 1e-12);
    CHECK(eval_fresnel(c, 1).cos_t == doctest::Approx(c).epsilon(1e-6));
  }
}

TEST_CASE("At Brewster's angle only the perpendicular half is reflected") {
  for (const Real eta : kIndices) {
    const double n2 = double{eta} * eta;
    const double perpendicular = (n2 - 1) / (n2 + 1);
    const Fresnel f = eval_fresnel(static_cast<Real>(1 / std::sqrt(1 + n2)), eta);
    CHECK(f.reflectance == doctest::Approx(0.5 * perpendicular * perpendicular).epsilon(1e-5));
    CHECK(f.cos_t == doctest::Approx(double{eta} / std::sqrt(1 + n2)).epsilon(1e-6));
  }
}

TEST_CASE("Reflectance is the same along the reversed ray, whose refraction returns the incident cosine") {
  for (const Real eta : kIndices) {
    for (int i = 1; i <= 50; ++i) {
      const Real cos_i = Real(i) / 50;
      const Fresnel there = eval_fresnel(cos_i, eta);
      const Fresnel back = eval_fresnel(there.cos_t, 1 / eta);
      CAPTURE(cos_i);
      // Near grazing the rounding of cos_t comes back divided by cos_i.
      CHECK(std::abs(back.cos_t - cos_i) < 8 * kRealEpsilon / cos_i);
      CHECK(std::abs(back.reflectance - there.reflectance) < 32 * kRealEpsilon / cos_i);
      CHECK((there.reflectance > 0 && there.reflectance < 1));
    }
  }
}

TEST_CASE("Snell's law holds between the two cosines") {
  for (const Real eta : {Real(1.5), Real(0.9)}) {
    for (const Real cos_i : {Real(1), Real(0.9), Real(0.6)}) {
      const double cos_t = eval_fresnel(cos_i, eta).cos_t;
      const double sin2_i = 1 - double{cos_i} * cos_i;
      CHECK(double{eta} * eta * (1 - cos_t * cos_t) == doctest::Approx(sin2_i).epsilon(1e-5));
    }
  }
}

}  // namespace meander
