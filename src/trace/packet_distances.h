// How near the triangles of packets are, and which way they face.
#pragma once

#include "trace/packets.h"

namespace meander {

/// The point of the triangles nearest to another one; `triangle` is kNoTriangle where none is nearer than the
/// limit. `looked` is how many packets the search has looked into.
struct NearestPoint {
  static constexpr std::uint32_t kNoTriangle = 0xffffffff;

  glm::vec3 point{0};
  float distance = 0;
  std::uint32_t triangle = kNoTriangle;
  std::uint32_t looked = 0;
};

/// Of the points nearer to p than `limit` (may be infinite) the nearest, its distance exact to within 2^-21.
/// Everything of size about 1.
[[nodiscard]] NearestPoint find_nearest(const Packets& packets, const glm::vec3& p, float limit) noexcept;

struct Ball {
  glm::vec3 center;
  float radius;
};

/// Of the planes of the triangles that may reach into the convex hull of two balls: the least depth of the
/// second ball's centre beneath one, by which it is inside of all of them. -infinity where a plane is not
/// known; no more than `enough`; nothing exact when it is not positive.
[[nodiscard]] float find_depth(const Packets& packets, const Ball& from, const Ball& to,
                               float enough) noexcept;

}  // namespace meander
