// Where a step of a walk crosses nothing.
#pragma once

#include "scene/empty_balls.h"

namespace meander {

/// A convex part of space in which a step crosses nothing when both its ends are there: what is inside of a
/// convex body, or the balls of any body. Convex: low <= map * p <= high, or |map * p| <= 1 for an ellipsoid.
struct SafeRegion {
  enum class Kind { box, ellipsoid, balls } kind = Kind::box;
  float map[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // rows
  float low[3] = {-1, -1, -1};
  float high[3] = {1, 1, 1};
  const EmptyBalls* balls = nullptr;
};

}  // namespace meander
