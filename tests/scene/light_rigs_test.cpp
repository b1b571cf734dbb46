#include "scene/light_rigs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "math/color.h"
#include "scene/camera_moves.h"

using namespace meander;

namespace {

const Bounds kSubject{{9, -2, -1}, {12, 1, 3}};
constexpr Rig kRigs[] = {Rig::front, Rig::three_quarter, Rig::back, Rig::rim};

DVec3 center() { return 0.5 * (kSubject.low + kSubject.high); }
double half_diagonal() { return 0.5 * glm::length(kSubject.high - kSubject.low); }

const RectangleLight& rectangle(const Light& light) { return std::get<RectangleLight>(light.shape); }

const Light& named(const std::vector<Light>& lights, const std::string& name) {
  for (const Light& light : lights)
    if (light.name == name) return light;
  FAIL("no light " << name);
  return lights.front();
}

// Luminance that a surface at `point` which faces the light's centre receives, by brute force.
double irradiance(const RectangleLight& light, const DVec3& point) {
  constexpr int kSteps = 200;
  const DVec3 facing = glm::normalize(light.look_at - light.center);
  const DVec3 right = glm::normalize(glm::cross(facing, light.up));
  const DVec3 up = glm::cross(right, facing);
  const DVec3 normal = glm::normalize(light.center - point);
  const double area = light.width * light.height / (kSteps * kSteps);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const DVec3 at = light.center + ((i + 0.5) / kSteps - 0.5) * light.width * right +
                       ((j + 0.5) / kSteps - 0.5) * light.height * up;
      const DVec3 d = at - point;
      const double squared = glm::dot(d, d);
      sum += std::max(0.0, glm::dot(d, normal)) * std::max(0.0, -glm::dot(d, facing)) / (squared * squared);
    }
  return sum * area * static_cast<double>(luminance(light.radiance));
}

std::vector<Camera> cameras() {
  const Camera start;
  std::vector<Camera> all;
  for (const DVec3& direction : {DVec3(0, 0, 1), DVec3(1, 0.3, -0.5), DVec3(-1, 0, 0), DVec3(0.2, 2, 1),
                                 DVec3(0, 1, 0), DVec3(0, -1, 0)})
    all.push_back(view_from(start, kSubject, direction));
  Camera from_above;  // straight down, with north up in the picture
  from_above.look_at = center();
  from_above.look_from = center() + DVec3(0, 20, 0);
  from_above.up = {0, 0, -1};
  all.push_back(from_above);
  return all;
}

// The level direction from the subject toward the camera: below in the picture of one from above.
DVec3 level_heading(const Camera& camera) {
  const DVec3 back = glm::normalize(camera.look_from - camera.look_at);
  const DVec3 up = glm::cross(back, glm::normalize(glm::cross(camera.up, back)));
  return glm::normalize(DVec3(back.x, 0, back.z) * (1 - std::abs(back.y)) +
                        DVec3(up.x, 0, up.z) * (back.y > 0 ? -1.0 : 1.0));
}

}  // namespace

TEST_CASE("a surface that faces the key gets the stated irradiance in every rig, from every camera") {
  for (const Camera& camera : cameras()) {
    for (const Rig rig : kRigs) {
      const bool behind = rig == Rig::back || rig == Rig::rim;
      const std::vector<Light> lights = make_rig(rig, kSubject, camera);
      const double got = irradiance(rectangle(named(lights, "key")), center());
      CHECK(got == doctest::Approx((behind ? 1.5 : 1) * glm::pi<double>()).epsilon(1e-4));
      for (const Light& light : lights) CHECK(irradiance(rectangle(light), center()) <= got * (1 + 1e-6));
    }
  }
}

TEST_CASE("the key stands on the camera's side or behind the subject, above it, clear of it") {
  for (const Camera& camera : cameras()) {
    const DVec3 heading = level_heading(camera);
    for (const Rig rig : kRigs) {
      const std::vector<Light> lights = make_rig(rig, kSubject, camera);
      const DVec3 key = rectangle(named(lights, "key")).center - center();
      const double toward_camera = glm::dot(glm::normalize(DVec3(key.x, 0, key.z)), heading);
      if (rig == Rig::front) CHECK(toward_camera > 0.9);
      if (rig == Rig::three_quarter) CHECK(toward_camera > 0.5);
      if (rig == Rig::back) CHECK(toward_camera < -0.9);
      if (rig == Rig::rim) CHECK(toward_camera < -0.6);
      for (const Light& light : lights) {
        const RectangleLight& r = rectangle(light);
        CHECK(r.look_at == center());
        CHECK(r.center.y - 0.5 * r.height > kSubject.low.y);
        CHECK(glm::distance(r.center, center()) - 0.5 * std::hypot(r.width, r.height) > half_diagonal());
        CHECK_FALSE(light.visible);
      }
    }
  }
}

TEST_CASE(
    "light from behind comes with a dim one in front, and the lights of a rig have names of their own") {
  const Camera camera = cameras().front();
  for (const Rig rig : {Rig::back, Rig::rim}) {
    const std::vector<Light> lights = make_rig(rig, kSubject, camera);
    const RectangleLight& fill = rectangle(named(lights, "fill"));
    CHECK(glm::dot(fill.center - center(), camera.look_from - camera.look_at) > 0);
    const double share = irradiance(fill, center()) / irradiance(rectangle(named(lights, "key")), center());
    CHECK(share > 0.02);
    CHECK(share < 0.15);
  }
  for (const Rig rig : kRigs) {
    std::set<std::string> names;
    const std::vector<Light> lights = make_rig(rig, kSubject, camera);
    for (const Light& light : lights) names.insert(light.name);
    CHECK(names.size() == lights.size());
  }
}

TEST_CASE("a rig scales with its subject, and stands about a point too") {
  const Camera camera;
  const Bounds large{kSubject.low * 1000.0, kSubject.high * 1000.0};
  const auto small_key = rectangle(make_rig(Rig::back, kSubject, camera).front());
  const auto large_key = rectangle(make_rig(Rig::back, large, camera).front());
  CHECK(large_key.width == doctest::Approx(1000 * small_key.width));
  CHECK(large_key.center.x == doctest::Approx(1000 * small_key.center.x));
  CHECK(large_key.radiance == small_key.radiance);
  CHECK(rectangle(make_rig(Rig::rim, {DVec3(2), DVec3(2)}, camera).front()).width > 0);
}

TEST_CASE("a light that is orbited keeps its distance and turns by the degrees asked") {
  const DVec3 about(1, 2, 3);
  const Light start{"key", RectangleLight{{1, 2, 7}, {5, 5, 5}, {0, 1, 0}, 2, 1, Rgb(3)}, true};
  const Light side = orbit_light(start, about, 90, 0);
  CHECK(glm::distance(rectangle(side).center, DVec3(5, 2, 3)) < 1e-12);
  CHECK(rectangle(side).look_at == about);
  CHECK(rectangle(side).width == 2);
  CHECK(side.visible);
  CHECK(side.name == "key");
  const RectangleLight raised = rectangle(orbit_light(start, about, 0, 30));
  CHECK(raised.center.y == doctest::Approx(2 + 4 * 0.5));
  CHECK(raised.center.z == doctest::Approx(3 + 4 * std::sqrt(0.75)));
  const RectangleLight pole = rectangle(orbit_light(start, about, 0, 500));
  CHECK(std::asin((pole.center.y - 2) / 4) == doctest::Approx(glm::radians(89.0)));
  CHECK(glm::length(glm::cross(glm::normalize(about - pole.center), pole.up)) > 0.01);
  Light light = start;
  for (int i = 0; i < 10000; ++i) light = orbit_light(light, about, 37, i % 2 ? 50 : -49);
  CHECK(glm::distance(rectangle(light).center, about) == doctest::Approx(4).epsilon(1e-9));
}

TEST_CASE("spheres, points and the sun orbit too") {
  const DVec3 about(0, 1, 0);
  const Light sphere = orbit_light({"s", SphereLight{{0, 1, 2}, 0.5, Rgb(1)}}, about, 90, 0);
  CHECK(glm::distance(std::get<SphereLight>(sphere.shape).center, DVec3(2, 1, 0)) < 1e-12);
  const Light point = orbit_light({"p", PointLight{{0, 1, 2}, Rgb(1)}}, about, -90, 0);
  CHECK(glm::distance(std::get<PointLight>(point.shape).position, DVec3(-2, 1, 0)) < 1e-12);
  // Light that travels along -z comes from +z.
  const Light sun = orbit_light({"d", DirectionalLight{{0, 0, -3}, Rgb(1)}}, about, 90, 0);
  CHECK(glm::distance(std::get<DirectionalLight>(sun.shape).direction, DVec3(-3, 0, 0)) < 1e-12);
  const Light high = orbit_light({"d", DirectionalLight{{0, 0, -3}, Rgb(1)}}, about, 0, 30);
  CHECK(std::get<DirectionalLight>(high.shape).direction.y == doctest::Approx(-1.5));
  const Light still = orbit_light({"p", PointLight{about, Rgb(1)}}, about, 10, 10);
  CHECK(std::get<PointLight>(still.shape).position == about);
}
