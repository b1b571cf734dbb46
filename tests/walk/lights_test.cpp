#include <doctest/doctest.h>

#include "math/warp.h"
#include "stats/moments.h"
#include "support/check_sampler.h"
#include "walk/lights.h"

using namespace meander;

namespace {

Light rectangle() { return {"r", RectangleLight{{0, 3, 1}, {0, 0, 0}, {0, 1, 0}, 2, 1, Rgb(2)}, false}; }
Light sphere(double radius) { return {"s", SphereLight{{0, 3, 0}, radius, Rgb(2)}, false}; }

}  // namespace

TEST_CASE("a sampled direction hits the light, at the same distance and with the same density") {
  for (const Light& light : {rectangle(), sphere(1), sphere(1e-3), sphere(2.9999)}) {
    for (std::uint32_t i = 0; i < 20000; ++i) {
      Random random = stream(1, 0, i);
      const DVec3 point(random.next() * 0.01, 0, random.next() * 0.01);
      const Real u1 = random.next();
      const Real u2 = random.next();
      const auto sample = sample_light(light, point, {u1, u2});
      REQUIRE(sample);
      REQUIRE(!sample->delta);
      CHECK(glm::length(sample->direction) == doctest::Approx(1).epsilon(1e-6));
      const auto hit = hit_light(light, {point, sample->direction});
      if (!hit) {  // only on the rim, where rounding decides
        CHECK(std::min({u1, u2, 1 - u1, 1 - u2}) < 1e-4);
        continue;
      }
      CHECK(hit->distance == doctest::Approx(sample->distance).epsilon(1e-3));
      check_same_density(sample->pdf, hit->pdf, 2e-5);
    }
  }
}

TEST_CASE("a light's density integrates to 1 over the directions that hit it") {
  // Uniform directions, importance 1: E[pdf 4 pi] = 1 where the light is hit.
  for (const Light& light : {rectangle(), sphere(1), sphere(2.5), sphere(5)}) {
    Moments moments;
    for (std::uint32_t i = 0; i < 400000; ++i) {
      Random random = stream(2, 0, i);
      const Real u1 = random.next();
      const Real u2 = random.next();
      const auto hit = hit_light(light, {DVec3(0.1, 0, 0), sample_sphere({u1, u2})});
      moments.add(hit ? hit->pdf * 4 * glm::pi<double>() : 0);
    }
    CHECK(std::abs(moments.mean - 1) < 4 * moments.standard_error() + 1e-5);
  }
}

TEST_CASE("a rectangle shines from the side toward look_at only") {
  CHECK(sample_light(rectangle(), DVec3(0, 0, 0), {Real(0.5), Real(0.5)}));
  CHECK_FALSE(sample_light(rectangle(), DVec3(0, 6, 2), {Real(0.5), Real(0.5)}));
  CHECK_FALSE(hit_light(rectangle(), {DVec3(0, 6, 2), glm::normalize(Vec3(0, -3, -1))}));
}

TEST_CASE("point and directional lights carry intensity over squared distance, and irradiance") {
  const Light point{"p", PointLight{{0, 2, 0}, Rgb(8)}, false};
  const auto sample = sample_light(point, DVec3(0), {0, 0});
  REQUIRE(sample);
  CHECK(sample->delta);
  CHECK(sample->radiance.x == doctest::Approx(2));
  CHECK(sample->direction.y == 1);
  const Light sun{"d", DirectionalLight{{0, -5, 0}, Rgb(3)}, false};
  const auto parallel = sample_light(sun, DVec3(1e6, 0, 0), {0, 0});
  REQUIRE(parallel);
  CHECK(parallel->radiance.x == 3);
  CHECK(parallel->direction.y == 1);
  CHECK(std::isinf(parallel->distance));
  CHECK_FALSE(hit_light(point, {DVec3(0), Vec3(0, 1, 0)}));
}

TEST_CASE("a light far from the origin is sampled as at the origin") {
  const DVec3 shift(65536, -131072, 262144);
  Light far = rectangle();
  auto& shape = std::get<RectangleLight>(far.shape);
  shape.center += shift;
  shape.look_at += shift;
  const auto near_sample = sample_light(rectangle(), DVec3(0.25, 0, 0), {Real(0.3), Real(0.7)});
  const auto far_sample = sample_light(far, DVec3(0.25, 0, 0) + shift, {Real(0.3), Real(0.7)});
  REQUIRE(near_sample);
  REQUIRE(far_sample);
  CHECK(glm::length(near_sample->direction - far_sample->direction) < 1e-6);
  CHECK(far_sample->pdf == doctest::Approx(near_sample->pdf).epsilon(1e-6));
}

TEST_CASE("an environment image is the light after the last, infinitely far, in the environment's group") {
  Scene scene;
  scene.lights = {sphere(1), rectangle()};
  CHECK(count_sampled_lights(scene) == 2);
  Image picture(4, 2, 3);
  picture.at(1, 0)[0] = 2;
  scene.environment.image = std::make_shared<const EnvironmentImage>(picture);
  REQUIRE(count_sampled_lights(scene) == 3);
  CHECK(light_group(scene, 0) == 1);
  CHECK(light_group(scene, 1) == 2);
  CHECK(light_group(scene, 2) == 0);
  const DVec3 point(0.5, 0, 0);
  const auto sample = sample_light(scene, 2, point, {Real(0.3), Real(0.4)});
  REQUIRE(sample);
  CHECK_FALSE(sample->delta);
  CHECK(std::isinf(sample->distance));
  CHECK(sample->radiance == Rgb(2, 0, 0));
  CHECK(sample->pdf == doctest::Approx(2 / glm::pi<double>()));  // one of eight equal parts of the sphere
  CHECK(sample->pdf == scene.environment.image->pdf(sample->direction));
  const auto listed = sample_light(scene, 1, point, {Real(0.3), Real(0.4)});
  REQUIRE(listed);
  CHECK(listed->direction == sample_light(rectangle(), point, {Real(0.3), Real(0.4)})->direction);
  scene.environment.image = std::make_shared<const EnvironmentImage>(Image(4, 2, 3));
  CHECK_FALSE(sample_light(scene, 2, point, {Real(0.3), Real(0.4)}));
}
