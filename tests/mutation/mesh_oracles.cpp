// Oracles of walks in closed meshes: in lanes they take their steps in empty balls, and short rays by
// packets.
#include <algorithm>
#include <vector>

#include "trace/empty_balls.h"
#include "verdict.h"
#include "walk/lane_walks.h"
#include "walk/lobe.h"

using namespace meander;

namespace {

constexpr std::uint32_t kWalks = 60'000;

void append_box(Mesh& mesh, const DVec3& low, const DVec3& high) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  constexpr Triangle kFaces[]{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const Triangle& t : kFaces) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

// Square plates, one on top of the other and so near that cells, packets and balls see several of them.
constexpr int kPlates = 24;
constexpr double kThickness = 0.02;
constexpr double kGap = 0.004;

// The lowest z of a plate, in the body's own coordinates.
double bottom_of(int plate) { return (plate - 0.5 * kPlates) * (kThickness + kGap) + 0.5 * kGap; }

Mesh make_plates() {
  Mesh mesh;
  for (int i = 0; i < kPlates; ++i)
    append_box(mesh, {-0.5, -0.5, bottom_of(i)}, {0.5, 0.5, bottom_of(i) + kThickness});
  return mesh;
}

Mesh make_box() {
  Mesh mesh;
  append_box(mesh, {-1, -0.7, -0.4}, {1, 0.7, 0.4});
  return mesh;
}

// A mesh, what walks need of it, and entries uniform over its area with a cosine distribution.
struct Body {
  Mesh mesh;
  Device device = make_device(1);
  DVec3 center{0};
  MeshBody body;
  EmptyBalls balls;
  std::vector<double> cumulative;

  explicit Body(Mesh m)
      : mesh(std::move(m)), body(device.get(), mesh, DMat3(1), center), balls(make_empty_balls(body, 1, 64)) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) cumulative.push_back(sum += glm::length(normal_of(t)));
  }
  [[nodiscard]] DVec3 normal_of(const Triangle& t) const {
    const DVec3& a = mesh.positions[t[0]];
    return glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
  }
  [[nodiscard]] Walker enter(Random& random) const {
    const double target = (random.next() + random.next() * 0x1p-24) * cumulative.back();
    const auto index = std::upper_bound(cumulative.begin(), cumulative.end(), target) - cumulative.begin();
    const Triangle& t = mesh.triangles[std::min<std::size_t>(index, mesh.triangles.size() - 1)];
    Real u = random.next();
    Real v = random.next();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const DVec3& a = mesh.positions[t[0]];
    const DVec3 p =
        a + double{u} * (mesh.positions[t[1]] - a) + double{v} * (mesh.positions[t[2]] - a) - center;
    const Vec3 normal(glm::normalize(normal_of(t)));
    const Real u1 = random.next();
    const Real u2 = random.next();
    Walker walker;
    walker.position = Vec3(p) - largest(body.half_size()) * Real(0x1p-21) * normal;
    walker.direction = make_lobe(-normal, -normal).sample({u1, u2});
    return walker;
  }
  [[nodiscard]] double mean_path() const { return 4 * signed_volume(mesh) / surface_area(mesh); }
};

// What walks from all over the surface do, by either code: how far they fly, how often they scatter, and
// whether they leave the plate that they have entered.
struct Walks {
  const Body& in;
  const Medium& medium;
  Moments length, order;
  std::uint64_t leaked = 0;
  std::uint64_t strayed = 0;
  std::uint32_t begun = 0;
  bool watch_plates = false;
  int plate[kLanes] = {};
  int scalar_lane = 0;

  [[nodiscard]] bool start(int lane, Walker& walker, Random& random) {
    if (begun == kWalks) return false;
    random = stream(3, 0, begun++);
    walker = in.enter(random);
    plate[lane] = plate_of(walker.position);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    add(result, walker);
    return start(lane, walker, random);
  }
  void collided(int lane, Real, const Walker& walker, const Random&) { watch(lane, walker); }
  [[nodiscard]] bool stop() const noexcept { return false; }

  // Of scalar walks.
  void segment(const Walker&, Real) const noexcept {}
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker& walker) { watch(scalar_lane, walker); }

  void add(const WalkResult& result, const Walker& walker) {
    leaked += result.end == WalkEnd::leaked;
    length.add(double{walker.weight.length});
    order.add(walker.weight.order);
  }
  [[nodiscard]] static int plate_of(const Vec3& p) {
    return static_cast<int>(std::floor(double{p.z} / (kThickness + kGap) + 0.5 * kPlates));
  }
  void watch(int lane, const Walker& walker) {
    if (!watch_plates) return;
    constexpr double kSlack = 1e-5;
    const double height = double{walker.position.z} - bottom_of(plate[lane]);
    const double side = double{std::max(std::abs(walker.position.x), std::abs(walker.position.y))};
    strayed += height < -kSlack || height > kThickness + kSlack || side > 0.5 + kSlack;
  }

  void run(WalkCode code) {
    if (code == WalkCode::batch) {
      LaneModel model{medium, {}, watch_plates};
      model.region.kind = SafeRegion::Kind::balls;
      model.region.balls = &in.balls;
      (void)LaneWalks(instruction_sets().back(), in.body, model, *this).run();
      return;
    }
    Walker walker;
    Random random({1, 0, 0, 0});
    while (start(0, walker, random))
      add(random_walk(in.body, WalkModel{medium, Estimator::implicit}, walker, random, *this), walker);
  }
};

// Where nothing is absorbed the mean path is 4V/S (Blanco & Fournier 2003), and no walk leaks.
void mean_paths(Verdict& v, WalkCode code, Mesh mesh) {
  const Body body(std::move(mesh));
  const double expected = body.mean_path();
  for (const double scatterings : {0.3, 2.0, 10.0}) {
    for (const Real g : {Real(-0.5), Real(0), Real(0.8)}) {
      const Medium medium{Rgb(static_cast<Real>(scatterings / expected)), Rgb(1), g};
      Walks walks{body, medium};
      walks.run(code);
      v.score("path", walks.length, expected);
      v.score("scatterings", walks.order, scatterings);
      v.require("leaked", static_cast<double>(walks.leaked), 0, 0);
    }
  }
}

void mean_path_box(Verdict& v, WalkCode code) { mean_paths(v, code, make_box()); }
void mean_path_knot(Verdict& v, WalkCode code) { mean_paths(v, code, make_torus_knot(300, 24)); }
void mean_path_plates(Verdict& v, WalkCode code) { mean_paths(v, code, make_plates()); }

// A walk stays in the plate that it has entered.
void own_plate(Verdict& v, WalkCode code) {
  const Body body(make_plates());
  for (const double scatterings : {0.5, 10.0}) {
    const Medium medium{Rgb(static_cast<Real>(scatterings / body.mean_path())), Rgb(1), 0};
    Walks walks{body, medium};
    walks.watch_plates = true;
    walks.run(code);
    v.require("collisions outside", static_cast<double>(walks.strayed), 0, 0);
  }
}

// A ray from inside of a box through an edge between two of its triangles leaves there. Another box makes the
// bounds so wide that what misses the edge does not end beyond them, which the tree would be asked about.
void edges(Verdict& v, WalkCode) {
  Mesh boxes = make_box();
  const std::size_t triangles = boxes.triangles.size();
  append_box(boxes, {-1.5, -1.5, -1.5}, {-1.4, -1.4, -1.4});
  append_box(boxes, {1.4, 1.4, 1.4}, {1.5, 1.5, 1.5});
  const Body body(boxes);
  int missed = 0;
  for (std::uint32_t i = 0; i < kWalks; ++i) {
    Random random = stream(4, 0, i);
    const Triangle& t = body.mesh.triangles[random.next_bits() % triangles];
    const double along = random.next();
    const Vec3 target(glm::mix(body.mesh.positions[t[i % 3]], body.mesh.positions[t[(i + 1) % 3]], along));
    const Real x = random.next();
    const Real y = random.next();
    const Real z = random.next();
    const Vec3 half(1, Real(0.7), Real(0.4));
    const Vec3 from = Real(0.9) * half * (Real(2) * Vec3(x, y, z) - Real(1));
    const Real distance = glm::distance(from, target);
    const Crossing crossing =
        body.body.first_crossing(from, (target - from) / distance, distance * Real(1.01));
    missed += crossing.kind != CrossingKind::exit || std::abs(crossing.distance - distance) > Real(1e-5);
  }
  v.require("missed", missed, 0, 0);
}

constexpr Oracle kOracles[]{{"mean_path_box", mean_path_box},
                            {"mean_path_knot", mean_path_knot},
                            {"mean_path_plates", mean_path_plates},
                            {"own_plate", own_plate},
                            {"edges", edges, false}};

}  // namespace

int main(int argc, char** argv) { return answer(kOracles, argc, argv); }
