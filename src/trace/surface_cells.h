// A sparse grid that knows which packets of triangles reach into each of its cells: what a ray asks instead
// of walking down a tree.
#pragma once

#include "trace/packets.h"

namespace meander {

/// Bricks of 4 x 4 x 4 cells, x fastest; a set bit is a cell that some triangle reaches, or comes nearer to
/// than a small part of its side. Empty (no bricks) where the mesh is too crowded for a grid.
struct SurfaceCells {
  struct Brick {
    std::uint64_t cells = 0;
    std::uint32_t first = 0;  // the list of the brick's first set cell
  };

  static constexpr std::uint32_t kMore = 0x80000000;

  /// Packets; where there are fewer than four, then Packets::nothing(), and where there are more, three and
  /// kMore + the list that goes on.
  struct alignas(16) List {
    std::uint32_t packets[4];
  };

  glm::vec3 low{0};
  float cells_per_unit = 1;
  glm::ivec3 size{0};  // in cells, multiples of 4
  glm::ivec3 bricks_size{0};
  std::vector<Brick> bricks;
  std::vector<List> lists;  // of the set cells in turn, then what did not fit

  [[nodiscard]] std::size_t bytes() const noexcept {
    return bricks.size() * sizeof(Brick) + lists.size() * sizeof(List);
  }
};

/// For a mesh whose bounds reach from -half to half, in units in which it is of a size about 1. At most about
/// 256 cells along a side and 8 packets' entries a triangle.
[[nodiscard]] SurfaceCells make_surface_cells(const Packets& packets, const glm::vec3& half);

}  // namespace meander
