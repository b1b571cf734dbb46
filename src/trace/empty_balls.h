// The clearance field of a mesh, see scene/empty_balls.h.
#pragma once

#include "scene/empty_balls.h"
#include "trace/mesh_body.h"

namespace meander {

/// Cells along the longest side of the bounds.
inline constexpr int kDefaultCells = 64;

/// The number of cells that suits walks of a mean free path (in scene units): cells of about three of them,
/// 64 to 128. 0 where a walk leaves after a step or two, and balls spare it nothing.
[[nodiscard]] int cells_for(const MeshBody& body, Real mean_free_path) noexcept;

/// Balls in the body's own coordinates, each smaller than the distance from its centre to the surface by more
/// than the rounding of a step in it. A cell that the surface crosses holds a ball that touches it (shrunk as
/// in Ma, Bae, Choi 2012, "3D Medial Axis Point Approximation Using Nearest Neighbors and the Normal Field"),
/// so that beside a smooth wall only a sliver of the cell is not in it. Such a ball, or a part of it, is
/// facing where every triangle that a step from the cell into it might meet has it on its inner side. On at
/// most `threads` threads; the same bytes on any number. Memory: 4 bytes a cell of the bounds and 16 to 32 a
/// cell at the surface, below 20 MB at 128 cells.
[[nodiscard]] EmptyBalls make_empty_balls(const MeshBody& body, int threads, int cells = kDefaultCells);

}  // namespace meander
