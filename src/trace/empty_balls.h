// The clearance field of a mesh, see scene/empty_balls.h.
#pragma once

#include "scene/empty_balls.h"
#include "trace/mesh_body.h"

namespace meander {

/// Cells along the longest side of the bounds.
inline constexpr int kDefaultCells = 128;

/// Balls in the body's own coordinates, each smaller than the distance from its centre to the surface by more
/// than the rounding of a step in it. A cell that the surface crosses holds a ball that touches it (shrunk as
/// in Ma, Bae, Choi 2012, "3D Medial Axis Point Approximation Using Nearest Neighbors and the Normal Field"),
/// so that beside a smooth wall only a sliver of the cell is not in it. On at most `threads` threads; the
/// same bytes on any number.
[[nodiscard]] EmptyBalls make_empty_balls(const MeshBody& body, int threads, int cells = kDefaultCells);

}  // namespace meander
