#include "math/frame.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/henyey_greenstein.h"
#include "math/random.h"
#include "math/warp.h"
#include "support/check_sampler.h"

namespace meander {
namespace {

DVec3 exact(const Vec3& v) { return {v.x, v.y, v.z}; }

// Normals at random, along the axes, and about both poles at all scales.
std::vector<Vec3> make_normals() {
  std::vector<Vec3> normals;
  Random random = stream(1, 0, 0);
  for (int i = 0; i < 100'000; ++i) {
    const DVec3 direction = glm::normalize(exact(sample_sphere({random.next(), random.next()})));
    normals.emplace_back(direction);
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const Real sign : {Real(1), Real(-1)}) {
      Vec3 normal(0);
      normal[axis] = sign;
      normals.push_back(normal);
    }
  }
  normals.emplace_back(Real(0.6), Real(0.8), Real(-0.0));
  for (const double z : {1.0, -1.0}) {
    for (double tilt = 1; tilt > 1e-12; tilt *= 0.5) {
      const double azimuth = 1000 * tilt;
      normals.emplace_back(glm::normalize(DVec3(tilt * std::cos(azimuth), tilt * std::sin(azimuth), z)));
    }
  }
  return normals;
}

// The largest | |w|^2 - 1 | of a walk of 10^5 scatterings.
double worst_length(Real g) {
  Random random = stream(2, 0, 0);
  Vec3 direction(0, 0, 1);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Deflection d = sample_henyey_greenstein(g, random.next());
    const Vec2 azimuth = sample_azimuth(random.next());
    const Vec3 local(d.sin_theta * azimuth.x, d.sin_theta * azimuth.y, d.mu);
    direction = renormalise(make_frame(direction).to_world(local));
    worst = larger_error(worst, std::abs(glm::dot(exact(direction), exact(direction)) - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("Frames are orthonormal and right-handed to a few units in the last place") {
  double worst = 0;
  for (const Vec3& normal : make_normals()) {
    const Frame frame = make_frame(normal);
    const DVec3 t = exact(frame.tangent), b = exact(frame.bitangent), n = exact(frame.normal);
    CHECK(frame.normal == normal);
    for (const double error : {glm::dot(t, t) - 1, glm::dot(b, b) - 1, glm::dot(t, b), glm::dot(t, n),
                               glm::dot(b, n), glm::length(glm::cross(t, b) - n)}) {
      worst = larger_error(worst, std::abs(error));
    }
  }
  MESSAGE("worst deviation in epsilons: ", worst / kRealEpsilon);
  CHECK(worst <= 4 * kRealEpsilon);
}

TEST_CASE("The third axis of a frame is its normal, and to_local undoes to_world") {
  Random random = stream(3, 0, 0);
  double worst = 0;
  for (const Vec3& normal : make_normals()) {
    const Frame frame = make_frame(normal);
    const Vec3 v = sample_sphere({random.next(), random.next()});
    worst = larger_error(worst, glm::length(exact(frame.to_local(frame.to_world(v)) - v)));
    worst = larger_error(worst, glm::length(exact(frame.to_world({0, 0, 1}) - normal)));
    worst = larger_error(worst, std::abs(glm::dot(exact(frame.to_world(v)), exact(normal)) - double{v.z}));
  }
  CHECK(worst <= 8 * kRealEpsilon);
}

TEST_CASE("Renormalised directions stay unit over 10^5 scatterings") {
  for (const Real g : {Real(0), Real(0.9), Real(-0.9), Real(0.9999), Real(-0.9999)}) {
    CAPTURE(g);
    CHECK(worst_length(g) < 1e-5);
  }
}

TEST_CASE("One Newton step leaves an error of 3/2 of the square of the old one") {
  for (const Real off : {Real(0.02), Real(-0.02), Real(0.003)}) {
    const Vec3 v = (1 + off) * Vec3(Real(0.48), Real(0.6), Real(-0.64));
    const double length = glm::length(exact(renormalise(v)));
    CHECK(std::abs(length - 1 + 1.5 * off * off) < 0.6 * std::abs(off * off * off) + 4 * kRealEpsilon);
  }
}

}  // namespace meander
