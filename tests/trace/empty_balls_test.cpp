#include "trace/empty_balls.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include "math/random.h"
#include "math/warp.h"

using namespace meander;

namespace {

Vec3 random_point(Random& random, const Vec3& half) {
  const Real x = random.next();
  const Real y = random.next();
  const Real z = random.next();
  return half * (Real(2) * Vec3(x, y, z) - Real(1));
}

// Distance to a triangle in double: over the barycentric square by the projections on face, edges, corners.
double distance_to_triangle(const DVec3& p, const DVec3& a, const DVec3& b, const DVec3& c) {
  const auto to_segment = [&](const DVec3& from, const DVec3& to) {
    const DVec3 edge = to - from;
    const double t = std::clamp(glm::dot(p - from, edge) / glm::dot(edge, edge), 0.0, 1.0);
    return glm::length(p - (from + t * edge));
  };
  const double edges = std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
  const DVec3 n = glm::normalize(glm::cross(b - a, c - a));
  const DVec3 foot = p - n * glm::dot(p - a, n);
  const bool inside = glm::dot(glm::cross(b - a, foot - a), n) >= 0 &&
                      glm::dot(glm::cross(c - b, foot - b), n) >= 0 &&
                      glm::dot(glm::cross(a - c, foot - c), n) >= 0;
  return inside ? std::min(edges, glm::length(p - foot)) : edges;
}

Mesh make_box_mesh() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// A closed box whose wall is `thickness` thick: thin walls and a cavity.
Mesh make_shell(double thickness) {
  Mesh shell = make_box_mesh();
  const std::size_t count = shell.positions.size();
  const std::size_t triangles = shell.triangles.size();
  for (std::size_t i = 0; i < count; ++i) shell.positions.push_back((1 - thickness) * shell.positions[i]);
  for (std::size_t i = 0; i < triangles; ++i) {
    Triangle t = shell.triangles[i];
    for (auto& corner : t) corner += static_cast<std::uint32_t>(count);
    std::swap(t[1], t[2]);
    shell.triangles.push_back(t);
  }
  return shell;
}

struct Case {
  std::string name;
  Mesh mesh;
  double covered;  // of the inside, at least
};

std::vector<Case> cases() {
  return {{"sphere", make_sphere_mesh(20), 0.97},
          {"knot", make_torus_knot(), 0.9},
          {"box", make_box_mesh(), 0.8},
          {"shell", make_shell(0.01), 0},
          {"needle",
           [] {
             Mesh mesh = make_box_mesh();
             for (DVec3& p : mesh.positions) p *= DVec3(1, 1e-3, 1e-3);
             return mesh;
           }(),
           0}};
}

}  // namespace

TEST_CASE("no ball is larger than the distance from its centre to the surface") {
  const Device device = make_device(2);
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls field = make_empty_balls(body, 2);
    REQUIRE(field.balls.size() > 1);
    Random random = stream(1, 0, 0);
    const std::size_t tries = std::max<std::size_t>(20, 4'000'000 / c.mesh.triangles.size());
    for (std::size_t i = 0; i < tries; ++i) {
      const auto n = 1 + random.next_bits() % (field.balls.size() - 1);
      const EmptyBall& ball = field.balls[n];
      const DVec3 p = DVec3(ball.center) + center;
      double nearest = 1e30;
      for (const Triangle& t : c.mesh.triangles)
        nearest = std::min(nearest, distance_to_triangle(p, c.mesh.positions[t[0]], c.mesh.positions[t[1]],
                                                         c.mesh.positions[t[2]]));
      CHECK(std::sqrt(double{ball.radius2}) < nearest);
    }
  }
}

TEST_CASE("a step between two points of a ball crosses nothing, a million times on every mesh") {
  const Device device = make_device(2);
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls field = make_empty_balls(body, 2);
    Random random = stream(2, 0, 0);
    std::size_t tested = 0;
    std::size_t crossed = 0;
    std::size_t inside = 0;
    std::size_t held = 0;
    for (int i = 0; i < 1'000'000; ++i) {
      const Vec3 p = random_point(random, body.half_size());
      const EmptyBall& ball = field.at(p);
      const bool holds = ball.holds(p);
      if (i % 100 == 0) {
        const auto nearest = body.nearest(p, std::numeric_limits<Real>::infinity());
        const bool within = glm::dot(p - nearest->point, nearest->normal) < 0;
        inside += within;
        held += within && holds;
      }
      if (!holds) continue;
      // To a point on the ball's own surface, as far as there is room.
      const Real u1 = random.next();
      const Real u2 = random.next();
      const Vec3 to = Vec3(ball.center) + std::sqrt(Real(ball.radius2)) * sample_sphere({u1, u2});
      const Real length = glm::length(to - p);
      ++tested;
      crossed += body.closest(p, (to - p) / length, length).has_value();
    }
    CHECK(crossed == 0);
    CHECK(tested > 0);
    MESSAGE(c.name << ": " << field.balls.size() << " balls, " << field.bytes() / 1024 << " KB, "
                   << 100.0 * static_cast<double>(held) /
                          static_cast<double>(std::max<std::size_t>(inside, 1))
                   << " % of the inside held");
    CHECK(static_cast<double>(held) >= c.covered * static_cast<double>(inside));
  }
}

TEST_CASE("no step into a ball that faces its cell leaves the body, wherever in the cell it starts") {
  const Device device = make_device(2);
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls field = make_empty_balls(body, 2, 64);
    Random random = stream(3, 0, 0);
    std::size_t tested = 0;
    std::size_t left = 0;
    for (int i = 0; i < 1'000'000; ++i) {
      const Vec3 p = random_point(random, body.half_size());
      const EmptyBall ball = field.from(p);
      if (ball.promise() != EmptyBall::facing) continue;
      const auto above = body.closest(p, {0, 0, 1}, std::numeric_limits<Real>::infinity());
      if (!above || above->normal.z < 0) continue;
      const Real u1 = random.next();
      const Real u2 = random.next();
      const Vec3 to = Vec3(ball.center) + std::sqrt(Real(ball.radius2)) * sample_sphere({u1, u2});
      const Real length = glm::length(to - p);
      ++tested;
      left += body.first_crossing_in_tree(p, (to - p) / length, length).kind != CrossingKind::none;
      const Real clear = field.clear_length(ball, glm::vec3(p), glm::vec3((to - p) / length), 1);
      left += body.first_crossing_in_tree(p, (to - p) / length, clear).kind != CrossingKind::none;
    }
    CHECK(left == 0);
    MESSAGE(c.name << ": " << tested << " steps");
    if (c.covered > 0) CHECK(tested > 1000);
  }
}

TEST_CASE("the balls are the same on one thread and on two") {
  const Device device = make_device(2);
  DVec3 center;
  const MeshBody body(device.get(), make_torus_knot(), DMat3(1), center);
  const EmptyBalls one = make_empty_balls(body, 1, 64);
  const EmptyBalls two = make_empty_balls(body, 2, 64);
  CHECK(one.cells == two.cells);
  REQUIRE(one.balls.size() == two.balls.size());
  CHECK(std::memcmp(one.balls.data(), two.balls.data(), one.balls.size() * sizeof(EmptyBall)) == 0);
}
