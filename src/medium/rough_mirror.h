// What a rough interface sends back into a half-space, on the half-space's own grid.
#pragma once

#include "medium/half_space.h"

namespace meander {

/// Entry (i, j): of light that comes up at node j the part that goes down again at node i, in the symmetric
/// coordinates of HalfSpace (radiance weighted by sqrt(weight mu)). `roughness` in (0, 1], ior in (1, 4].
/// Made by following a fixed set of samples over the facets (sample_rough_dielectric), so that it is the same
/// at every call; what a smooth mirror would have at a node is on the diagonal.
[[nodiscard]] SquareMatrix rough_mirror(const AngularGrid& grid, double roughness, double ior);

}  // namespace meander
