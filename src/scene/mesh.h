// Triangle meshes as plain data, and the questions a medium asks of them: closed? how large? which way out?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace meander {

using Triangle = std::array<std::uint32_t, 3>;

/// Counter-clockwise triangles seen from outside. Positions in scene units. Normals are unit shading normals
/// with triangles of their own, so that a hard edge can share its positions: either both lists are empty, or
/// normal_triangles[t] names the normals of the corners of triangles[t].
struct Mesh {
  std::vector<DVec3> positions;
  std::vector<Triangle> triangles;
  std::vector<glm::vec3> normals;
  std::vector<Triangle> normal_triangles;
};

struct Bounds {
  DVec3 low{0.0};
  DVec3 high{0.0};
};

/// What was found and mended on the way in.
struct MeshReport {
  std::size_t welded_positions = 0;   // equal to an earlier position, and merged with it
  std::size_t dropped_triangles = 0;  // with two equal corners
  std::size_t open_edges = 0;         // see count_open_edges
  bool flipped = false;               // it was inside out, and was turned
};

/// Welds equal positions (bit-equal, or differing in the sign of a zero; normals stay with their corners),
/// drops triangles with two equal corners and positions without a triangle, counts open edges, and turns a
/// closed mesh whose signed volume is negative. Shading normals that mostly face against their triangles are
/// turned too. Positions must be finite and indices in range. Positions are ordered by first use; the result
/// depends on nothing but the mesh.
[[nodiscard]] MeshReport mend(Mesh& mesh);

/// Pairs of positions that triangles pass more often in one direction than in the other; a mesh with none is
/// closed, and encloses a volume. Edges shared by four triangles, two each way, are closed; a triangle given
/// twice opens its three edges. Corners are told apart by index: weld first. At most 2^31 positions.
[[nodiscard]] std::size_t count_open_edges(const Mesh& mesh);

/// Volume enclosed (negative when inside out), by the divergence theorem about the bounds' centre, so that it
/// is as exact far from the origin as at it. Scene units cubed.
[[nodiscard]] double signed_volume(const Mesh& mesh);
[[nodiscard]] double surface_area(const Mesh& mesh);
/// Of all positions; both corners zero when there are none.
[[nodiscard]] Bounds bounds_of(const Mesh& mesh);

/// Tube of radius 0.62/3.62 about the curve ((cos 3t + 2) cos 2t, (cos 3t + 2) sin 2t, -sin 3t) / 3.62, which
/// fits the unit sphere; 2 * around * along triangles, with the tube's exact normals. around >= 3, along
/// >= 16.
[[nodiscard]] Mesh make_torus_knot(int along = 1000, int around = 50);

/// Sphere of radius 1 as a mesh: an icosahedron with every edge split in `splits` >= 1, 20 splits^2
/// triangles, with the sphere's exact normals.
[[nodiscard]] Mesh make_sphere_mesh(int splits);

}  // namespace meander
