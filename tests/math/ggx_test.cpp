#include "math/ggx.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "support/check_sampler.h"

namespace meander {
namespace {

constexpr double kTwoPi = 2 * glm::pi<double>();
constexpr Real kAlphas[] = {Real(1e-4), Real(0.01), Real(0.1), Real(0.3), Real(0.7), Real(1)};

Vec3 view_at(double degrees) {
  const double angle = degrees * glm::pi<double>() / 180;
  return {static_cast<Real>(std::sin(angle)), 0, static_cast<Real>(std::cos(angle))};
}

// Normals by (angle of the slope in units of alpha, azimuth), in which every density here is smooth.
struct SlopeAngle {
  Vec3 normal;
  double solid_angle;  // per unit of both coordinates

  SlopeAngle(double alpha, double angle, double azimuth) {
    const double slope = alpha * std::tan(angle);
    const double cosine = 1 / std::sqrt(1 + slope * slope);
    const double sine = slope * cosine;
    normal = {static_cast<Real>(sine * std::cos(azimuth)), static_cast<Real>(sine * std::sin(azimuth)),
              static_cast<Real>(cosine)};
    solid_angle = sine * alpha / std::pow(std::cos(angle), 2) * cosine * cosine;
  }
};

// Integral over the hemisphere of normals.
template <class Function>
double integrate_normals(double alpha, const Function& f) {
  const auto integrand = [&](double angle, double azimuth) {
    const SlopeAngle at(alpha, angle, azimuth);
    return f(at.normal) * at.solid_angle;
  };
  return integrate_rectangle(integrand, {0, 0}, {kTwoPi / 4, kTwoPi}, 24);
}

}  // namespace

TEST_CASE("The facets, seen from above, cover the mean surface once") {
  for (const Real alpha : kAlphas) {
    CAPTURE(alpha);
    const double area = integrate_normals(alpha, [&](const Vec3& m) { return eval_ggx(alpha, m) * m.z; });
    CHECK(std::abs(area - 1) < 2e-6);
  }
}

TEST_CASE("The projected area is that of the facets which face the view, below the horizon too") {
  for (const Real alpha : kAlphas) {
    for (const double degrees : {0.0, 45.0, 85.0, 90.0, 100.0, 135.0}) {
      CAPTURE(alpha);
      CAPTURE(degrees);
      const Vec3 v = view_at(degrees);
      const double area = integrate_normals(
          alpha, [&](const Vec3& m) { return std::max(double{glm::dot(v, m)}, 0.0) * eval_ggx(alpha, m); });
      // The kink where facets turn away costs the quadrature a part of its digits.
      CHECK(std::abs(ggx_projected_area(alpha, v) - area) < 2e-4 * alpha + 2e-6);
      CHECK(ggx_projected_area(alpha, v) - ggx_projected_area(alpha, -v) == doctest::Approx(v.z));
    }
    CHECK(ggx_projected_area(alpha, {0, 0, 1}) == 1);
    CHECK(ggx_projected_area(alpha, {1, 0, 0}) == doctest::Approx(alpha / 2));
  }
}

TEST_CASE("Visible normals are unit vectors that face the view at the extreme random numbers") {
  for (const Real alpha : kAlphas) {
    for (const double degrees : {0.0, 60.0, 89.0, 89.99, 90.0, 91.0, 150.0}) {
      const Vec3 v = view_at(degrees);
      CAPTURE(alpha);
      CAPTURE(degrees);
      check_extremes<2>(
          [&](const std::array<Real, 2>& u) {
            return sample_visible_normal(alpha, v, {u[0], u[1]});
          },
          [&](const Vec3& m) {
            return std::abs(glm::length(m) - 1) < 4 * kRealEpsilon && m.z > 0 && m.z <= 1 &&
                   glm::dot(v, m) > -4 * kRealEpsilon;
          });
    }
  }
}

TEST_CASE("Visible normals follow their density, from above and from below") {
  TestFamily family;
  for (const Real alpha : kAlphas) {
    for (const double degrees : {0.0, 45.0, 80.0, 89.0, 95.0, 130.0}) {
      const Vec3 v = view_at(degrees);
      if (ggx_projected_area(alpha, v) < Real(1e-4)) continue;  // all in the outermost column of cells
      CAPTURE(alpha);
      CAPTURE(degrees);
      const auto sample = [&](const Vec2& u) {
        const Vec3 m = sample_visible_normal(alpha, v, u);
        const double slope = std::hypot(double{m.x}, double{m.y}) / m.z;
        const double azimuth = std::atan2(double{m.y}, double{m.x});
        return std::array<double, 2>{std::atan(slope / alpha), azimuth < 0 ? azimuth + kTwoPi : azimuth};
      };
      const auto density = [&](double angle, double azimuth) {
        const SlopeAngle at(alpha, angle, azimuth);
        return double{pdf_visible_normal(alpha, v, at.normal)} * at.solid_angle;
      };
      family.add("alpha " + std::to_string(alpha) + " view " + std::to_string(degrees),
                 chi_square_p(sample, density, {{0, 0}, {kTwoPi / 4, kTwoPi}}, 300'000, 2e-3));
    }
  }
  family.check();
}

TEST_CASE("Inverting a visible normal gives its random numbers back") {
  for (const Real alpha : kAlphas) {
    for (const double degrees : {0.0, 45.0, 80.0, 95.0}) {
      const Vec3 v = view_at(degrees);
      if (ggx_projected_area(alpha, v) < Real(1e-3)) continue;  // the inverse takes 1 - cosine plainly
      CAPTURE(alpha);
      CAPTURE(degrees);
      check_round_trip_2d([&](const Vec2& u) { return sample_visible_normal(alpha, v, u); },
                          [&](const Vec3& m) { return invert_visible_normal(alpha, v, m); },
                          2000 * kRealEpsilon,
                          [](const Vec2& u) { return u.x < Real(1e-3) || u.x > Real(0.999); });
    }
  }
}

TEST_CASE("The width is the square of the roughness, down to what float resolves") {
  CHECK(ggx_alpha(1) == 1);
  CHECK(ggx_alpha(Real(0.5)) == Real(0.25));
  CHECK(ggx_alpha(Real(0.001)) == kLeastGgxAlpha);
}

}  // namespace meander
