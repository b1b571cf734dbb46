// Without absorption the mean path inside any body is 4V/S under uniform diffuse light, whatever the medium
// (Blanco & Fournier 2003): a check of free paths, phase function, exits and leaks on every closed mesh that
// the project has.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/mesh_file.h"
#include "scene/scene.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/moments.h"
#include "trace/mesh_body.h"
#include "walk/lobe.h"
#include "walk/random_walk.h"

using namespace meander;

namespace {

struct SilentEvents {
  double path = 0;
  void segment(const Walker&, Real distance) noexcept { path += double{distance}; }
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

/// Walks that enter a mesh uniformly over its area with a cosine distribution.
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

// Scores the mean path and the mean number of scatterings in one medium, given by the number of scatterings.
void score_walks(const MeshBody& body, const UniformEntry& entry, double scatterings, double g,
                 std::vector<double>& scores) {
  const double expected = 4 * signed_volume(entry.mesh) / surface_area(entry.mesh);
  const double sigma = scatterings / expected;
  const WalkModel model{{Rgb(static_cast<Real>(sigma)), Rgb(1), static_cast<Real>(g)}, Estimator::implicit};
  Moments length;
  Moments order;
  std::uint64_t leaked = 0;
  for (std::uint32_t i = 0; i < 12000; ++i) {
    Random random = stream(2, 0, i);
    Walker walker;
    entry.start(walker, random, largest(body.half_size()) * Real(0x1p-21));
    SilentEvents events;
    leaked += random_walk(body, model, walker, random, events).end == WalkEnd::leaked;
    length.add(events.path);
    order.add(walker.weight.order);
  }
  CHECK(leaked == 0);
  scores.push_back(z_score(length.mean, expected, length.standard_error()));
  scores.push_back(z_score(order.mean, scatterings, order.standard_error()));
}

void check_mean_paths(const Mesh& mesh, std::vector<double>& scores) {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  const UniformEntry entry(mesh, center);
  for (const double scatterings : {0.5, 3.0, 20.0})
    for (const double g : {-0.5, 0.0, 0.8}) score_walks(body, entry, scatterings, g, scores);
  for (const DMat3& map : {DMat3(1e-3), DMat3(1e3), linear_part({{}, {20, 77, -40}, DVec3(1)})}) {
    Mesh moved = mesh;
    for (DVec3& position : moved.positions) position = map * position;
    const MeshBody moved_body(device.get(), mesh, map, center);
    score_walks(moved_body, UniformEntry(moved, center), 3, 0.8, scores);
  }
}

}  // namespace

TEST_CASE("the mean path in every closed mesh is 4V/S, whatever the medium, size and orientation") {
  std::vector<double> scores;
  check_mean_paths(make_torus_knot(), scores);
  check_mean_paths(make_sphere_mesh(30), scores);
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(MEANDER_SOURCE_DIR) + "/scenes")) {
    if (file.path().extension() != ".ply") continue;
    const MeshFile mesh = load_mesh(file.path().string(), false);
    REQUIRE(mesh.report.open_edges == 0);
    check_mean_paths(mesh.mesh, scores);
    ++files;
  }
  CHECK(files > 0);
  const double threshold = two_sided_threshold(sidak_level(1e-3, scores.size()));
  for (const double z : scores) CHECK(std::abs(z) < threshold);
}
