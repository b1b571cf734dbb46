#include "scene/sky.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scene/environment_image.h"

using namespace meander;

namespace {

// Irradiance on a surface at the centre, by quadrature over the sphere.
DVec3 irradiance(const EnvironmentImage& sky, const Vec3& normal) {
  constexpr int kRows = 512;
  DVec3 sum(0);
  for (int i = 0; i < kRows; ++i) {
    const double height = 1 - (2 * i + 1.0) / kRows;
    for (int j = 0; j < 2 * kRows; ++j) {
      const double azimuth = (j + 0.5) * glm::pi<double>() / kRows;
      const double level = std::sqrt(1 - height * height);
      const Vec3 d(level * std::sin(azimuth), height, level * std::cos(azimuth));
      sum += DVec3(sky.radiance(d)) * std::max(0.0, static_cast<double>(glm::dot(d, normal)));
    }
  }
  return sum * (2 * glm::pi<double>() / (kRows * kRows));
}

Vec3 direction(double azimuth, double elevation) {  // from -z toward +x
  const double a = glm::radians(azimuth);
  const double e = glm::radians(elevation);
  return Vec3(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
}

}  // namespace

TEST_CASE("the overcast sky has its closed-form irradiance and thrice the horizon's radiance at the zenith") {
  const EnvironmentImage sky(make_sky(Sky::overcast));
  CHECK(irradiance(sky, Vec3(0, 1, 0)).y == doctest::Approx(7 * glm::pi<double>() / 9).epsilon(1e-3));
  // A vertical surface: 1/3 (pi/2 + 4/3) of the sky, and half the ground.
  const double vertical = (glm::pi<double>() / 2 + 4.0 / 3) / 3 + 0.2 * 7 / 9 * glm::pi<double>() / 2;
  CHECK(irradiance(sky, Vec3(0, 0, 1)).x == doctest::Approx(vertical).epsilon(1e-3));
  CHECK(irradiance(sky, Vec3(1, 0, 0)).z == doctest::Approx(vertical).epsilon(1e-3));
  CHECK(irradiance(sky, Vec3(0, -1, 0)).x == doctest::Approx(0.2 * 7 / 9 * glm::pi<double>()).epsilon(1e-3));
  CHECK(sky.radiance(Vec3(0, 1, 0)).x == doctest::Approx(1).epsilon(1e-3));
  CHECK(sky.radiance(direction(30, 0.2)).x == doctest::Approx(1.0 / 3).epsilon(0.03));
  CHECK(sky.radiance(direction(77, 30)).y == doctest::Approx(2.0 / 3).epsilon(0.03));
}

TEST_CASE("the softbox is bright panels in a dim surround, the strongest behind the subject") {
  const EnvironmentImage sky(make_sky(Sky::softbox));
  const Rgb back = sky.radiance(direction(-20, 38));
  const Rgb front = sky.radiance(direction(140, 40));
  const Rgb side = sky.radiance(direction(-105, 15));
  const Rgb surround = sky.radiance(direction(60, -30));
  CHECK(back.x > 2 * front.x);
  CHECK(front.x > side.x);
  CHECK(side.x > 20 * surround.x);
  CHECK(surround.x > 0);
  const double from_behind = irradiance(sky, Vec3(0, 0, -1)).y;
  const double from_front = irradiance(sky, Vec3(0, 0, 1)).y;
  CHECK(from_behind > 1.5 * from_front);
  CHECK(from_front > 0.5);
  CHECK(from_behind < 8);
}

TEST_CASE("skies are plain pictures: always the same, finite, and turned and scaled like any other") {
  for (const Sky sky : {Sky::softbox, Sky::overcast}) {
    const Image image = make_sky(sky);
    CHECK(image.width == 256);
    CHECK(image.height == 128);
    CHECK(image.values == make_sky(sky).values);
    CHECK(std::all_of(image.values.begin(), image.values.end(), [](float v) { return v > 0 && v < 20; }));
  }
  const EnvironmentImage plain(make_sky(Sky::softbox));
  const EnvironmentImage turned(plain, 90, 2);
  // At +90 what was seen along -z is seen along -x.
  const Rgb before = plain.radiance(direction(-20, 38));
  const Rgb after = turned.radiance(direction(-110, 38));
  CHECK(after.x == doctest::Approx(2 * before.x));
}
