// Where a step of a walk crosses nothing.
#pragma once

#include <cmath>
#include <limits>

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

  /// A lower bound of the distance from a point of the body to what is not in the region; 0 where none is
  /// known.
  [[nodiscard]] Real clearance(const Vec3& p) const noexcept;
};

inline Real SafeRegion::clearance(const Vec3& p) const noexcept {
  if (kind == Kind::balls) {
    const EmptyBall& ball = balls->at(glm::vec3(p));
    return ball.holds(glm::vec3(p)) ? std::sqrt(ball.radius2) - glm::distance(ball.center, glm::vec3(p)) : 0;
  }
  // The rows of the map are at right angles: the longest is the most that it stretches by.
  Real clear = std::numeric_limits<Real>::infinity();
  Real square = 0;
  Real longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 row(map[i][0], map[i][1], map[i][2]);
    const Real local = glm::dot(row, p);
    const Real stretch = glm::length(row);
    square += local * local;
    longest = std::max(longest, stretch);
    clear = std::min({clear, (local - low[i]) / stretch, (high[i] - local) / stretch});
  }
  if (kind == Kind::ellipsoid) clear = (1 - std::sqrt(square)) / longest;
  return std::max(clear, Real(0));
}

}  // namespace meander
