#include "scene/mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace meander;

namespace {

constexpr double kPiD = glm::pi<double>();

// The cube [0, 1]^3 with four positions of its own on each face, as most exporters write it: hard edges.
Mesh make_loose_cube() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const auto base = static_cast<std::uint32_t>(mesh.positions.size());
      glm::vec3 normal{0.0f};
      normal[axis] = side ? 1.0f : -1.0f;
      for (int k = 0; k < 4; ++k) {
        DVec3 corner{0.0};
        corner[axis] = side;
        corner[(axis + 1) % 3] = k == 1 || k == 2;
        corner[(axis + 2) % 3] = k >= 2;
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
      }
      const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.push_back(side ? Triangle{base + a, base + b, base + c}
                                      : Triangle{base + a, base + c, base + b});
      };
      quad(0, 1, 2);
      quad(0, 2, 3);
    }
  }
  mesh.normal_triangles = mesh.triangles;
  return mesh;
}

void turn_inside_out(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  for (Triangle& t : mesh.normal_triangles) std::swap(t[0], t[1]);
}

std::size_t count_edges(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax({t[k], t[(k + 1) % 3]}));
  }
  return edges.size();
}

long euler_characteristic(const Mesh& mesh) {
  return long(mesh.positions.size()) - long(count_edges(mesh)) + long(mesh.triangles.size());
}

// The largest angle, in degrees, between a corner's shading normal and its triangle's own.
double worst_normal_angle(const Mesh& mesh) {
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& p = mesh.triangles[t];
    const DVec3& a = mesh.positions[p[0]];
    const DVec3 own = glm::normalize(glm::cross(mesh.positions[p[1]] - a, mesh.positions[p[2]] - a));
    for (const std::uint32_t n : mesh.normal_triangles[t])
      least = std::min(least, glm::dot(own, DVec3(mesh.normals[n])));
  }
  return glm::degrees(std::acos(std::clamp(least, -1.0, 1.0)));
}

double knot_length() {
  double sum = 0;
  constexpr int kSteps = 4096;  // a periodic integrand: the trapezoid rule is exact to rounding
  for (int i = 0; i < kSteps; ++i) {
    const double r = 2 + std::cos(3 * 2 * kPiD * i / kSteps);
    sum += std::sqrt(9 + 4 * r * r);
  }
  return sum * 2 * kPiD / kSteps / 3.62;
}

}  // namespace

TEST_CASE("mending a cube of loose faces welds it shut and keeps its hard edges") {
  Mesh cube = make_loose_cube();
  CHECK(count_open_edges(cube) == 24);
  const MeshReport report = mend(cube);
  CHECK(report.welded_positions == 16);
  CHECK(report.dropped_triangles == 0);
  CHECK(report.open_edges == 0);
  CHECK_FALSE(report.flipped);
  CHECK(cube.positions.size() == 8);
  CHECK(cube.triangles.size() == 12);
  REQUIRE(cube.normal_triangles.size() == 12);
  CHECK(worst_normal_angle(cube) == 0);
  CHECK(signed_volume(cube) == doctest::Approx(1).epsilon(1e-15));
  CHECK(surface_area(cube) == doctest::Approx(6).epsilon(1e-15));
  CHECK(euler_characteristic(cube) == 2);
}

TEST_CASE("mending twice changes nothing") {
  Mesh once = make_loose_cube();
  static_cast<void>(mend(once));
  Mesh twice = once;
  const MeshReport report = mend(twice);
  CHECK(report.welded_positions == 0);
  CHECK(twice.positions == once.positions);
  CHECK(twice.triangles == once.triangles);
  CHECK(twice.normal_triangles == once.normal_triangles);
}

TEST_CASE("the two zeros weld, and the next float does not") {
  Mesh mesh;
  mesh.positions = {{0.0, 0.0, 0.0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0.0, -0.0}, {0, 1, 5e-324}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  CHECK(mend(mesh).welded_positions == 2);
  CHECK(mesh.positions.size() == 4);
}

TEST_CASE("an inside-out mesh is turned, and its normals with it") {
  for (const bool normals_follow : {false, true}) {
    Mesh cube = make_loose_cube();
    turn_inside_out(cube);
    if (normals_follow) {
      for (glm::vec3& n : cube.normals) n = -n;
    }
    const MeshReport report = mend(cube);
    CHECK(report.flipped);
    CHECK(signed_volume(cube) == doctest::Approx(1).epsilon(1e-15));
    CHECK(worst_normal_angle(cube) == 0);
  }
}

TEST_CASE("normals that face against an outward winding are turned alone") {
  Mesh cube = make_loose_cube();
  for (glm::vec3& n : cube.normals) n = -n;
  CHECK_FALSE(mend(cube).flipped);
  CHECK(worst_normal_angle(cube) == 0);
}

TEST_CASE("open meshes are counted edge by edge and never turned") {
  Mesh cube = make_loose_cube();
  turn_inside_out(cube);
  cube.triangles.pop_back();
  cube.normal_triangles.pop_back();
  MeshReport report = mend(cube);
  CHECK(report.open_edges == 3);
  CHECK_FALSE(report.flipped);
  CHECK(signed_volume(cube) < 0);

  Mesh strip;
  strip.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  strip.triangles = {{0, 1, 2}, {1, 3, 2}};
  CHECK(count_open_edges(strip) == 4);
  strip.triangles[1] = {1, 2,
                        3};  // wound against its neighbour: the shared edge is passed twice the same way
  CHECK(count_open_edges(strip) == 5);
}

TEST_CASE("a triangle given twice opens its three edges") {
  Mesh cube = make_loose_cube();
  cube.triangles.push_back(cube.triangles.front());
  cube.normal_triangles.push_back(cube.normal_triangles.front());
  CHECK(mend(cube).open_edges == 3);
}

TEST_CASE("two cubes that touch along an edge are closed") {
  Mesh both = make_loose_cube();
  const Mesh other = make_loose_cube();
  for (const DVec3& p : other.positions) both.positions.push_back(p + DVec3(1, 1, 0));
  both.normals.insert(both.normals.end(), other.normals.begin(), other.normals.end());
  for (const Triangle& t : other.triangles) both.triangles.push_back({t[0] + 24, t[1] + 24, t[2] + 24});
  both.normal_triangles = both.triangles;
  CHECK(mend(both).open_edges == 0);
  CHECK(both.positions.size() == 14);
  CHECK(signed_volume(both) == doctest::Approx(2).epsilon(1e-15));
}

TEST_CASE("triangles that collapse under welding are dropped with their normals and their positions") {
  Mesh cube = make_loose_cube();
  const auto n = static_cast<std::uint32_t>(cube.positions.size());
  cube.positions.insert(cube.positions.end(), {{9, 9, 9}, {9, 9, 9}, {0, 0, 0}});
  cube.triangles.insert(cube.triangles.begin(), {{n, n + 1, n + 2}, {0, 0, 1}});
  cube.normal_triangles.insert(cube.normal_triangles.begin(), {{0, 0, 0}, {0, 0, 0}});
  const MeshReport report = mend(cube);
  CHECK(report.dropped_triangles == 2);
  CHECK(report.open_edges == 0);
  CHECK(cube.positions.size() == 8);
  CHECK(bounds_of(cube).high == DVec3(1));
  CHECK(worst_normal_angle(cube) == 0);
}

TEST_CASE("an empty mesh mends to an empty mesh") {
  Mesh empty;
  const MeshReport report = mend(empty);
  CHECK(report.open_edges == 0);
  CHECK_FALSE(report.flipped);
  CHECK(bounds_of(empty).high == DVec3(0));
  CHECK(signed_volume(empty) == 0);
}

TEST_CASE("a volume ten thousand sizes from the origin keeps its digits") {
  Mesh knot = make_torus_knot(100, 12);
  const double at_origin = signed_volume(knot);
  for (DVec3& p : knot.positions) p += DVec3(2e4, -1e4, 3e4);
  CHECK(signed_volume(knot) == doctest::Approx(at_origin).epsilon(1e-10));
}

TEST_CASE("the torus knot is a closed outward tube in the unit sphere") {
  Mesh knot = make_torus_knot();
  CHECK(knot.triangles.size() == 100000);
  CHECK(euler_characteristic(knot) == 0);
  // Half of one of 50 facets is 3.6 degrees; bend and twist from one section to the next add up to 1.4 more.
  const double angle = worst_normal_angle(knot);
  CHECK(angle < 5);
  CHECK(angle / worst_normal_angle(make_torus_knot(2000, 100)) == doctest::Approx(2).epsilon(0.01));
  double farthest = 0;
  for (const DVec3& p : knot.positions) farthest = std::max(farthest, glm::length(p));
  CHECK(farthest <= 1 + 1e-15);
  CHECK(farthest > 0.9999);
  const MeshReport report = mend(knot);
  CHECK(report.welded_positions == 0);
  CHECK(report.dropped_triangles == 0);
  CHECK(report.open_edges == 0);
  CHECK_FALSE(report.flipped);
}

TEST_CASE("the torus knot's volume and area converge to Pappus's at second order") {
  const double radius = 0.62 / 3.62;
  const double volume = kPiD * radius * radius * knot_length();
  const double area = 2 * kPiD * radius * knot_length();
  const Mesh coarse = make_torus_knot(400, 32);
  const Mesh fine = make_torus_knot(800, 64);
  const double volume_error = volume - signed_volume(fine);
  const double area_error = area - surface_area(fine);
  CHECK(volume_error / volume == doctest::Approx(0).epsilon(2e-3));
  CHECK(area_error / area == doctest::Approx(0).epsilon(2e-3));
  CHECK((volume - signed_volume(coarse)) / volume_error == doctest::Approx(4).epsilon(0.01));
  CHECK((area - surface_area(coarse)) / area_error == doctest::Approx(4).epsilon(0.01));
}

TEST_CASE("the torus knot's normals point straight out of its tube") {
  const Mesh knot = make_torus_knot(64, 8);
  REQUIRE(knot.normals.size() == knot.positions.size());
  CHECK(knot.normal_triangles == knot.triangles);
  for (int i = 0; i < 64; ++i) {
    DVec3 centre{0.0};
    for (int j = 0; j < 8; ++j) centre += knot.positions[8 * i + j] / 8.0;
    for (int j = 0; j < 8; ++j) {
      const DVec3 out = (knot.positions[8 * i + j] - centre) * (3.62 / 0.62);
      CHECK(glm::length(out - DVec3(knot.normals[8 * i + j])) < 1e-7);
    }
  }
}

TEST_CASE("the sphere mesh is a closed outward sphere of 20 splits^2 triangles") {
  for (const int splits : {1, 2, 3, 7, 40}) {
    Mesh sphere = make_sphere_mesh(splits);
    CAPTURE(splits);
    CHECK(sphere.triangles.size() == 20 * splits * splits);
    CHECK(sphere.positions.size() == 10 * splits * splits + 2);
    CHECK(euler_characteristic(sphere) == 2);
    double worst_radius = 0;
    double worst_normal = 0;
    for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const DVec3& p = sphere.positions[sphere.triangles[t][k]];
        worst_radius = std::max(worst_radius, std::abs(glm::length(p) - 1));
        worst_normal =
            std::max(worst_normal, glm::length(p - DVec3(sphere.normals[sphere.normal_triangles[t][k]])));
      }
    }
    CHECK(worst_radius < 1e-15);
    CHECK(worst_normal < 1e-7);
    const MeshReport report = mend(sphere);
    CHECK(report.open_edges == 0);
    CHECK_FALSE(report.flipped);
  }
}

TEST_CASE("the sphere mesh's volume and area converge to the sphere's at second order") {
  const Mesh coarse = make_sphere_mesh(20);
  const Mesh fine = make_sphere_mesh(40);
  const double volume_error = 4 * kPiD / 3 - signed_volume(fine);
  const double area_error = 4 * kPiD - surface_area(fine);
  CHECK(volume_error > 0);
  CHECK(volume_error < 4e-3);
  CHECK(area_error < 8e-3);
  CHECK((4 * kPiD / 3 - signed_volume(coarse)) / volume_error == doctest::Approx(4).epsilon(0.01));
  CHECK((4 * kPiD - surface_area(coarse)) / area_error == doctest::Approx(4).epsilon(0.01));
}
