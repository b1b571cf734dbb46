// The clearance field of a mesh, see scene/empty_balls.h.
#pragma once

#include <atomic>
#include <optional>

#include "scene/empty_balls.h"
#include "trace/mesh_body.h"

namespace meander {

/// Cells along the longest side of the bounds, whatever the mean free path: what a finer field saves in rays
/// it loses in memory that is far away. Walks a second over those with 64 cells, one core: 100 820-triangle
/// sphere at a mean free path of 0.01, 96 cells 0.95, 128 0.89; torus knot at 0.01, 128 0.95; at 0.1, 32
/// cells 0.97, 128 0.83; at 0.3, 16 0.89, 32 0.99; at 3, 16 0.92, 32 0.98.
inline constexpr int kDefaultCells = 64;

/// Balls in the body's own coordinates, each smaller than the distance from its centre to the surface by more
/// than the rounding of a step in it. A cell that the surface crosses holds a ball that touches it (shrunk as
/// in Ma, Bae, Choi 2012, "3D Medial Axis Point Approximation Using Nearest Neighbors and the Normal Field"),
/// so that beside a smooth wall only a sliver of the cell is not in it. Such a ball, or a part of it, is
/// facing where every triangle that a step from the cell into it might meet has it on its inner side. On at
/// most `threads` threads; the same bytes on any number. Memory: 4 bytes a cell of the bounds and 16 to 32 a
/// cell at the surface, below 20 MB at 128 cells. Where the triangles lie so tangled that the search is not
/// worth its time, cells stay without balls: a block of 16^3 is given up after some 40 ms with 100k
/// triangles, four times what the dearest one of a torus knot takes. Nothing when `stop` came first.
[[nodiscard]] std::optional<EmptyBalls> make_empty_balls(const MeshBody& body, int threads, int cells,
                                                         const std::atomic<bool>& stop);
[[nodiscard]] EmptyBalls make_empty_balls(const MeshBody& body, int threads, int cells = kDefaultCells);

}  // namespace meander
