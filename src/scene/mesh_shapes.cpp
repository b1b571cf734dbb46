// Meshes of known shapes: exact normals, closed, wound outward.
#include <cassert>
#include <cmath>
#include <utility>

#include "scene/mesh.h"

namespace meander {

namespace {

constexpr double kKnotExtent = 3.62;  // of the unscaled knot: 2 + 1 to the curve, 0.62 to the skin
constexpr double kKnotTube = 0.62;

// A point of the knot's curve and two unit directions across it, with `out` x `side` along the curve.
struct KnotSection {
  DVec3 centre;
  DVec3 out;
  DVec3 side;
};

// The curve lies on the torus of radii 2 and 1 about z. That torus's normal is therefore across the curve
// everywhere and as periodic as the curve itself: the tube closes on itself without a seam.
KnotSection knot_section(double t) {
  const double c2 = std::cos(2 * t), s2 = std::sin(2 * t);
  const double c3 = std::cos(3 * t), s3 = std::sin(3 * t);
  const DVec3 centre{(c3 + 2) * c2, (c3 + 2) * s2, -s3};
  const DVec3 derivative{-3 * s3 * c2 - 2 * (c3 + 2) * s2, -3 * s3 * s2 + 2 * (c3 + 2) * c2, -3 * c3};
  const DVec3 out{c3 * c2, c3 * s2, -s3};
  return {centre / kKnotExtent, out, glm::cross(glm::normalize(derivative), out)};
}

// The corners of a regular icosahedron on the unit sphere: cyclic permutations of (0, +-1, +-golden ratio).
std::array<DVec3, 12> icosahedron_corners() {
  const double phi = 0.5 * (1 + std::sqrt(5.0));
  std::array<DVec3, 12> corners{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) {
      DVec3& corner = corners[4 * axis + k];
      corner[axis] = 0;
      corner[(axis + 1) % 3] = k & 1 ? -1 : 1;
      corner[(axis + 2) % 3] = k & 2 ? -phi : phi;
    }
  }
  return corners;
}

// The triples of mutually nearest corners (edge length 2), wound outward.
std::vector<Triangle> icosahedron_faces(const std::array<DVec3, 12>& corners) {
  const auto adjacent = [&](std::uint32_t a, std::uint32_t b) {
    return glm::distance(corners[a], corners[b]) < 2.1;
  };
  std::vector<Triangle> faces;
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!adjacent(a, b) || !adjacent(b, c) || !adjacent(c, a)) continue;
        const bool outward = glm::dot(corners[a], glm::cross(corners[b], corners[c])) > 0;
        faces.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
      }
    }
  }
  return faces;
}

// One icosahedron face split into splits^2 triangles. A point of an edge is the same two terms and a zero
// whichever face it is reckoned for, hence bit-equal, and welds.
void append_face(Mesh& mesh, const DVec3& a, const DVec3& b, const DVec3& c, int splits) {
  std::vector<std::uint32_t> above;
  for (int row = 0; row <= splits; ++row) {
    std::vector<std::uint32_t> current;
    for (int k = 0; k <= row; ++k) {
      current.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      const DVec3 point = double(splits - row) * a + double(row - k) * b + double(k) * c;
      mesh.positions.push_back(glm::normalize(point));
      mesh.normals.emplace_back(mesh.positions.back());
    }
    for (int k = 0; k < row; ++k) {
      mesh.triangles.push_back({above[k], current[k], current[k + 1]});
      if (k > 0) mesh.triangles.push_back({above[k - 1], current[k], above[k]});
    }
    above = std::move(current);
  }
}

}  // namespace

Mesh make_torus_knot(int along, int around) {
  assert(along >= 16 && around >= 3);
  Mesh mesh;
  for (int i = 0; i < along; ++i) {
    const KnotSection section = knot_section(2 * glm::pi<double>() * i / along);
    for (int j = 0; j < around; ++j) {
      const double angle = 2 * glm::pi<double>() * j / around;
      const DVec3 normal = std::cos(angle) * section.out + std::sin(angle) * section.side;
      mesh.positions.push_back(section.centre + kKnotTube / kKnotExtent * normal);
      mesh.normals.emplace_back(normal);
    }
  }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % along) * around + j % around);
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)});
      mesh.triangles.push_back({vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
    }
  }
  mesh.normal_triangles = mesh.triangles;
  return mesh;
}

Mesh make_sphere_mesh(int splits) {
  assert(splits >= 1);
  const std::array<DVec3, 12> corners = icosahedron_corners();
  Mesh mesh;
  for (const Triangle& face : icosahedron_faces(corners)) {
    append_face(mesh, corners[face[0]], corners[face[1]], corners[face[2]], splits);
  }
  mesh.normal_triangles = mesh.triangles;
  [[maybe_unused]] const MeshReport report = mend(mesh);
  assert(report.open_edges == 0 && report.dropped_triangles == 0);
  return mesh;
}

}  // namespace meander
