#include "stability/bodies.h"

#include <cmath>

namespace meander {

Mesh make_prism(const std::vector<glm::dvec2>& polygon, int along) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(polygon.size());
  const auto rings = static_cast<std::uint32_t>(along);
  glm::dvec2 middle(0);
  for (const glm::dvec2& p : polygon) middle += p / double(count);
  for (std::uint32_t ring = 0; ring <= rings; ++ring)
    for (const glm::dvec2& p : polygon) mesh.positions.emplace_back(p, -1 + 2.0 * ring / rings);
  const auto low = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(middle, -1);
  mesh.positions.emplace_back(middle, 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t j = (i + 1) % count;
    mesh.triangles.push_back({low, j, i});
    mesh.triangles.push_back({low + 1, rings * count + i, rings * count + j});
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
      const std::uint32_t below = ring * count;
      const std::uint32_t above = below + count;
      mesh.triangles.push_back({below + i, below + j, above + j});
      mesh.triangles.push_back({below + i, above + j, above + i});
    }
  }
  return mesh;
}

Mesh make_cube(int around, int along) {
  const glm::dvec2 corners[4]{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<glm::dvec2> polygon;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < around; ++i)
      polygon.push_back(glm::mix(corners[side], corners[(side + 1) % 4], double(i) / around));
  return make_prism(polygon, along);
}

Mesh make_pyramid(int sides) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * glm::pi<double>() * i / sides;
    mesh.positions.emplace_back(std::sin(angle), -1, std::cos(angle));
  }
  mesh.positions.emplace_back(0, 1, 0);
  mesh.positions.emplace_back(0, -1, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.triangles.push_back({i, (i + 1) % count, count});
    mesh.triangles.push_back({(i + 1) % count, i, count + 1});
  }
  return mesh;
}

Mesh make_star(int points) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(2 * points);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * glm::pi<double>() * i / count;
    const double radius = i % 2 ? 0.3 : 0.8;
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                0.1 * std::sin(5 * angle));
  }
  mesh.positions.emplace_back(0, 0, 1);
  mesh.positions.emplace_back(0, 0, -1);
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.triangles.push_back({count, i, (i + 1) % count});
    mesh.triangles.push_back({count + 1, (i + 1) % count, i});
  }
  return mesh;
}

std::pair<Mesh, Mesh> make_touching_cubes() {
  const auto half = [](Mesh cube, double x) {
    for (DVec3& p : cube.positions) p = 0.5 * p + DVec3(x, 0, 0);
    return cube;
  };
  return {half(make_cube(), -0.5), half(make_cube(3, 5), 0.5)};
}

Mesh joined(const std::pair<Mesh, Mesh>& meshes) {
  Mesh mesh = meshes.first;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), meshes.second.positions.begin(), meshes.second.positions.end());
  for (const Triangle& t : meshes.second.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return mesh;
}

Mesh make_divided_cube() {
  const DVec3 middle(0.1, 0.2, -0.15);
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    const DVec3 corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    Mesh block = make_cube();
    // On the middle exactly, or on the corner.
    for (DVec3& p : block.positions)
      for (int axis = 0; axis < 3; ++axis) {
        const double inner = p[axis] * corner[axis];  // -1 at the middle, 1 at the corner
        p[axis] = inner < 0 ? middle[axis] : inner > 0 ? corner[axis] : 0.5 * (middle[axis] + corner[axis]);
      }
    mesh = joined({mesh, block});
  }
  return mesh;
}

Mesh make_hollow_cube(double thickness) {
  Mesh mesh = make_cube();
  const Mesh hole = make_cube();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const DVec3& p : hole.positions) mesh.positions.push_back((1 - thickness) * p);
  for (const Triangle& t : hole.triangles)
    mesh.triangles.push_back({first + t[0], first + t[2], first + t[1]});
  return mesh;
}

Mesh doubled(Mesh mesh) {
  for (std::vector<Triangle>* triangles : {&mesh.triangles, &mesh.normal_triangles}) {
    const std::vector<Triangle> once = *triangles;
    triangles->insert(triangles->end(), once.begin(), once.end());
  }
  return mesh;
}

Mesh with_leaf(Mesh mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec2& p : {glm::dvec2(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    mesh.positions.emplace_back(p, 0.2);
  for (const Triangle& t : {Triangle{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}})
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return mesh;
}

Mesh shifted(Mesh mesh, const DVec3& by) {
  for (DVec3& position : mesh.positions) position += by;
  return mesh;
}

Mesh without_triangle(Mesh mesh, std::size_t number) {
  for (std::vector<Triangle>* triangles : {&mesh.triangles, &mesh.normal_triangles})
    if (!triangles->empty()) triangles->erase(triangles->begin() + static_cast<std::ptrdiff_t>(number));
  return mesh;
}

}  // namespace meander
