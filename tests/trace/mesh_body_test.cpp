#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "math/warp.h"
#include "trace/mesh_body.h"

using namespace meander;

namespace {

constexpr Real kFar = std::numeric_limits<Real>::infinity();

Vec3 random_direction(Random& random) {
  const Real u1 = random.next();
  const Real u2 = random.next();
  return sample_sphere({u1, u2});
}

Mesh make_box(const DVec3& low, const DVec3& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

}  // namespace

TEST_CASE("a box mesh is left where the exact box is left") {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), make_box({1, 2, 3}, {3, 3, 3.5}), DMat3(1), center);
  CHECK(center == DVec3(2, 2.5, 3.25));
  const DVec3 half(1, 0.5, 0.25);
  for (std::uint32_t i = 0; i < 50000; ++i) {
    Random random = stream(1, 0, i);
    const Real a = random.next();
    const Real b = random.next();
    const Real c = random.next();
    const Vec3 p = Vec3(half) * Vec3(2 * a - 1, 2 * b - 1, 2 * c - 1) * Real(0.99999);
    const Vec3 d = random_direction(random);
    double exact = 1e30;
    for (int k = 0; k < 3; ++k)
      if (d[k] != 0) exact = std::min(exact, (std::copysign(half[k], double{d[k]}) - p[k]) / d[k]);
    const Crossing exit = body.first_crossing(p, d, kFar);
    REQUIRE(exit.kind == CrossingKind::exit);
    CHECK(std::abs(exit.distance - exact) < 1e-6 + 1e-6 * exact / std::abs(glm::dot(exit.normal, d)));
    CHECK(glm::dot(exit.normal, d) > 0);
    const Crossing inside = body.first_crossing(p, d, static_cast<Real>(0.9 * exact));
    CHECK(inside.kind == CrossingKind::none);
  }
}

TEST_CASE("a point that rounding left outside is taken for what it is, also beside a thin gap") {
  const Device device = make_device(1);
  Mesh sheets = make_box({-1, -1, -1}, {1, 1, -1e-5});
  append(sheets, make_box({-1, -1, 1e-5}, {1, 1, 1}));
  DVec3 center;
  const MeshBody body(device.get(), sheets, DMat3(1), center);
  // Just outside a face, moving away from it: the walk has left.
  const Crossing out = body.first_crossing({0, 0, Real(1 + 2e-7)}, {0, 0, 1}, 1);
  CHECK(out.kind == CrossingKind::exit);
  CHECK(out.distance == 0);
  // Inside the upper sheet, right behind the gap, moving away from it: the lower sheet's exit is not ours.
  const Crossing through = body.first_crossing({Real(0.1), Real(0.2), Real(2e-5)}, {0, 0, 1}, kFar);
  CHECK(through.kind == CrossingKind::exit);
  CHECK(through.distance == doctest::Approx(1).epsilon(1e-4));
  // Across the gap, it is.
  const Crossing down = body.first_crossing({Real(0.1), Real(0.2), Real(0.5)}, {0, 0, -1}, kFar);
  CHECK(down.distance == doctest::Approx(0.5).epsilon(1e-4));
}

TEST_CASE("a walk that flies through a hole is reported as leaked") {
  const Device device = make_device(1);
  Mesh open = make_box({-1, -1, -1}, {1, 1, 1});
  open.triangles.resize(10);  // without the face z = 1
  DVec3 center;
  const MeshBody body(device.get(), open, DMat3(1), center);
  CHECK(body.first_crossing({0, 0, 0}, {0, 0, 1}, kFar).kind == CrossingKind::leaked);
  CHECK(body.first_crossing({0, 0, 0}, {0, 0, 1}, 100).kind == CrossingKind::leaked);
  CHECK(body.first_crossing({0, 0, 0}, {0, 0, 1}, Real(0.5)).kind == CrossingKind::none);
  CHECK(body.first_crossing({0, 0, 0}, {0, 0, -1}, kFar).kind == CrossingKind::exit);
}

TEST_CASE("a step that ends at the surface is kept inside") {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), make_box({-1, -1, -1}, {1, 1, 1}), DMat3(1), center);
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Random random = stream(3, 0, i);
    const Real u = random.next();
    const Vec3 p(u - Real(0.5), Real(0.3), Real(0.1));
    const Vec3 d = random_direction(random);
    const Crossing exit = body.first_crossing(p, d, kFar);
    const Crossing step = body.first_crossing(p, d, std::nextafter(exit.distance, Real(0)));
    if (step.kind != CrossingKind::none) continue;  // rounding already counts it as an exit
    CHECK(largest(glm::abs(step.point)) < 1);
  }
}

TEST_CASE("a mirroring map keeps the outside outside") {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), make_box({0, 0, 0}, {1, 1, 1}), DMat3(-1, 0, 0, 0, 1, 0, 0, 0, 1),
                      center);
  CHECK(body.first_crossing({0, 0, 0}, {1, 0, 0}, kFar).normal.x == doctest::Approx(1));
}

namespace {

// How much of [0, distance] along a ray is in a box.
double clip(const DVec3& low, const DVec3& high, const Vec3& o, const Vec3& d, double distance) {
  double near = 0;
  double far = distance;
  for (int k = 0; k < 3; ++k) {
    const double a = (low[k] - o[k]) / d[k];
    const double b = (high[k] - o[k]) / d[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return std::max(far - near, 0.0);
}

}  // namespace

TEST_CASE("the length of a ray inside two boxes is that inside the exact ones, from inside and outside") {
  const Device device = make_device(1);
  const DVec3 lows[2] = {{-1, -1, -1}, {0.25, -1, -1}};
  const DVec3 highs[2] = {{0.125, 1, 1}, {1, 1, 1}};
  Mesh mesh = make_box(lows[0], highs[0]);
  append(mesh, make_box(lows[1], highs[1]));
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(3), center);
  int doubted = 0;
  constexpr int kRays = 50000;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    Random random = stream(5, 0, i);
    const Real x = random.next();
    const Real y = random.next();
    const Real z = random.next();
    const Vec3 o = Real(4.5) * Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
    const Vec3 d = random_direction(random);
    const double distance = i % 4 == 0 ? double{kFar} : 8.0 * random.next();
    const auto length = body.length_inside(o, d, distance, false);
    if (!length && ++doubted > 0) continue;
    const double exact = clip(3.0 * lows[0], 3.0 * highs[0], o, d, distance) +
                         clip(3.0 * lows[1], 3.0 * highs[1], o, d, distance);
    CHECK(std::abs(*length - exact) < 1e-5);
  }
  CHECK(doubted < kRays / 50);
}

TEST_CASE("a ray aimed at an edge or a corner, or past a hole, has the right length inside or none") {
  const Device device = make_device(1);
  DVec3 center;
  for (Mesh mesh : {make_torus_knot(200, 24), make_box({-1, -1, -1}, {1, 1, 1}), make_sphere_mesh(3)}) {
    const MeshBody body(device.get(), mesh, DMat3(1), center);
    const double longest = 2 * double{glm::length(body.half_size())};
    for (std::uint32_t i = 0; i < 100000; ++i) {
      Random random = stream(6, 0, i);
      const Triangle& t = mesh.triangles[random.next_bits() % mesh.triangles.size()];
      const Vec3 a(mesh.positions[t[0]] - center);
      const Vec3 b(mesh.positions[t[1]] - center);
      const Vec3 target = random.next() < Real(0.5) ? a : Real(0.5) * (a + b);
      const Vec3 normal = glm::normalize(glm::cross(b - a, Vec3(mesh.positions[t[2]] - center) - a));
      const Vec3 any = random_direction(random);
      const Vec3 d = glm::normalize(any - (1 - Real(1e-3) * random.next()) * glm::dot(any, normal) * normal);
      // A surface met once only would make it as long as the way to it.
      const auto length = body.length_inside(target - static_cast<Real>(2 * longest) * d, d, kFar, true);
      if (length) REQUIRE((*length > -1e-5 && *length < longest));
    }
  }
  Mesh open = make_box({-1, -1, -1}, {1, 1, 1});
  open.triangles.resize(10);  // the far side is missing
  const MeshBody body(device.get(), open, DMat3(1), center);
  CHECK_FALSE(body.length_inside({Real(0.1), Real(0.3), -3}, {0, 0, 1}, kFar, true));
}

TEST_CASE("a point's depth is how many boxes hold it, whether they touch, overlap or nest") {
  const std::pair<DVec3, DVec3> boxes[]{
      {{-1, -1, -1}, {0, 1, 1}}, {{0, -1, -1}, {1, 1, 1}}, {{0.25, -0.5, -0.5}, {1.5, 0.5, 0.5}}};
  Mesh mesh;
  for (const auto& [low, high] : boxes) append(mesh, make_box(low, high));
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  int doubtful = 0;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    Random random = stream(8, 0, i);
    const Real a = random.next();
    const Real b = random.next();
    const Real c = random.next();
    // A third of them within rounding of the touching faces, on either side.
    const Real x = i % 3 == 0 ? (2 * a - 1) * Real(1e-5) : 4 * a - 2;
    const DVec3 p(x, 3 * b - Real(1.5), 3 * c - Real(1.5));
    int expected = 0;
    bool beside = false;  // another face
    for (const auto& [low, high] : boxes)
      expected += glm::all(glm::lessThan(low, p)) && glm::all(glm::lessThan(p, high));
    for (int k = 0; k < 3; ++k)
      for (const double face : {-1.0, -0.5, 0.0, 0.25, 0.5, 1.0, 1.5})
        beside |= (k > 0 || face != 0) && std::abs(p[k] - face) < 1e-5;
    beside |= std::abs(p.x) < 1e-6;
    if (beside) continue;
    const auto depth = body.depth(Vec3(p - center), random_direction(random));
    doubtful += !depth;
    REQUIRE(depth.value_or(expected) == expected);
  }
  CHECK(doubtful < 50);
}

TEST_CASE("an entry behind is found as far as asked for, and no exit") {
  Mesh mesh = make_box({-1, -1, -1}, {0, 1, 1});
  append(mesh, make_box({0, -1, -1}, {1, 1, 1}));
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  const Vec3 p(Real(0.25), Real(0.1), Real(0.2));
  const auto found = body.entry_behind(p, {1, 0, 0}, Real(0.5));
  REQUIRE(found);
  CHECK(found->distance == doctest::Approx(0.25).epsilon(1e-6));
  CHECK(found->normal.x == -1);
  CHECK(!body.entry_behind(p, {1, 0, 0}, Real(0.2)));
  const auto other = body.entry_behind(p, {-1, 0, 0}, kFar);
  REQUIRE(other);
  CHECK(other->normal.x == 1);
  CHECK(other->distance == doctest::Approx(0.75).epsilon(1e-6));
}
