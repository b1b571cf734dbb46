// Balls that hold no part of a closed surface: a step whose two ends lie in one of them crosses nothing,
// because a ball is convex. One ball a cell of a grid.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace meander {

/// Centre and squared radius; negative where there is no ball.
struct EmptyBall {
  glm::vec3 center{0};
  float radius2 = -1;

  [[nodiscard]] bool holds(const glm::vec3& p) const noexcept {
    const glm::vec3 d = p - center;
    return glm::dot(d, d) <= radius2;
  }
};

/// `cells` holds the number of each cell's ball, x fastest. Points outside the grid have the nearest cell's
/// ball, which is as good as any: a ball promises something about what is in it, wherever it is found.
struct EmptyBalls {
  glm::vec3 low{0};
  float cells_per_unit = 1;
  glm::ivec3 size{1};
  std::vector<std::uint32_t> cells{0};
  std::vector<EmptyBall> balls{EmptyBall{}};

  [[nodiscard]] const EmptyBall& at(const glm::vec3& p) const noexcept {
    const glm::vec3 place = (p - low) * cells_per_unit;
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(place)), glm::ivec3(0), size - 1);
    return balls[cells[static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x)]];
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return cells.size() * sizeof(std::uint32_t) + balls.size() * sizeof(EmptyBall);
  }
};

}  // namespace meander
