#include "trace/mesh_cases.h"

#include <cmath>

#include "math/warp.h"
#include "stability/bodies.h"

namespace meander {

Mesh make_box_mesh(const DVec3& half) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(half * DVec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

namespace {

// Triangles of very different sizes that meet at sharp edges: needles about a long axis.
Mesh make_spindle(int sides) {
  Mesh mesh;
  mesh.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < sides; ++i) {
    const double t = 2 * glm::pi<double>() * i / sides;
    const double r = i % 2 ? 0.02 : 0.2;
    mesh.positions.emplace_back(r * std::cos(t), r * std::sin(t), 0.1 * std::sin(5 * t));
  }
  for (int i = 0; i < sides; ++i) {
    const auto a = static_cast<std::uint32_t>(2 + i);
    const auto b = static_cast<std::uint32_t>(2 + (i + 1) % sides);
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

}  // namespace

std::vector<MeshCase> mesh_cases() {
  return {{"sphere", make_sphere_mesh(71), 0.97},
          {"coarse sphere", make_sphere_mesh(3), 0.9},
          {"knot", make_torus_knot(), 0.9},
          {"box", make_box_mesh({1, 0.5, 0.25}), 0.8},
          {"shell", make_hollow_cube(0.01)},
          {"thin shell", make_hollow_cube(1e-4), kNoBalls},
          {"needle", make_box_mesh({1, 1e-3, 1e-3})},
          {"spindle", make_spindle(64)},
          {"needles", make_spindle(1000)},
          {"star", make_star(40)},
          {"fan", make_pyramid(1000), 0.95},
          {"strips", make_cube(1, 200), 0.97},
          {"doubled", doubled(make_sphere_mesh(8)), 0.97},
          {"touching", joined(make_touching_cubes()), 0.9},
          {"divided", make_divided_cube(), 0.9},
          {"leaf", with_leaf(make_cube()), 0.9}};
}

void enter_anywhere(const Mesh& mesh, const DVec3& center, Walker& walker, Random& random) {
  const Triangle& t = mesh.triangles[random.next_bits() % mesh.triangles.size()];
  const DVec3& a = mesh.positions[t[0]];
  const DVec3& b = mesh.positions[t[1]];
  const DVec3& c = mesh.positions[t[2]];
  const Vec3 normal(glm::normalize(glm::cross(b - a, c - a)));
  walker.position = Vec3((a + b + c) / 3.0 - center) - Real(0x1p-20) * normal;
  const Real u1 = random.next();
  const Real u2 = random.next();
  walker.direction = sample_sphere({u1, u2});
  if (glm::dot(walker.direction, normal) > 0) walker.direction = -walker.direction;
}

}  // namespace meander
