#include "film/tiles.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace meander {

namespace {

/// Four times the squared distance of the tile's centre from the image's: exact in integers.
std::int64_t distance_from_centre(const Tile& tile, int width, int height) {
  const std::int64_t dx = std::int64_t(tile.x0) + tile.x1 - width;
  const std::int64_t dy = std::int64_t(tile.y0) + tile.y1 - height;
  return dx * dx + dy * dy;
}

}  // namespace

std::vector<Tile> make_tiles(int width, int height, const std::optional<Tile>& crop, int size) {
  assert(width >= 0 && height >= 0 && size > 0);
  Tile whole{0, 0, width, height};
  if (crop) {
    whole = {std::max(crop->x0, 0), std::max(crop->y0, 0), std::min(crop->x1, width),
             std::min(crop->y1, height)};
  }
  std::vector<Tile> tiles;
  if (whole.x0 >= whole.x1 || whole.y0 >= whole.y1) return tiles;
  // The tiles lie on the image's own grid, so that a crop's are those of the whole image, cut.
  for (int y = whole.y0 / size * size; y < whole.y1; y += size) {
    for (int x = whole.x0 / size * size; x < whole.x1; x += size) {
      tiles.push_back({std::max(x, whole.x0), std::max(y, whole.y0), std::min(x + size, whole.x1),
                       std::min(y + size, whole.y1)});
    }
  }
  std::stable_sort(tiles.begin(), tiles.end(), [&](const Tile& a, const Tile& b) {
    return distance_from_centre(a, width, height) < distance_from_centre(b, width, height);
  });
  return tiles;
}

}  // namespace meander
