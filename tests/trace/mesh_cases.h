// Closed meshes that every test of the clearance field and of the rays at the surface goes through.
#pragma once

#include <string>
#include <vector>

#include "math/random.h"
#include "scene/mesh.h"
#include "walk/random_walk.h"

namespace meander {

inline constexpr double kNoBalls = -1;  // its walls are too thin for any

struct MeshCase {
  std::string name;
  Mesh mesh;
  double covered = 0;  // of the inside by balls, at least; or kNoBalls
};

/// A closed box about the origin.
[[nodiscard]] Mesh make_box_mesh(const DVec3& half);

/// Smooth and coarse ones, thin walls, needles, sharp edges, grooves, many triangles at a vertex, walls at
/// one place. The tips of "needles" are so sharp that where a ray leaves them is rounding.
[[nodiscard]] std::vector<MeshCase> mesh_cases();

/// Sends a walk inward from the middle of any triangle of a mesh whose body is centred on `center`.
void enter_anywhere(const Mesh& mesh, const DVec3& center, Walker& walker, Random& random);

}  // namespace meander
