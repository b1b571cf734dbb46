#include <doctest/doctest.h>

#include <cmath>

#include "scene/camera_rays.h"

using namespace meander;

TEST_CASE("the middle of the film looks at look_at, and row 0 is at the top") {
  const Camera camera{{1, 2, 3}, {1, 2, -7}, {0, 1, 0}, 90, {}};
  const CameraRays rays = make_camera_rays(camera, 200, 100);
  CHECK(glm::length(rays.at(0.5, 0.5).direction - Vec3(0, 0, -1)) < 1e-6);
  // 90 degrees high: the top edge is 45 degrees up, and the film is twice as wide.
  CHECK(glm::length(rays.at(0.5, 0).direction - glm::normalize(Vec3(0, 1, -1))) < 1e-6);
  CHECK(glm::length(rays.at(1, 0.5).direction - glm::normalize(Vec3(2, 0, -1))) < 1e-6);
  CHECK(rays.at(0, 0).origin == camera.look_from);
}

TEST_CASE("an orthographic film shows its full height, with parallel rays") {
  const Camera camera{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, 2.5};
  const CameraRays rays = make_camera_rays(camera, 64, 64);
  CHECK(rays.at(0.5, 0).origin.y == doctest::Approx(1.25));
  CHECK(rays.at(1, 0.5).origin.x == doctest::Approx(1.25));
  CHECK(rays.at(0.2, 0.7).direction == Vec3(0, 0, -1));
}

TEST_CASE("a transform scales first, then turns about x, y and z, in that order") {
  const DMat3 map = linear_part({{9, 9, 9}, {90, 0, 90}, {2, 1, 1}});
  // x: scaled to 2x, untouched by Rx, turned to 2y by Rz. y: to z by Rx, kept by Rz.
  CHECK(glm::length(map * DVec3(1, 0, 0) - DVec3(0, 2, 0)) < 1e-12);
  CHECK(glm::length(map * DVec3(0, 1, 0) - DVec3(0, 0, 1)) < 1e-12);
  const DMat3 turned = linear_part({{}, {0, 90, 0}, {1, 1, 1}});
  CHECK(glm::length(turned * DVec3(0, 0, 1) - DVec3(1, 0, 0)) < 1e-12);
}
