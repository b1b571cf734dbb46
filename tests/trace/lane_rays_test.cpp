// Rays that lanes begin together, in a mesh.
#include <doctest/doctest.h>

#include "math/random.h"
#include "trace/empty_balls.h"
#include "trace/mesh_cases.h"
#include "walk/lane_walks.h"

using namespace meander;

namespace {

// Walks from the middle of a cube along +x whose first random number is 0.
struct Zeros {
  int left;
  int exits = 0;
  int astray = 0;

  [[nodiscard]] bool start(int, Walker& walker, Random& random) {
    if (left == 0) return false;
    --left;
    walker = {};
    walker.direction = {1, 0, 0};
    walker.weight.hero = 0;
    random = Random({0, 1, 0, 0});
    REQUIRE(Random(random).next() == 0);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    exits += result.end == WalkEnd::exited;
    astray += glm::length(result.crossing.point - Vec3(1, 0, 0)) > Real(1e-5);
    return start(lane, walker, random);
  }
  void collided(int, Real, Walker&, Random&) {}
  [[nodiscard]] bool stop() const { return false; }
};

// White walks from the middles of triangles, inward.
struct FromTheSurface {
  const Mesh& mesh;
  DVec3 center;
  std::uint32_t left;
  std::uint32_t next = 0;
  int exits = 0;
  int leaks = 0;

  [[nodiscard]] bool start(int, Walker& walker, Random& random) {
    if (next == left) return false;
    random = stream(2, 0, next++);
    walker = {};
    enter_anywhere(mesh, center, walker, random);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    exits += result.end == WalkEnd::exited && walker.weight.carried() == Rgb(1);
    leaks += result.end == WalkEnd::leaked;
    return start(lane, walker, random);
  }
  void collided(int, Real, Walker&, Random&) {}
  [[nodiscard]] bool stop() const { return false; }
};

// The same, told of their collisions.
struct Colliding : FromTheSurface {
  const MeshBody& body;
  int collisions = 0;
  int known = 0;
  int too_far = 0;

  Colliding(const Mesh& mesh, const DVec3& center, const MeshBody& in)
      : FromTheSurface{mesh, center, 2000}, body(in) {}

  void collided(int, Real clearance, const Walker& walker, Random&) {
    ++collisions;
    if (!(clearance > 0)) return;
    ++known;
    const auto nearest = body.nearest(walker.position, clearance);
    too_far += nearest && nearest->distance < clearance;
  }
};

}  // namespace

TEST_CASE(
    "a walk whose hero channel does not collide flies straight out, also where its random number is 0") {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), make_box_mesh(DVec3(1)), DMat3(1), center);
  const EmptyBalls balls = make_empty_balls(body, 1);
  const LaneModel model{
      {Rgb(0, 1, 1), Rgb(Real(0.9)), 0}, {.kind = SafeRegion::Kind::balls, .balls = &balls}, false};
  for (const InstructionSet set : instruction_sets()) {
    Zeros client{1000};
    REQUIRE(LaneWalks(set, body, model, client).run());
    CHECK(client.exits == 1000);
    CHECK(client.astray == 0);
  }
}

TEST_CASE("walks in lanes leave a closed mesh by its surface, all of them, with all of their weight") {
  constexpr std::uint32_t kWalks = 20'000;
  const Device device = make_device(1);
  for (const MeshCase& c : mesh_cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls balls = make_empty_balls(body, 2);
    for (const Real sigma_t : {Real(3), Real(100)}) {
      const LaneModel model{
          {Rgb(sigma_t), Rgb(1), 0}, {.kind = SafeRegion::Kind::balls, .balls = &balls}, false};
      for (const InstructionSet set : instruction_sets()) {
        FromTheSurface client{c.mesh, center, kWalks};
        REQUIRE(LaneWalks(set, body, model, client).run());
        CHECK(client.leaks == 0);
        CHECK(client.exits == kWalks);
      }
    }
  }
}

TEST_CASE("at a collision in a mesh the surface is as far away as it is told, at least") {
  const Device device = make_device(1);
  for (const MeshCase& c : mesh_cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const EmptyBalls balls = make_empty_balls(body, 2);
    const LaneModel model{{Rgb(30), Rgb(1), 0}, {.kind = SafeRegion::Kind::balls, .balls = &balls}, true};
    for (const InstructionSet set : instruction_sets()) {
      Colliding client(c.mesh, center, body);
      REQUIRE(LaneWalks(set, body, model, client).run());
      CHECK(client.too_far == 0);
      CHECK(client.exits == 2000);
      if (c.covered > 0) CHECK(client.collisions > 1000);
      CHECK(client.known >= 0.9 * c.covered * client.collisions);
    }
  }
}
