// The image cut into square tiles, in the order in which they are rendered: the middle first.
#pragma once

#include <optional>
#include <vector>

namespace meander {

/// Pixels x0 <= x < x1, y0 <= y < y1; row 0 at the top.
struct Tile {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  [[nodiscard]] bool operator==(const Tile&) const = default;
};

inline constexpr int kTileSize = 16;

/// Tiles of `size` x `size` pixels (> 0) on the image's own grid, smaller at its right and bottom edges and
/// where `crop` cuts them; a crop is first clipped to the image. Every pixel of it lies in one tile exactly.
/// Sorted by the distance of the tile's centre from the image's, then by row and column. The image is at
/// least 0 x 0.
[[nodiscard]] std::vector<Tile> make_tiles(int width, int height, const std::optional<Tile>& crop = {},
                                           int size = kTileSize);

}  // namespace meander
