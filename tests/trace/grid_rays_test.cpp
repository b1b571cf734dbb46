#include <doctest/doctest.h>

#include <cmath>

#include <hwy/targets.h>

#include "math/random.h"
#include "math/warp.h"
#include "trace/mesh_body.h"
#include "trace/mesh_cases.h"
#include "trace/ray_batch.h"
#include "walk/random_walk.h"

using namespace meander;

namespace {

// Where rays leave their tips is rounding: tested for leaks alone.
constexpr const char* kNeedles = "needles";

Vec3 random_direction(Random& random) {
  const Real u1 = random.next();
  const Real u2 = random.next();
  return sample_sphere({u1, u2});
}

// A point of the surface, or near to it: on a corner, on an edge or on a face, moved by up to `away`.
Vec3 random_place(const Mesh& mesh, const DVec3& center, Real away, Random& random) {
  const Triangle& t = mesh.triangles[random.next_bits() % mesh.triangles.size()];
  double u = random.next();
  double v = random.next();
  const Real kind = random.next();
  if (kind < Real(0.5)) v = 0;
  if (kind < Real(0.2)) u = 0;
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const DVec3& a = mesh.positions[t[0]];
  const DVec3 p = a + u * (mesh.positions[t[1]] - a) + v * (mesh.positions[t[2]] - a) - center;
  const Real length = away * random.next();
  return Vec3(p) + length * random_direction(random);
}

bool alike(const Crossing& a, const Crossing& b, const Vec3& d) {
  if (a.kind != b.kind) return false;
  const Real slack = Real(1e-6) * (1 + 1 / std::max(std::abs(glm::dot(a.normal, d)), Real(1e-4)));
  return std::abs(a.distance - b.distance) <= slack && glm::length(a.point - b.point) <= slack + Real(1e-6);
}

// Whether a difference is one of rounding: the tree itself changes its mind when the step is moved by about
// the rounding of its place, or grid and tree agree for almost all such steps, as where a ray slips through
// the very corner of some triangles.
bool is_rounding(const MeshBody& body, const Vec3& p, const Vec3& d, Real distance, Random& random) {
  constexpr int kMoved = 256;
  const Crossing tree = body.first_crossing_in_tree(p, d, distance);
  int differ = 0;
  for (int i = 0; i < kMoved; ++i) {
    const Vec3 moved = p + Real(0x1p-21) * random_direction(random);
    const Vec3 turned = glm::normalize(d + Real(0x1p-21) * random_direction(random));
    const Crossing again = body.first_crossing_in_tree(moved, turned, distance);
    if (!alike(tree, again, d)) return true;
    differ += !alike(again, body.first_crossing(moved, turned, distance), d);
  }
  return differ < kMoved / 32;
}

struct NoEvents {
  void segment(const Walker&, Real) const noexcept {}
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

}  // namespace

TEST_CASE("steps cross where the tree says, also at edges and corners") {
  const Device device = make_device(1);
  for (const MeshCase& c : mesh_cases()) {
    if (c.name == kNeedles) continue;
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    Random random = stream(1, 0, 0);
    int differ = 0;
    int wrong = 0;
    Real worst = 0;
    for (int i = 0; i < 300'000; ++i) {
      const Vec3 p = random_place(c.mesh, center, i % 2 ? Real(0.02) : Real(1e-3), random);
      const Vec3 to = random_place(c.mesh, center, Real(1e-6), random);
      const bool aims = i % 3 == 0 && glm::length(to - p) > Real(1e-3);  // at an edge, often
      const Vec3 d = aims ? glm::normalize(to - p) : random_direction(random);
      const Real flight = Real(-0.02) * std::log(1 - random.next());
      const Real distance = aims ? 2 : i % 3 == 1 ? flight : std::numeric_limits<Real>::infinity();
      const Crossing crossing = body.first_crossing(p, d, distance);
      if (crossing.kind == CrossingKind::exit && crossing.distance > Real(1e-3) &&
          glm::dot(crossing.normal, d) > Real(0.1))
        worst = std::max(worst, glm::length(p + crossing.distance * d - crossing.point));
      if (alike(body.first_crossing_in_tree(p, d, distance), crossing, d)) continue;
      ++differ;
      wrong += !is_rounding(body, p, d, distance, random);
    }
    MESSAGE(c.name << ": " << differ << " of 300000 differ, they end within " << worst << " of their lines");
    CHECK(worst < Real(3e-6));
    CHECK(differ < 1000);
    CHECK(wrong == 0);
  }
}

namespace {

struct Searched {
  Packets packets;
  SurfaceCells cells;

  Searched(const Mesh& mesh, DVec3& center) {
    DVec3 low(mesh.positions[0]);
    DVec3 high(low);
    for (const DVec3& p : mesh.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    center = 0.5 * (low + high);
    std::vector<glm::vec3> positions;
    for (const DVec3& p : mesh.positions) positions.emplace_back(p - center);
    packets = make_packets(positions, mesh.triangles);
    cells = make_surface_cells(packets, glm::vec3(0.5 * (high - low)));
  }
};

bool same(const GridExit& a, const GridExit& b) {
  if (a.kind != b.kind) return false;
  if (a.kind != GridExit::Kind::exit) return true;
  return a.distance == b.distance && a.u == b.u && a.v == b.v && a.point == b.point && a.normal == b.normal &&
         a.triangle == b.triangle;
}

// Rays that are short, a few cells long, too long for the grid, along its axes, or start beyond it.
GridRay random_ray(const Mesh& mesh, const DVec3& center, Random& random) {
  const auto kind = random.next_bits() % 8;
  const Vec3 p = random_place(mesh, center, kind == 7 ? 3 : Real(0.02), random);
  Vec3 d = random_direction(random);
  if (kind == 6) d = {0, 0, random.next() < Real(0.5) ? -1 : 1};
  const Real scale = kind < 3 ? Real(0.01) : kind < 5 ? Real(0.1) : 2;
  return {glm::vec3(p), glm::vec3(d), static_cast<float>(-scale * std::log(1 - random.next())) + 1e-6f};
}

}  // namespace

TEST_CASE("rays side by side find what each finds alone, to the bit, on every instruction set") {
  for (const MeshCase& c : mesh_cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const Searched searched(c.mesh, center);
    Random random = stream(4, 0, 0);
    int found[3] = {};
    int differ = 0;
    for (std::size_t batch = 0; batch < 300; ++batch) {
      GridRays rays{};
      GridExit alone[kRayBatch];
      const std::size_t count = batch < 129 ? batch : 1 + random.next_bits() % kRayBatch;
      for (std::size_t i = 0; i < count; ++i) {
        const GridRay ray = random_ray(c.mesh, center, random);
        for (int axis = 0; axis < 3; ++axis) {
          rays.origin[axis][i] = ray.origin[axis];
          rays.direction[axis][i] = ray.direction[axis];
        }
        rays.distance[i] = ray.distance;
        alone[i] = find_exit(searched.packets, searched.cells, ray);
        ++found[static_cast<int>(alone[i].kind)];
      }
      for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        hwy::GetChosenTarget().Update(left & -left);
        GridExit together[kRayBatch];
        find_exits(searched.packets, searched.cells, rays, std::span(together).first(count));
        for (std::size_t i = 0; i < count; ++i) differ += !same(alone[i], together[i]);
      }
      hwy::GetChosenTarget().DeInit();
    }
    CHECK(differ == 0);
    for (const int count : found) CHECK(count > 50);
  }
}

TEST_CASE("without a grid nothing is known") {
  DVec3 center;
  const Searched searched(make_box_mesh(DVec3(1)), center);
  GridRays rays{};
  std::fill(std::begin(rays.direction[0]), std::end(rays.direction[0]), 1.0f);
  std::fill(std::begin(rays.distance), std::end(rays.distance), 2.0f);
  const GridRay ray{glm::vec3(0), {1, 0, 0}, 2};
  GridExit together[3];
  find_exits(searched.packets, searched.cells, rays, together);
  for (const GridExit& exit : together) CHECK(exit.kind == GridExit::Kind::exit);
  find_exits(searched.packets, {}, rays, together);
  for (const GridExit& exit : together) CHECK(exit.kind == GridExit::Kind::unknown);
  CHECK(find_exit(searched.packets, {}, ray).kind == GridExit::Kind::unknown);
}

TEST_CASE("steps from and towards vertices along edges end at a place that is a number") {
  const Device device = make_device(1);
  Mesh lattice = make_sphere_mesh(20);
  for (DVec3& p : lattice.positions) p = glm::round(p * 32.0) / 32.0;  // many triangles are seen edge-on then
  for (const MeshCase& c : {MeshCase{"lattice", lattice}, MeshCase{"knot", make_torus_knot()}}) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    Random random = stream(7, 0, 0);
    int lost = 0;
    for (int batch = 0; batch < 1000; ++batch) {
      Steps steps{};
      MeshBody::Begun begun[Steps::kMost];
      for (std::size_t i = 0; i < Steps::kMost; ++i) {
        const Triangle& t = c.mesh.triangles[random.next_bits() % c.mesh.triangles.size()];
        const auto corner = random.next_bits() % 3;
        const Vec3 a(c.mesh.positions[t[corner]] - center);
        const Vec3 b(c.mesh.positions[t[(corner + 1) % 3]] - center);
        if (a == b) continue;
        const Vec3 d = glm::normalize(b - a);
        const Vec3 from = i % 2 ? a : a - Real(0.01) * d;
        for (int axis = 0; axis < 3; ++axis) {
          steps.from[axis][i] = static_cast<float>(from[axis]);
          steps.direction[axis][i] = static_cast<float>(d[axis]);
        }
        steps.distance[i] = 0.05f;
        const Crossing alone = body.first_crossing(from, d, Real(0.05));
        lost += !std::isfinite(glm::dot(alone.point, alone.shading_normal));
      }
      body.begin_crossings(steps, begun);
      for (const MeshBody::Begun& one : begun) {
        const Crossing crossing = body.finish_crossing(one);
        lost += !std::isfinite(glm::dot(crossing.point, crossing.shading_normal));
      }
    }
    CHECK(lost == 0);
  }
}

TEST_CASE(
    "a step that starts by a rounding in a narrow gap before its own wall goes in, one past its wall out") {
  // Plates face to face, the gap between them 1e-5 wide: x from -1 to 0, and from 1e-5 to 1.
  constexpr double kGap = 1e-5;
  Mesh mesh = make_box_mesh(DVec3(0.5));
  Mesh other = mesh;
  for (DVec3& p : mesh.positions) p.x -= 0.5;
  for (DVec3& p : other.positions) p.x = kGap + (p.x + 0.5) * (1 - kGap);
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  Random random = stream(8, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    Vec3 d = random_direction(random);
    d.x = std::abs(d.x) + Real(1e-3);
    d = glm::normalize(d);
    const auto place = [&](double x) {
      return Vec3(DVec3(x, 0.1 * random.next(), 0.1 * random.next()) - center);
    };
    const double rounding = 3e-7 * (random.next() - 0.5);
    const Vec3 entering = place(kGap + rounding);
    CHECK(body.first_crossing(entering, d, Real(1e-3)).kind == CrossingKind::none);
    const Vec3 leaving = place(rounding);
    const Crossing out = body.first_crossing(leaving, d, Real(1e-3));
    CHECK(out.kind == CrossingKind::exit);
    CHECK(std::abs(out.point.x - (0 - Real(center.x))) < Real(1e-6));
  }
}

TEST_CASE("a closed mesh leaks nothing") {
  const Device device = make_device(1);
  for (const MeshCase& c : mesh_cases()) {
    CAPTURE(c.name);
    DVec3 center;
    const MeshBody body(device.get(), c.mesh, DMat3(1), center);
    const WalkModel model{{Rgb(30), Rgb(1), 0}, Estimator::implicit};
    NoEvents events;
    int leaks = 0;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      Random random = stream(2, 0, i);
      Walker walker;
      enter_anywhere(c.mesh, center, walker, random);
      leaks += random_walk(body, model, walker, random, events).end == WalkEnd::leaked;
    }
    CHECK(leaks == 0);
  }
}
