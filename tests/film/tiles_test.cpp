#include "film/tiles.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace meander {

namespace {

/// How often each pixel of the image lies in a tile; tiles must lie inside.
std::vector<int> coverage(const std::vector<Tile>& tiles, int width, int height) {
  std::vector<int> counts(static_cast<std::size_t>(width) * height, 0);
  for (const Tile& tile : tiles) {
    REQUIRE(tile.x0 >= 0);
    REQUIRE(tile.y0 >= 0);
    REQUIRE(tile.x0 < tile.x1);
    REQUIRE(tile.y0 < tile.y1);
    REQUIRE(tile.x1 <= width);
    REQUIRE(tile.y1 <= height);
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) ++counts[static_cast<std::size_t>(y) * width + x];
    }
  }
  return counts;
}

double centre_distance(const Tile& tile, int width, int height) {
  return std::hypot(0.5 * (tile.x0 + tile.x1) - 0.5 * width, 0.5 * (tile.y0 + tile.y1) - 0.5 * height);
}

}  // namespace

TEST_CASE("tiles cover each pixel of the image exactly once") {
  for (const auto& [width, height] : {std::pair{1, 1}, {16, 16}, {17, 5}, {960, 540}, {33, 100}}) {
    CAPTURE(width);
    CAPTURE(height);
    const std::vector<int> counts = coverage(make_tiles(width, height), width, height);
    CHECK(counts == std::vector<int>(counts.size(), 1));
  }
  CHECK(make_tiles(33, 100).size() == 3 * 7);
}

TEST_CASE("tiles of a crop cover its pixels once and no others") {
  const Tile crop{5, 20, 40, 33};
  const std::vector<int> counts = coverage(make_tiles(64, 48, crop), 64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool inside = x >= crop.x0 && x < crop.x1 && y >= crop.y0 && y < crop.y1;
      REQUIRE(counts[static_cast<std::size_t>(y) * 64 + x] == (inside ? 1 : 0));
    }
  }
}

TEST_CASE("the tiles of a crop are those of the image, cut") {
  const std::vector<Tile> tiles = make_tiles(64, 48, Tile{5, 20, 40, 33});
  CHECK(tiles.size() == 6);
  for (const Tile& tile : tiles) {
    CHECK(tile.x0 / kTileSize == (tile.x1 - 1) / kTileSize);
    CHECK(tile.y0 / kTileSize == (tile.y1 - 1) / kTileSize);
  }
}

TEST_CASE("a crop is clipped to the image, and one outside it or without pixels has no tiles") {
  CHECK(make_tiles(20, 10, Tile{-5, -5, 100, 100}) == make_tiles(20, 10));
  CHECK(make_tiles(20, 10, Tile{20, 0, 30, 10}).empty());
  CHECK(make_tiles(20, 10, Tile{8, 4, 8, 9}).empty());
  CHECK(make_tiles(20, 10, Tile{9, 4, 3, 9}).empty());
  CHECK(make_tiles(0, 0).empty());
}

TEST_CASE("tiles run from the centre of the image outwards, crop or not") {
  for (const std::optional<Tile>& crop : {std::optional<Tile>{}, std::optional<Tile>{Tile{3, 3, 150, 60}}}) {
    const std::vector<Tile> tiles = make_tiles(200, 90, crop);
    for (std::size_t i = 1; i < tiles.size(); ++i) {
      CHECK(centre_distance(tiles[i - 1], 200, 90) <= centre_distance(tiles[i], 200, 90));
    }
  }
  const std::vector<Tile> odd = make_tiles(48, 48);
  CHECK(odd.front() == Tile{16, 16, 32, 32});
  CHECK(odd[1] == Tile{16, 0, 32, 16});  // equally far ones by row, then column
  CHECK(odd[2] == Tile{0, 16, 16, 32});
  CHECK(odd.back() == Tile{32, 32, 48, 48});
}

TEST_CASE("the tile size is the one asked for") {
  for (const Tile& tile : make_tiles(64, 64, {}, 8)) CHECK((tile.x1 - tile.x0) * (tile.y1 - tile.y0) == 64);
}

}  // namespace meander
