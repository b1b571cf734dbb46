#include <doctest/doctest.h>

#include <cmath>

#include "math/random.h"
#include "math/warp.h"
#include "walk/analytic_worlds.h"

using namespace meander;

namespace {

constexpr Real kFar = std::numeric_limits<Real>::infinity();

Vec3 random_direction(Random& random) {
  const Real u1 = random.next();
  const Real u2 = random.next();
  return sample_sphere({u1, u2});
}

}  // namespace

TEST_CASE("the sphere's exit distance agrees with double precision, from anywhere inside") {
  const SphereWorld world{Real(2.5)};
  const SphereBody body{DMat3(2.5)};
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random = stream(1, 0, i);
    const Vec3 p = Real(2.5) * std::cbrt(random.next()) * random_direction(random);
    const Vec3 d = random_direction(random);
    const double b = glm::dot(DVec3(p), DVec3(d));
    const double c = glm::dot(DVec3(p), DVec3(p)) - 6.25;
    const double dd = glm::dot(DVec3(d), DVec3(d));
    const double exact = (-b + std::sqrt(std::max(b * b - c * dd, 0.0))) / dd;
    // Near the rim a grazing distance magnifies rounding by its own inverse.
    const double tolerance = 2e-6 + 2e-6 / std::max(exact, 1e-3);
    CHECK(std::abs(double{world.first_crossing(p, d, kFar).distance} - exact) < tolerance);
    CHECK(std::abs(double{body.first_crossing(p, d, kFar).distance} - exact) < tolerance);
  }
}

TEST_CASE("an exit lies on the surface, with the outward normal") {
  const SphereBody ellipsoid{DMat3(2, 0, 0, 0, 0.5, 0, 0, 0, 1)};
  const BoxBody box{DMat3(1, 0, 0, 0, 3, 0, 0, 0, 0.25)};
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Random random = stream(2, 0, i);
    const Vec3 d = random_direction(random);
    const Crossing round = ellipsoid.first_crossing(Vec3(0), d, kFar);
    REQUIRE(round.kind == CrossingKind::exit);
    const Vec3 unit = round.point / Vec3(2, Real(0.5), 1);
    CHECK(glm::length(unit) == doctest::Approx(1).epsilon(1e-6));
    CHECK(glm::length(round.normal - glm::normalize(unit / Vec3(2, Real(0.5), 1))) < 1e-5);
    const Crossing flat = box.first_crossing(Vec3(0), d, kFar);
    REQUIRE(flat.kind == CrossingKind::exit);
    CHECK(glm::dot(flat.normal, d) > 0);
    const Vec3 face = glm::abs(flat.point / Vec3(1, 3, Real(0.25)));
    CHECK(largest(face) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("a step that ends before the surface stays inside and one that would pass it is cut there") {
  const SlabWorld slab{2};
  const Crossing inside = slab.first_crossing({0, 0, -1}, {0, 0, 1}, Real(0.5));
  CHECK(inside.kind == CrossingKind::none);
  CHECK(inside.point.z == Real(-0.5));
  const Crossing up = slab.first_crossing({0, 0, -1}, {0, 0, 1}, 5);
  CHECK(up.kind == CrossingKind::exit);
  CHECK(up.distance == 1);
  CHECK(up.normal.z == 1);
  const Crossing down = slab.first_crossing({0, 0, -1}, {0, 0, -1}, 5);
  CHECK(down.point.z == -2);
  CHECK(down.normal.z == -1);
  CHECK(slab.first_crossing({0, 0, -1}, {1, 0, 0}, 1e6f).kind == CrossingKind::none);
  CHECK(slab.first_crossing({0, 0, -1}, {1, 0, 0}, kFar).kind == CrossingKind::leaked);
  CHECK(HalfSpaceWorld{}.first_crossing({0, 0, -1}, {0, 0, -1}, kFar).kind == CrossingKind::leaked);
}

TEST_CASE("a point that rounding put just outside leaves at once, in every direction outward") {
  const SphereWorld world{1};
  const SphereBody body{DMat3(1)};
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Random random = stream(3, 0, i);
    const Vec3 n = random_direction(random);
    const Vec3 p = n * Real(1 + 3e-7);
    Vec3 d = random_direction(random);
    if (glm::dot(d, n) < 0) d = -d;
    CHECK(world.first_crossing(p, d, 10).distance < 1e-5);
    CHECK(body.first_crossing(p, d, 10).distance < 1e-5);
  }
}
