#include "scene/mesh.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

namespace meander {

namespace {

// For each position the first one equal to it. By sorting, not hashing: no choice of positions makes it slow.
std::vector<std::uint32_t> find_first_equals(const std::vector<DVec3>& positions) {
  struct Entry {
    DVec3 position;
    std::uint32_t index;
  };
  std::vector<Entry> entries(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    entries[i] = {positions[i], static_cast<std::uint32_t>(i)};
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.position.x, a.position.y, a.position.z, a.index) <
           std::tie(b.position.x, b.position.y, b.position.z, b.index);
  });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool repeats = i > 0 && entries[i].position == entries[i - 1].position;
    first[entries[i].index] = repeats ? first[entries[i - 1].index] : entries[i].index;
  }
  return first;
}

// Points the corners at the first of equal positions; returns how many positions had an earlier equal.
std::size_t weld(Mesh& mesh) {
  const std::vector<std::uint32_t> first = find_first_equals(mesh.positions);
  std::size_t welded = 0;
  for (std::size_t i = 0; i < first.size(); ++i) welded += first[i] != i;
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = first[corner];
  }
  return welded;
}

std::size_t drop_degenerate(Mesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle triangle = mesh.triangles[t];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    if (!mesh.normals.empty()) mesh.normal_triangles[kept] = mesh.normal_triangles[t];
    mesh.triangles[kept++] = triangle;
  }
  const std::size_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  if (!mesh.normals.empty()) mesh.normal_triangles.resize(kept);
  return dropped;
}

// Keeps the values that a corner names, in the order of first use.
template <typename T>
void keep_used(std::vector<T>& values, std::vector<Triangle>& triangles) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> renamed(values.size(), kUnused);
  std::vector<T> used;
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& corner : triangle) {
      if (renamed[corner] == kUnused) {
        renamed[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(values[corner]);
      }
      corner = renamed[corner];
    }
  }
  values = std::move(used);
}

void turn(std::vector<Triangle>& triangles) {
  for (Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
}

// The vector area of a triangle, doubled.
DVec3 cross_of(const Mesh& mesh, const Triangle& triangle) {
  const DVec3& a = mesh.positions[triangle[0]];
  return glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
}

// Some exporters wind triangles one way and point normals the other; the winding decides.
void align_normals(Mesh& mesh) {
  double agreement = 0;
  for (std::size_t t = 0; t < mesh.normal_triangles.size(); ++t) {
    DVec3 sum{0.0};
    for (const std::uint32_t corner : mesh.normal_triangles[t]) sum += DVec3(mesh.normals[corner]);
    agreement += glm::dot(sum, cross_of(mesh, mesh.triangles[t]));
  }
  if (agreement >= 0) return;
  for (glm::vec3& normal : mesh.normals) normal = -normal;
}

}  // namespace

MeshReport mend(Mesh& mesh) {
  assert(mesh.normals.empty() == mesh.normal_triangles.empty());
  assert(mesh.normals.empty() || mesh.normal_triangles.size() == mesh.triangles.size());
  MeshReport report;
  report.welded_positions = weld(mesh);
  report.dropped_triangles = drop_degenerate(mesh);
  keep_used(mesh.positions, mesh.triangles);
  keep_used(mesh.normals, mesh.normal_triangles);
  report.open_edges = count_open_edges(mesh);
  report.flipped = report.open_edges == 0 && signed_volume(mesh) < 0;
  if (report.flipped) {
    turn(mesh.triangles);
    turn(mesh.normal_triangles);
  }
  align_normals(mesh);
  return report;
}

std::size_t count_open_edges(const Mesh& mesh) {
  assert(mesh.positions.size() <= (std::size_t{1} << 31));
  // One key a directed edge: the lower position, the higher one, and in the last bit the direction.
  std::vector<std::uint64_t> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const Triangle& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t from = triangle[k];
      const std::uint64_t to = triangle[(k + 1) % 3];
      edges.push_back(std::min(from, to) << 32 | std::max(from, to) << 1 | std::uint64_t{from > to});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    std::int64_t balance = 0;
    for (; end < edges.size() && edges[end] >> 1 == edges[begin] >> 1; ++end)
      balance += edges[end] & 1 ? -1 : 1;
    open += balance != 0;
  }
  return open;
}

double signed_volume(const Mesh& mesh) {
  const Bounds bounds = bounds_of(mesh);
  const DVec3 centre = bounds.low + 0.5 * (bounds.high - bounds.low);
  double six_volumes = 0;
  for (const Triangle& triangle : mesh.triangles) {
    six_volumes += glm::dot(mesh.positions[triangle[0]] - centre, cross_of(mesh, triangle));
  }
  return six_volumes / 6;
}

double surface_area(const Mesh& mesh) {
  double doubled = 0;
  for (const Triangle& triangle : mesh.triangles) doubled += glm::length(cross_of(mesh, triangle));
  return doubled / 2;
}

Bounds bounds_of(const Mesh& mesh) {
  if (mesh.positions.empty()) return {};
  Bounds bounds{mesh.positions.front(), mesh.positions.front()};
  for (const DVec3& position : mesh.positions) {
    bounds.low = glm::min(bounds.low, position);
    bounds.high = glm::max(bounds.high, position);
  }
  return bounds;
}

}  // namespace meander
