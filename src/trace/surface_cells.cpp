#include "trace/surface_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace meander {
namespace {

constexpr float kSlack = 0x1p-6f;       // of a cell: how far beyond its triangle a packet is listed
constexpr float kTrianglesPerCell = 4;  // of the surface that crosses it, about
constexpr int kMostCells = 256;         // along the longest side
constexpr int kLeastCells = 8;
constexpr std::size_t kMostEntries = 8;  // of the lists, a triangle

struct Entry {
  std::uint32_t cell;
  std::uint32_t packet;
};

std::uint32_t number_of(const glm::ivec3& cell, const glm::ivec3& size) {
  const int brick = ((cell.z / 4) * (size.y / 4) + cell.y / 4) * (size.x / 4) + cell.x / 4;
  return static_cast<std::uint32_t>(brick * 64 + ((cell.z & 3) * 4 + (cell.y & 3)) * 4 + (cell.x & 3));
}

// Adds the cells that a triangle, in cells, reaches: column after column along the axis that its plane is
// steepest to, of which it reaches but a few cells.
void list_cells(const glm::vec3 (&corner)[3], const glm::ivec3& size, std::vector<std::uint32_t>& cells) {
  const glm::vec3 low = glm::min(corner[0], glm::min(corner[1], corner[2])) - kSlack;
  const glm::vec3 high = glm::max(corner[0], glm::max(corner[1], corner[2])) + kSlack;
  const glm::ivec3 first = glm::clamp(glm::ivec3(glm::floor(low)), glm::ivec3(0), size - 1);
  const glm::ivec3 last = glm::clamp(glm::ivec3(glm::floor(high)), glm::ivec3(0), size - 1);
  const DVec3 start(corner[0]);
  const DVec3 normal = glm::cross(DVec3(corner[1]) - start, DVec3(corner[2]) - start);
  const DVec3 steepness = glm::abs(normal);
  const int w =
      steepness.x > steepness.y ? (steepness.x > steepness.z ? 0 : 2) : (steepness.y > steepness.z ? 1 : 2);
  const int u = (w + 1) % 3;
  const int v = (w + 2) % 3;
  // How far the plane may be from the middle of a cell that it reaches.
  const double reach = (0.5 + double{kSlack}) * (steepness.x + steepness.y + steepness.z);
  for (int i = first[u]; i <= last[u]; ++i)
    for (int j = first[v]; j <= last[v]; ++j) {
      const double rest = normal[u] * (i + 0.5 - start[u]) + normal[v] * (j + 0.5 - start[v]);
      int k = first[w];
      int end = last[w];
      if (steepness[w] > 0) {
        const double plane = start[w] - 0.5 - rest / normal[w];
        k = std::max(k, static_cast<int>(std::ceil(plane - reach / steepness[w])));
        end = std::min(end, static_cast<int>(std::floor(plane + reach / steepness[w])));
      }
      glm::ivec3 cell;
      for (cell[u] = i, cell[v] = j; k <= end; ++k) {
        cell[w] = k;
        cells.push_back(number_of(cell, size));
      }
    }
}

// What each packet reaches, packet after packet; nothing when that is more than `most`.
std::vector<Entry> list_entries(const Packets& packets, const SurfaceCells& grid, std::size_t most) {
  std::vector<Entry> entries;
  std::vector<std::uint32_t> cells;
  for (std::uint32_t n = 0; n < packets.packets.size(); ++n) {
    const Packet& packet = packets.packets[n];
    cells.clear();
    for (std::size_t i = 0; i < kPacket; ++i) {
      if (i > 0 && packet.triangle[i] == packet.triangle[i - 1]) break;
      glm::vec3 corner[3];
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          corner[k][axis] = (packet.corner[k][axis][i] - grid.low[axis]) * grid.cells_per_unit;
      list_cells(corner, grid.size, cells);
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    for (const std::uint32_t cell : cells) entries.push_back({cell, n});
    if (entries.size() > most) return {};
  }
  return entries;
}

SurfaceCells make_grid(const glm::vec3& half, float cell) {
  SurfaceCells grid;
  grid.cells_per_unit = 1 / cell;
  // A margin of half a cell at least, for rays that start a little behind the surface.
  grid.bricks_size = glm::ivec3(glm::ceil((2.0f * half / cell + 1.0f) / 4.0f));
  grid.size = 4 * grid.bricks_size;
  grid.low = glm::vec3(grid.size) * (-0.5f * cell);
  return grid;
}

// Sorts the entries into the cells' lists.
void fill(SurfaceCells& grid, const std::vector<Entry>& entries, std::uint32_t nothing) {
  grid.bricks.resize(static_cast<std::size_t>(grid.bricks_size.x) * grid.bricks_size.y * grid.bricks_size.z);
  for (const Entry& e : entries) grid.bricks[e.cell / 64].cells |= std::uint64_t{1} << (e.cell % 64);
  std::uint32_t set = 0;
  for (SurfaceCells::Brick& brick : grid.bricks) {
    brick.first = set;
    set += static_cast<std::uint32_t>(std::popcount(brick.cells));
  }
  const auto number = [&](std::uint32_t cell) {
    const SurfaceCells::Brick& brick = grid.bricks[cell / 64];
    const std::uint64_t before = (std::uint64_t{1} << (cell % 64)) - 1;
    return brick.first + static_cast<std::uint32_t>(std::popcount(brick.cells & before));
  };
  const SurfaceCells::List empty{{nothing, nothing, nothing, nothing}};
  grid.lists.assign(set, empty);
  std::vector<std::uint8_t> counts(set, 0);  // in the last list of the chain
  std::vector<std::uint32_t> last(set);
  std::iota(last.begin(), last.end(), 0u);
  for (const Entry& e : entries) {
    const std::uint32_t n = number(e.cell);
    if (counts[n] == 4) {
      const auto more = static_cast<std::uint32_t>(grid.lists.size());
      std::uint32_t& end = grid.lists[last[n]].packets[3];
      const std::uint32_t moved = std::exchange(end, SurfaceCells::kMore + more);
      grid.lists.push_back(empty);
      grid.lists.back().packets[0] = moved;
      last[n] = more;
      counts[n] = 1;
    }
    grid.lists[last[n]].packets[counts[n]++] = e.packet;
  }
}

float area_of(const Packets& packets) {
  double area = 0;
  for (const Packet& packet : packets.packets) {
    for (std::size_t i = 0; i < kPacket; ++i) {
      if (i > 0 && packet.triangle[i] == packet.triangle[i - 1]) break;
      glm::vec3 corner[3];
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) corner[k][axis] = packet.corner[k][axis][i];
      area += 0.5 * double{glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]))};
    }
  }
  return static_cast<float>(area);
}

}  // namespace

SurfaceCells make_surface_cells(const Packets& packets, const glm::vec3& half) {
  const auto triangles = packets.packets.size() * kPacket;
  const float longest = 2 * std::max({half.x, half.y, half.z});
  const float ideal = std::sqrt(kTrianglesPerCell * area_of(packets) / static_cast<float>(triangles));
  for (float cell = std::clamp(ideal, longest / kMostCells, longest / kLeastCells); cell <= longest;
       cell *= 2) {
    SurfaceCells grid = make_grid(half, cell);
    const std::vector<Entry> entries = list_entries(packets, grid, kMostEntries * triangles + 4096);
    if (entries.empty()) continue;
    fill(grid, entries, packets.nothing());
    return grid;
  }
  return {};
}

}  // namespace meander
