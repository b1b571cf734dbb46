#include "math/warp.h"

#include <doctest/doctest.h>
#include <array>
#include <cmath>
#include <string>

#include "math/random.h"
#include "stats/moments.h"
#include "support/check_sampler.h"

namespace meander {
namespace {

constexpr Real kCones[] = {Real(2), Real(1), Real(0.1), Real(1e-3), Real(1e-7)};
constexpr double kTurn = 6.283185307179586;

double squared_length(const Vec3& v) { return glm::dot(DVec3(v), DVec3(v)); }

double turns(const Vec3& v) {
  const double phi = std::atan2(double{v.y}, double{v.x});
  return (phi < 0 ? phi + kTurn : phi) / kTurn;
}

// 1 - cos theta without cancellation.
double depth_of(const Vec3& v) {
  const double sin2 = double{v.x} * v.x + double{v.y} * v.y;
  return v.z > 0 ? sin2 / (1 + double{v.z}) : 1 - double{v.z};
}

bool is_unit(const Vec3& v) { return std::abs(squared_length(v) - 1) <= 8 * kRealEpsilon; }

bool never(const Vec2&) { return false; }

}  // namespace

TEST_CASE("Every warp gives unit vectors, at the corners of the unit square and between") {
  const auto cosine = [](const std::array<Real, 2>& u) { return sample_cosine_hemisphere({u[0], u[1]}); };
  check_extremes<2>(cosine, [](const Vec3& v) { return is_unit(v) && v.z > 0; });
  check_extremes<2>([](const auto& u) { return sample_sphere({u[0], u[1]}); }, is_unit);
  for (const Real cone : kCones) {
    check_extremes<2>(
        [&](const auto& u) {
          return sample_cone(cone, {u[0], u[1]});
        },
        [&](const Vec3& v) { return is_unit(v) && v.z >= 1 - cone - 2 * kRealEpsilon; });
  }
  double worst = 0;
  Random random = stream(1, 0, 0);
  for (int i = 0; i < 200'000; ++i) {
    const Real first = random.next();
    const Vec2 u(first, random.next());
    for (const Vec3& v : {sample_cosine_hemisphere(u), sample_sphere(u), sample_cone(Real(1e-3), u)}) {
      worst = larger_error(worst, std::abs(squared_length(v) - 1));
    }
  }
  CHECK(worst <= 8 * kRealEpsilon);
}

TEST_CASE("Cosine-distributed directions follow the cosine, which integrates to 1") {
  const auto sample = [](const Vec2& u) {
    const Vec3 v = sample_cosine_hemisphere(u);
    return std::array<double, 2>{v.z, turns(v)};
  };
  const auto density = [](double z, double) { return pdf_cosine_hemisphere(static_cast<Real>(z)) * kTurn; };
  CHECK(chi_square_p(sample, density, {{0, 0}, {1, 1}}, 1'000'000) > 1e-3);
  CHECK(pdf_cosine_hemisphere(Real(-0.5)) == 0);
  CHECK(pdf_cosine_hemisphere(1) == doctest::Approx(2 / kTurn).epsilon(1e-6));
  Moments cosine;
  Random random = stream(2, 0, 0);
  for (int i = 0; i < 500'000; ++i) cosine.add(sample_cosine_hemisphere({random.next(), Real(0.3)}).z);
  CHECK(two_sided_p(z_score(cosine.mean, 2.0 / 3, cosine.standard_error())) > 1e-3);
}

TEST_CASE("Directions on the sphere are uniform, with density 1 over 4 pi") {
  const auto sample = [](const Vec2& u) {
    const Vec3 v = sample_sphere(u);
    return std::array<double, 2>{v.z, turns(v)};
  };
  const auto density = [](double, double) { return pdf_sphere() * kTurn; };
  CHECK(chi_square_p(sample, density, {{-1, 0}, {1, 1}}, 1'000'000) > 1e-3);
}

TEST_CASE("Directions in a cone are uniform down to a half-angle of 1.5 minutes of arc") {
  TestFamily family;
  for (const Real cone : kCones) {
    const auto sample = [&](const Vec2& u) {
      const Vec3 v = sample_cone(cone, u);
      return std::array<double, 2>{depth_of(v) / cone, turns(v)};
    };
    const auto density = [&](double, double) { return pdf_cone(cone) * cone * kTurn; };
    family.add("cone " + std::to_string(cone), chi_square_p(sample, density, {{0, 0}, {1, 1}}, 500'000));
  }
  family.check();
}

TEST_CASE("A cone's depth is exact however narrow it is") {
  Random random = stream(3, 0, 0);
  double worst = 0;
  for (const Real cone : {Real(0.1), Real(1e-3), Real(1e-7)}) {
    for (int i = 0; i < 20'000; ++i) {
      const Real u = random.next();
      if (u == 0) continue;
      const double expected = double{u} * double{cone};
      const double sin2_expected = expected * (2 - expected);
      const Vec3 v = sample_cone(cone, {u, random.next()});
      const double sin2 = double{v.x} * v.x + double{v.y} * v.y;
      worst = larger_error(worst, std::abs(sin2 / sin2_expected - 1));
    }
  }
  CHECK(worst <= 6 * kRealEpsilon);
}

TEST_CASE("A whole-sphere cone is the sphere") {
  CHECK(pdf_cone(2) == doctest::Approx(double{pdf_sphere()}).epsilon(1e-6));
  CHECK(sample_cone(2, {Real(0.5), 0}).z == 0);
}

TEST_CASE("Inverting a direction gives its two random numbers back") {
  check_round_trip_2d(sample_cosine_hemisphere, invert_cosine_hemisphere, 4 * kRealEpsilon,
                      [](const Vec2& u) { return u.x == 0; });
  check_round_trip_2d(sample_sphere, invert_sphere, 4 * kRealEpsilon, [](const Vec2& u) { return u.x == 0; });
  for (const Real cone : kCones) {
    CAPTURE(cone);
    check_round_trip_2d([&](const Vec2& u) { return sample_cone(cone, u); },
                        [&](const Vec3& v) { return invert_cone(cone, v); }, 8 * kRealEpsilon,
                        [](const Vec2& u) { return u.x == 0; });
  }
  check_round_trip_2d([](const Vec2& u) { return Vec3(sample_azimuth(u.y), u.x); },
                      [](const Vec3& v) { return Vec2(v.z, invert_azimuth(v.x, v.y)); }, 4 * kRealEpsilon,
                      never);
}

TEST_CASE("An inverted azimuth is a random number: at least 0, below 1") {
  for (const Real tiny : {Real(0), Real(1e-3), Real(1e-9), Real(1e-30)}) {
    for (const Real sign : {Real(1), Real(-1)}) {
      const Real u = invert_azimuth(1, sign * tiny);
      CAPTURE(sign * tiny);
      CHECK(u >= 0);
      CHECK(u < 1);
    }
  }
}

}  // namespace meander
