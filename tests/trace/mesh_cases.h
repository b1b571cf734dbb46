// Closed meshes that every test of the clearance field and of the rays at the surface goes through.
#pragma once

#include <string>
#include <vector>

#include "scene/mesh.h"

namespace meander {

inline constexpr double kNoBalls = -1;  // its walls are too thin for any

struct MeshCase {
  std::string name;
  Mesh mesh;
  double covered = 0;  // of the inside by balls, at least; or kNoBalls
};

/// A closed box about the origin.
[[nodiscard]] Mesh make_box_mesh(const DVec3& half);

/// Triangles of very different sizes that meet at sharp edges: `sides` needles about a long axis.
[[nodiscard]] Mesh make_spindle(int sides);

/// Smooth and coarse ones, thin walls, needles, sharp edges, grooves, many triangles at a vertex, walls at
/// one place. With a thousand `sides` a spindle's tips are so sharp that where a ray leaves them is rounding.
[[nodiscard]] std::vector<MeshCase> mesh_cases();

/// The case of that name.
[[nodiscard]] MeshCase mesh_case(const std::string& name);

}  // namespace meander
