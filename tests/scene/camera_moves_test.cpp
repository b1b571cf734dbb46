#include "scene/camera_moves.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "scene/camera_rays.h"

using namespace meander;

namespace {

constexpr int kWidth = 960;
constexpr int kHeight = 540;
constexpr double kAspect = 16.0 / 9;

Camera perspective() {
  Camera camera;
  camera.look_from = {0.5, 1.75, 4.4};
  camera.look_at = {0.02, -0.14, 0};
  camera.vertical_fov = 29;
  return camera;
}

Camera orthographic() {
  Camera camera = perspective();
  camera.orthographic_height = 2.5;
  return camera;
}

Camera tilted() {
  Camera camera = perspective();
  camera.up = {0.3, 2, -0.5};
  return camera;
}

std::vector<Camera> cameras() { return {perspective(), orthographic(), tilted()}; }

double distance_of(const Camera& camera) { return glm::distance(camera.look_from, camera.look_at); }

// Where a point is seen, in fractions of the film, y down.
glm::dvec2 seen_at(const Camera& camera, const DVec3& point) {
  const CameraRays rays = make_camera_rays(camera, kWidth, kHeight);
  DVec3 d = point - rays.origin;
  if (!rays.orthographic) d /= glm::dot(d, rays.forward);
  return {0.5 + glm::dot(d, rays.right) / glm::dot(rays.right, rays.right),
          0.5 - glm::dot(d, rays.up) / glm::dot(rays.up, rays.up)};
}

// The point in the plane of look_at that is seen there.
DVec3 point_under(const Camera& camera, double x, double y) {
  const CameraRays rays = make_camera_rays(camera, kWidth, kHeight);
  const DVec3 offset = (x - 0.5) * rays.right + (0.5 - y) * rays.up;
  if (rays.orthographic) return camera.look_at + offset;
  return rays.origin + distance_of(camera) * (rays.forward + offset);
}

bool is_valid(const Camera& camera) {
  const DVec3 view = camera.look_at - camera.look_from;
  return glm::length(view) > 0 &&
         glm::length(glm::cross(glm::normalize(view), camera.up)) > 1e-9 * glm::length(camera.up);
}

void check_close(const DVec3& a, const DVec3& b, double tolerance) {
  CAPTURE(a.x);
  CAPTURE(a.y);
  CAPTURE(a.z);
  CHECK(glm::distance(a, b) <= tolerance);
}

}  // namespace

TEST_CASE("orbit keeps the distance, the point and up, and never flips") {
  for (const Camera& start : cameras()) {
    Camera camera = start;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> amount(-0.4, 0.4);
    for (int move = 0; move < 10000; ++move) {
      const double right_before = glm::dot(make_camera_rays(camera, 1, 1).up, camera.up);
      camera = orbit(camera, amount(random), amount(random));
      REQUIRE(is_valid(camera));
      REQUIRE(right_before > 0);  // up in the picture is up
    }
    CHECK(distance_of(camera) == doctest::Approx(distance_of(start)).epsilon(1e-9));
    CHECK(camera.look_at == start.look_at);
    CHECK(camera.up == start.up);
    CHECK(camera.orthographic_height == start.orthographic_height);
  }
}

TEST_CASE("orbit follows the pointer: half a turn a view height") {
  Camera camera;
  camera.look_from = {0, 0, 5};
  check_close(orbit(camera, 0.5, 0).look_from, {-5, 0, 0}, 1e-12);  // to the right: the camera goes left
  check_close(orbit(camera, 0, 0.25).look_from, DVec3(0, 5, 5) / std::sqrt(2.0), 1e-12);
  const Camera pole = orbit(camera, 0, 40);
  CHECK(pole.look_from.y == doctest::Approx(5));
  CHECK(is_valid(pole));
  check_close(orbit(orbit(camera, 0.3, 0.1), -0.3, -0.1).look_from, camera.look_from, 1e-12);
  const double nothing = std::nan("");
  check_close(orbit(camera, nothing, nothing).look_from, camera.look_from, 1e-12);
}

TEST_CASE("pan holds what is under the pointer") {
  for (const Camera& camera : cameras()) {
    const DVec3 point = point_under(camera, 0.3, 0.6);
    const double dx = 0.17;
    const double dy = -0.23;
    const Camera panned = pan(camera, dx, dy);
    const glm::dvec2 now = seen_at(panned, point);
    CHECK(now.x == doctest::Approx(0.3 + dx / kAspect).epsilon(1e-12));
    CHECK(now.y == doctest::Approx(0.6 + dy).epsilon(1e-12));
    CHECK(glm::distance(panned.look_at, camera.look_at) ==
          doctest::Approx(view_height(camera) * std::hypot(dx, dy)).epsilon(1e-12));
    check_close(panned.look_at - panned.look_from, camera.look_at - camera.look_from, 1e-12);
  }
}

TEST_CASE("dolly comes nearer by tenths and goes back the same way") {
  for (const Camera& camera : cameras()) {
    CHECK(view_height(dolly(camera, 1)) == doctest::Approx(0.9 * view_height(camera)).epsilon(1e-12));
    Camera moved = camera;
    for (int i = 0; i < 50; ++i) moved = dolly(moved, -1.5);
    CHECK(view_height(moved) > 1000 * view_height(camera));
    for (int i = 0; i < 75; ++i) moved = dolly(moved, 1);
    CHECK(view_height(moved) == doctest::Approx(view_height(camera)).epsilon(1e-9));
    CHECK(moved.look_at == camera.look_at);
    for (const double steps : {1.0, -1.0}) {
      moved = camera;
      for (int i = 0; i < 10000; ++i) moved = dolly(moved, steps);
      CHECK(is_valid(moved));
      CHECK(view_height(moved) > 1e-10);
      CHECK(view_height(moved) < 1e10);
    }
  }
}

TEST_CASE("frame puts the whole box into the view, and fills it") {
  const Bounds bounds{{10, -3, 2}, {14, -2.5, 9}};
  for (const Camera& camera : cameras()) {
    for (const double margin : {1.0, 1.25}) {
      const Camera framed = frame(camera, bounds, kAspect, margin);
      double largest = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const DVec3 p(corner & 1 ? 14 : 10, corner & 2 ? -2.5 : -3, corner & 4 ? 9 : 2);
        const glm::dvec2 seen = seen_at(framed, p);
        largest = std::max({largest, std::abs(2 * seen.x - 1), std::abs(2 * seen.y - 1)});
        CHECK(glm::dot(p - framed.look_from, framed.look_at - framed.look_from) > 0);
      }
      CHECK(largest == doctest::Approx(1 / margin).epsilon(1e-9));
      check_close(framed.look_at, {12, -2.75, 5.5}, 1e-12);
      check_close(glm::normalize(framed.look_at - framed.look_from),
                  glm::normalize(camera.look_at - camera.look_from), 1e-12);
    }
    const Camera at_point = frame(camera, {DVec3(1), DVec3(1)}, kAspect);
    CHECK(at_point.look_at == DVec3(1));
    CHECK(distance_of(at_point) == doctest::Approx(distance_of(camera)));
    CHECK(at_point.orthographic_height == camera.orthographic_height);
  }
}

TEST_CASE("views from the sides, the top too, from which one can go on") {
  const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
  for (const Camera& camera : {perspective(), orthographic()}) {
    for (const DVec3& direction : {DVec3(0, 0, 1), DVec3(0, 0, -1), DVec3(-1, 0, 0), DVec3(3, 0, 0),
                                   DVec3(0, 2, 0), DVec3(0, -1, 0), DVec3(1, 1, 1)}) {
      const Camera viewed = view_from(camera, bounds, direction);
      CHECK(is_valid(viewed));
      check_close(glm::normalize(viewed.look_from - viewed.look_at), glm::normalize(direction), 1.01e-4);
      check_close(viewed.look_at, DVec3(0), 1e-12);
      CHECK(is_valid(orbit(viewed, 0.2, 0.1)));
    }
    const CameraRays top = make_camera_rays(view_from(camera, bounds, {0, 1, 0}), 100, 100);
    check_close(glm::normalize(top.right), {1, 0, 0}, 1e-9);  // the front is below
    check_close(glm::normalize(top.up), {0, 0, -1}, 2e-4);
  }
}

TEST_CASE("ten thousand moves of every kind leave a camera to work with") {
  for (Camera camera : cameras()) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> amount(-0.3, 0.3);
    for (int move = 0; move < 10000; ++move) {
      switch (random() % 3) {
        case 0:
          camera = orbit(camera, amount(random), amount(random));
          break;
        case 1:
          camera = pan(camera, amount(random), amount(random));
          break;
        default:
          camera = dolly(camera, amount(random));
      }
      REQUIRE(is_valid(camera));
    }
    const Camera framed = frame(camera, {DVec3(-1), DVec3(1)}, kAspect);
    CHECK(std::abs(seen_at(framed, DVec3(1)).x - 0.5) < 0.5);
    CHECK(is_valid(framed));
  }
}
