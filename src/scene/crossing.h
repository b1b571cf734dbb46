// Where rays and walks meet surfaces: the words that geometry and walks share.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/types.h"

namespace meander {

enum class CrossingKind : std::uint8_t {
  none,    // the step stays inside; `point` is where it ends
  exit,    // the step crosses the surface; `point` lies on it
  leaked,  // the walk is outside without having crossed: the surface has a hole. `distance` leads out of the
           // bounds
};

/// From a point inside a body along a unit direction.
struct Step {
  Vec3 from{0};
  Vec3 direction{0, 0, 1};
  Real distance = 0;
};

/// Steps in rows, in single precision; as much room as there may be.
struct alignas(64) Steps {
  static constexpr std::size_t kMost = 128;
  using Row = float[kMost + 16];  // a vector may be stored at the last one
  Row from[3];
  Row direction[3];
  Row distance;
};

/// The outcome of one step in the body's own coordinates. `normal` (geometric) and `shading_normal` are unit,
/// outward, and set only at an exit.
struct Crossing {
  CrossingKind kind = CrossingKind::none;
  Real distance = 0;
  Vec3 point{0};
  Vec3 normal{0, 0, 1};
  Vec3 shading_normal{0, 0, 1};
};

/// Where a ray in the world meets an object. `point` is in the object's own coordinates; normals are unit and
/// outward.
struct SurfaceHit {
  std::size_t object = 0;
  double distance = 0;
  Vec3 point{0};
  Vec3 normal{0, 0, 1};
  Vec3 shading_normal{0, 0, 1};
  bool entering = true;  // the ray comes from outside
};

}  // namespace meander
