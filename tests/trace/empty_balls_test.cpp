#include "trace/empty_balls.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "math/random.h"
#include "math/warp.h"
#include "trace/mesh_cases.h"
#include "walk/lane_rays.h"

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

}  // namespace

TEST_CASE("no ball is larger than the distance from its centre to the surface") {
  const Device device = make_device(2);
  for (const MeshCase& c : mesh_cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls field = make_empty_balls(body, 2);
    REQUIRE((field.balls.size() > 1) == (c.covered != kNoBalls));
    if (c.covered == kNoBalls) continue;
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
  for (const MeshCase& c : mesh_cases()) {
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
    CHECK((tested > 0) == (c.covered != kNoBalls));
    MESSAGE(c.name << ": " << field.balls.size() << " balls, " << field.bytes() / 1024 << " KB, "
                   << 100.0 * static_cast<double>(held) /
                          static_cast<double>(std::max<std::size_t>(inside, 1))
                   << " % of the inside held");
    CHECK(static_cast<double>(held) >= c.covered * static_cast<double>(inside));
  }
}

namespace {

// A batch of lanes at random points of a mesh's bounds.
struct Placed {
  Lanes lanes{};
  RestingLanes resting{};
  Vec3 place[kLanes];
  bool inside[kLanes];

  Placed(const MeshBody& body, Random& random) {
    for (int i = 0; i < kLanes; ++i) {
      place[i] = random_point(random, body.half_size());
      for (int axis = 0; axis < 3; ++axis) lanes.position[axis][i] = static_cast<float>(place[i][axis]);
      const auto above = body.closest(place[i], {0, 0, 1}, std::numeric_limits<Real>::infinity());
      inside[i] = above && above->normal.z > 0;
    }
  }
  void give_balls(InstructionSet set, const EmptyBalls& field) {
    std::uint32_t all[kLanes + 16];
    std::iota(std::begin(all), std::end(all), 0u);
    meander::give_balls(set, field, lanes, std::span(all).first(kLanes));
  }
  [[nodiscard]] Vec3 to_ball(int lane, Random& random) const {
    const Real u1 = random.next();
    const Real u2 = random.next();
    const Vec3 center(lanes.ball_center[0][lane], lanes.ball_center[1][lane], lanes.ball_center[2][lane]);
    return center + std::sqrt(Real(lanes.ball_radius2[lane])) * sample_sphere({u1, u2}) - place[lane];
  }
  // Lets all lanes that have a ball cross along a distance; how far that is clear stands in resting.clear.
  void cross(InstructionSet set, const EmptyBalls& field, const Vec3 (&direction)[kLanes], float distance) {
    for (int i = 0; i < kLanes; ++i) {
      for (int axis = 0; axis < 3; ++axis) lanes.direction[axis][i] = static_cast<float>(direction[i][axis]);
      lanes.distance[i] = distance;
      const bool crosses = lanes.ball_radius2[i] > 0;
      lanes.state[i] = static_cast<std::uint32_t>(crosses ? LaneState::crossing : LaneState::empty);
    }
    LaneModel model;
    model.region = {.kind = SafeRegion::Kind::balls, .balls = &field};
    find_resting(set, model, lanes, resting);
  }
};

}  // namespace

TEST_CASE("no step into the ball of a lane leaves the body, nor any of the part that balls call clear") {
  const Device device = make_device(2);
  for (const MeshCase& c : mesh_cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls field = make_empty_balls(body, 2, 64);
    Random random = stream(3, 0, 0);
    std::size_t tested = 0;
    std::size_t left = 0;
    std::size_t long_way = 0;
    for (std::size_t batch = 0; batch < 4000; ++batch) {
      const InstructionSet set = instruction_sets()[batch % instruction_sets().size()];
      Placed placed(body, random);
      placed.give_balls(set, field);
      Vec3 direction[kLanes];
      for (int i = 0; i < kLanes; ++i) {
        if (!(placed.lanes.ball_radius2[i] > 0)) continue;
        const Vec3 way = placed.to_ball(i, random);
        const Real length = glm::length(way);
        direction[i] = way / length;
        if (!placed.inside[i]) continue;
        ++tested;
        left += body.first_crossing_in_tree(placed.place[i], direction[i], length).kind != CrossingKind::none;
      }
      placed.cross(set, field, direction, 1);
      for (int i = 0; i < kLanes; ++i) {
        if (!placed.inside[i] || !(placed.lanes.ball_radius2[i] > 0)) continue;
        const Real clear = placed.resting.clear[i];
        left += body.first_crossing_in_tree(placed.place[i], direction[i], clear).kind != CrossingKind::none;
        long_way += clear > glm::length(placed.to_ball(i, random));
      }
    }
    CHECK(left == 0);
    MESSAGE(c.name << ": " << tested << " steps");
    if (c.covered > 0) CHECK(tested > 1000);
    if (c.covered > 0) CHECK(long_way > 1000);
  }
}

TEST_CASE(
    "lanes without a ball get rays for all of their steps, at any scale, also towards the middle of a ball") {
  const Device device = make_device(1);
  for (const double scale : {1e-6, 1.0, 1e4, 1e6}) {
    CAPTURE(scale);
    DVec3 center;
    const MeshBody body(device.get(), make_sphere_mesh(8), DMat3(scale), center);
    const EmptyBalls field = make_empty_balls(body, 1, 16);
    LaneModel model;
    model.region = {.kind = SafeRegion::Kind::balls, .balls = &field};
    Random random = stream(6, 0, 0);
    for (int batch = 0; batch < 400; ++batch) {
      Placed placed(body, random);
      Lanes& lanes = placed.lanes;
      for (int i = 0; i < kLanes; ++i) {
        const Vec3 direction = -glm::normalize(placed.place[i]);  // the middle that a lane has at first is 0
        for (int axis = 0; axis < 3; ++axis) lanes.direction[axis][i] = static_cast<float>(direction[axis]);
        lanes.distance[i] = static_cast<float>(2 * scale);
        lanes.ball_radius2[i] = -1;
        lanes.state[i] = static_cast<std::uint32_t>(LaneState::crossing);
      }
      find_resting(instruction_sets()[static_cast<std::size_t>(batch) % instruction_sets().size()], model,
                   lanes, placed.resting);
      REQUIRE(placed.resting.ray_count == kLanes);
      CHECK(std::ranges::all_of(placed.resting.clear, [](float clear) { return clear == 0; }));
    }
  }
}

TEST_CASE("crossing lanes get rays for what balls do not answer for") {
  const Device device = make_device(2);
  DVec3 center;
  const MeshBody body(device.get(), make_torus_knot(), DMat3(1), center);
  const EmptyBalls field = make_empty_balls(body, 2, 64);
  Random random = stream(5, 0, 0);
  for (const InstructionSet set : instruction_sets()) {
    int rays = 0;
    int none = 0;
    for (int batch = 0; batch < 50; ++batch) {
      Placed placed(body, random);
      placed.give_balls(set, field);
      Vec3 direction[kLanes];
      for (Vec3& d : direction) d = sample_sphere({random.next(), random.next()});
      const float distance = batch % 2 ? 0.01f : 0.2f;
      placed.cross(set, field, direction, distance);
      const RestingLanes& resting = placed.resting;
      for (int i = 0, seen = 0; i < kLanes; ++i) {
        if (!(placed.lanes.ball_radius2[i] > 0)) continue;
        REQUIRE(seen < resting.count);
        CHECK(resting.lane[seen++] == static_cast<std::uint32_t>(i));
        const float clear = resting.clear[i];
        CHECK(clear <= distance);
        none += clear == distance;
        if (clear == distance) continue;
        ++rays;
        const int ray = resting.ray[i];
        REQUIRE(ray < resting.ray_count);
        CHECK(resting.rays.distance[ray] == distance - clear);
        const Vec3 from(resting.rays.from[0][ray], resting.rays.from[1][ray], resting.rays.from[2][ray]);
        CHECK(glm::length(from - (placed.place[i] + clear * direction[i])) < Real(1e-6));
        CHECK(resting.rays.direction[1][ray] == static_cast<float>(direction[i].y));
      }
    }
    CHECK(rays > 100);
    CHECK(none > 100);
  }
}

TEST_CASE("a mesh too tangled for its field is given up in part, and what there is holds") {
  Random random = stream(8, 0, 0);
  Mesh hedge;  // needles from one middle, whose boxes lie all over one another
  for (std::uint32_t i = 0; i < 25000; ++i) {
    const DVec3 along(sample_sphere({random.next(), random.next()}));
    const DVec3 aside = glm::normalize(glm::cross(along, DVec3(0.3, 0.5, 0.8)));
    const DVec3 up = glm::cross(along, aside);
    const double thick = 0.003;
    for (const DVec3& p : {along, thick * aside, thick * (up - aside), thick * (-up - aside)})
      hedge.positions.push_back(p);
    const std::uint32_t a = 4 * i;
    hedge.triangles.insert(hedge.triangles.end(),
                           {{a, a + 1, a + 2}, {a, a + 2, a + 3}, {a, a + 3, a + 1}, {a + 1, a + 3, a + 2}});
  }
  const Device device = make_device(2);
  DVec3 center;
  const MeshBody body(device.get(), hedge, DMat3(1), center);
  const EmptyBalls field = make_empty_balls(body, 2);
  for (std::size_t i = 0; i < field.balls.size(); i += field.balls.size() / 20 + 1) {
    const EmptyBall& ball = field.balls[i];
    if (!(ball.radius2 > 0)) continue;
    double nearest = 10;
    for (const Triangle& t : hedge.triangles)
      nearest = std::min(nearest, distance_to_triangle(DVec3(ball.center) + center, hedge.positions[t[0]],
                                                       hedge.positions[t[1]], hedge.positions[t[2]]));
    CHECK(std::sqrt(double{ball.radius2}) < nearest);
  }
  const std::atomic<bool> stop{true};
  CHECK_FALSE(make_empty_balls(body, 2, kDefaultCells, stop));
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
