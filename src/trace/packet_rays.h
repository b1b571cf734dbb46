// What SIMD asks of packets: the first way out along a ray.
#pragma once

#include "trace/surface_cells.h"

namespace meander {

/// From `origin` along a unit direction, all of size about 1.
struct GridRay {
  glm::vec3 origin;
  glm::vec3 direction;
  float distance;
};

/// `distance` along the ray to the first triangle that it leaves by; `point` is there, where the triangle's
/// second and third corners weigh u and v; `normal` has that triangle's direction outward, and any length.
/// `unknown`: there is no grid, the ray starts beyond it, or leaves by a triangle seen edge-on.
struct GridExit {
  enum class Kind { unknown, none, exit } kind;
  float distance;
  float u;
  float v;
  glm::vec3 point;
  glm::vec3 normal;
  std::uint32_t triangle;
};

/// Watertight as Embree's robust test is: a ray that passes an edge meets one of the two triangles there,
/// whose edge functions are the same numbers with the sign turned. The same bits on every instruction set.
[[nodiscard]] GridExit find_exit(const Packets& packets, const SurfaceCells& cells,
                                 const GridRay& ray) noexcept;

}  // namespace meander
