#include <doctest/doctest.h>

#include "math/random.h"
#include "math/warp.h"
#include "walk/analytic_worlds.h"
#include "walk/interface.h"

using namespace meander;

TEST_CASE("rays at an interface are unit, obey Snell's law, and stay on their sides") {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Random random = stream(1, 0, i);
    const Real u1 = random.next();
    const Real u2 = random.next();
    const Vec3 n(0, 0, 1);
    const Vec3 d = -sample_cosine_hemisphere({u1, u2});
    const Real eta = i % 2 ? Real(1.5) : Real(1 / 1.5);
    const InterfaceRay ray = meet_interface(d, n, eta);
    CHECK(glm::length(ray.reflected) == doctest::Approx(1).epsilon(1e-6));
    CHECK(ray.reflected.z >= 0);
    CHECK(ray.reflected.x == doctest::Approx(d.x).epsilon(1e-5));
    if (ray.reflectance == 1) {
      CHECK(eta < 1);
      continue;
    }
    CHECK(glm::length(ray.refracted) == doctest::Approx(1).epsilon(1e-6));
    CHECK(ray.refracted.z <= 0);
    CHECK(ray.refracted.x * eta == doctest::Approx(d.x).epsilon(1e-5));
  }
}

TEST_CASE("an interface of equal indices is not there") {
  const Vec3 d = glm::normalize(Vec3(Real(0.3), Real(0.2), -1));
  const InterfaceRay ray = meet_interface(d, {0, 0, 1}, 1);
  CHECK(ray.reflectance == 0);
  CHECK(glm::length(ray.refracted - d) < 1e-6);
}

TEST_CASE("a shading normal never sends a ray through the surface the wrong way") {
  for (std::uint32_t i = 0; i < 50000; ++i) {
    Random random = stream(2, 0, i);
    const Real u1 = random.next();
    const Real u2 = random.next();
    const Vec3 d = -sample_cosine_hemisphere({u1, u2});
    const Real tilt = Real(1.2) * random.next();
    const Vec3 shading(std::sin(tilt), 0, std::cos(tilt));
    const InterfaceRay ray = meet_interface(d, {0, 0, 1}, shading, i % 2 ? Real(1.5) : Real(1 / 1.5));
    CHECK(ray.reflected.z > 0);
    if (ray.reflectance < 1) CHECK(ray.refracted.z < 0);
  }
}

TEST_CASE("light that total reflection leads along a sphere does not come to a stop") {
  const SphereWorld world{2};
  for (std::uint32_t i = 0; i < 300; ++i) {
    Random random = stream(1, 0, i);
    const Vec2 u{random.next(), random.next()};
    const Vec3 normal = sample_sphere(u);
    const Real cosine = std::pow(Real(10), -2 - 6 * random.next());
    Vec3 position = Real(2) * normal;
    Vec3 direction =
        renormalise(std::sqrt(1 - cosine * cosine) * make_frame(normal).tangent - cosine * normal);
    for (int bounce = 0; bounce < 5000; ++bounce) {
      const Crossing crossing = world.first_crossing(position, direction, Real(1e9));
      position = crossing.point;
      if (bounce > 0) REQUIRE(crossing.distance > Real(1e-4));
      const InterfaceRay ray = meet_interface(direction, -crossing.normal, Real(1) / Real(1.5));
      REQUIRE(ray.reflectance == 1);
      direction = lift_off(ray.reflected, -crossing.normal);
    }
  }
}

TEST_CASE("light that total reflection leads into the edge of a turned box comes out of it again") {
  const double c = 0.7 * std::cos(0.5);
  const double s = 0.7 * std::sin(0.5);
  const BoxBody box{DMat3(c, 0, -s, 0, 0.7, 0, s, 0, c)};
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Random random = stream(3, 0, i);
    const Vec3 along(2 * random.next() - 1, 1, 1);  // on an edge
    const Vec2 u{random.next(), random.next()};
    Vec3 position = box.from_unit * along;
    Vec3 direction = sample_sphere(u);
    double way = 0;
    for (int bounce = 0; bounce < 100; ++bounce) {
      const Crossing crossing = box.first_crossing(position, direction, Real(1e9));
      REQUIRE(crossing.kind == CrossingKind::exit);
      REQUIRE(glm::dot(crossing.normal, direction) > Real(-1e-6));
      position = crossing.point;
      way += double{crossing.distance};
      direction =
          lift_off(renormalise(direction - 2 * glm::dot(direction, crossing.normal) * crossing.normal),
                   -crossing.normal);
    }
    CHECK(way > 1);
  }
}

TEST_CASE("light that skims a sphere, however rounding falls, goes on along it") {
  const SphereBody sphere{DMat3(1)};
  for (std::uint32_t i = 0; i < 200000; ++i) {
    Random random = stream(4, 0, i);
    const Vec2 u{random.next(), random.next()};
    const Vec3 normal = sample_sphere(u);
    const Vec3 position = sphere.snap(normal, normal);
    const Vec3 direction = lift_off(make_frame(normal).tangent, -normal);
    REQUIRE(sphere.first_crossing(position, direction, Real(1e9)).distance > kLeastCosine / 2);
  }
}
