// Balls that hold no part of a closed surface: a step whose two ends lie in one of them crosses nothing,
// because a ball is convex. One ball a cell of a grid.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace meander {

/// Centre and squared radius; negative where there is no ball. The radius' last two bits tell what else the
/// ball promises, see EmptyBalls.
struct EmptyBall {
  enum Promise : std::uint32_t { plain, facing, followed };

  glm::vec3 center{0};
  float radius2 = -1;

  EmptyBall() = default;
  /// Of a radius of `radius` (> 0), or less by at most four units in the last place.
  EmptyBall(const glm::vec3& middle, float radius, Promise promise) noexcept : center(middle) {
    radius2 = std::bit_cast<float>(((std::bit_cast<std::uint32_t>(radius * radius) - 4) & ~3u) | promise);
  }
  [[nodiscard]] Promise promise() const noexcept {
    return radius2 > 0 ? static_cast<Promise>(std::bit_cast<std::uint32_t>(radius2) & 3) : plain;
  }
  [[nodiscard]] bool holds(const glm::vec3& p) const noexcept {
    const glm::vec3 d = p - center;
    return glm::dot(d, d) <= radius2;
  }
};

/// `cells` holds the number of each cell's ball, x fastest. Points outside the grid have the nearest cell's
/// ball, which is as good as any: a ball promises something about what is in it, wherever it is found. A
/// facing ball promises more: that no step into it from a point of its cell (which is inside of the body)
/// leaves the body, whether the ball holds that point or not. A followed one has the cell's facing ball, a
/// smaller one, behind it in the list.
struct EmptyBalls {
  glm::vec3 low{0};
  float cells_per_unit = 1;
  glm::ivec3 size{1};
  std::vector<std::uint32_t> cells{0};
  std::vector<EmptyBall> balls{EmptyBall{}};

  /// The place of a point's cell in `cells`.
  [[nodiscard]] std::size_t cell_at(const glm::vec3& p) const noexcept {
    const glm::vec3 place = (p - low) * cells_per_unit;
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(place)), glm::ivec3(0), size - 1);
    return static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x);
  }
  [[nodiscard]] const EmptyBall& at(const glm::vec3& p) const noexcept { return balls[cells[cell_at(p)]]; }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return cells.size() * sizeof(std::uint32_t) + balls.size() * sizeof(EmptyBall);
  }
};

}  // namespace meander
