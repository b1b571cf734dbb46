#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "math/warp.h"
#include "stats/hypothesis.h"
#include "stats/moments.h"
#include "trace/mesh_body.h"
#include "walk/lobe.h"
#include "walk/random_walk.h"

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

struct SilentEvents {
  double path = 0;
  void segment(const Walker&, Real distance) noexcept { path += double{distance}; }
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

// Walks that enter a mesh uniformly over its area with a cosine distribution.
struct UniformEntry {
  const Mesh& mesh;
  DVec3 center;
  std::vector<double> cumulative;

  UniformEntry(const Mesh& m, const DVec3& c) : mesh(m), center(c) {
    double sum = 0;
    for (const Triangle& t : m.triangles) cumulative.push_back(sum += 0.5 * glm::length(double_area(t)));
  }
  [[nodiscard]] DVec3 double_area(const Triangle& t) const {
    const DVec3& a = mesh.positions[t[0]];
    return glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
  }
  void start(Walker& walker, Random& random, Real offset) const {
    const double target = (random.next() + random.next() * 0x1p-24) * cumulative.back();
    const auto index = std::upper_bound(cumulative.begin(), cumulative.end(), target) - cumulative.begin();
    const Triangle& t = mesh.triangles[std::min<std::size_t>(index, mesh.triangles.size() - 1)];
    Real u = random.next();
    Real v = random.next();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const DVec3& a = mesh.positions[t[0]];
    const DVec3 p =
        a + double{u} * (mesh.positions[t[1]] - a) + double{v} * (mesh.positions[t[2]] - a) - center;
    const Vec3 normal(glm::normalize(double_area(t)));
    const Real u1 = random.next();
    const Real u2 = random.next();
    walker.position = Vec3(p) - offset * normal;
    walker.direction = make_lobe(-normal, -normal).sample({u1, u2});
  }
};

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

TEST_CASE("walks in a torus knot of 100k triangles have mean path 4V/S and none is lost") {
  const Device device = make_device(1);
  const Mesh mesh = make_torus_knot();
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  const UniformEntry entry(mesh, center);
  const double expected = 4 * signed_volume(mesh) / surface_area(mesh);
  for (const auto& [path, g] : {std::pair(0.3, 0.8), std::pair(0.03, 0.0)}) {
    const WalkModel model{{Rgb(static_cast<Real>(1 / path)), Rgb(1), static_cast<Real>(g)},
                          Estimator::implicit};
    Moments length;
    Moments order;
    std::uint64_t leaked = 0;
    for (std::uint32_t i = 0; i < 40000; ++i) {
      Random random = stream(2, 0, i);
      Walker walker;
      entry.start(walker, random, Real(0x1p-20));
      SilentEvents events;
      leaked += random_walk(body, model, walker, random, events).end == WalkEnd::leaked;
      length.add(events.path);
      order.add(walker.weight.order);
    }
    CHECK(leaked == 0);
    CHECK(std::abs(z_score(length.mean, expected, length.standard_error())) < 4);
    CHECK(std::abs(z_score(order.mean, expected / path, order.standard_error())) < 4);
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
