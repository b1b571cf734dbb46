// Where a line meets a triangle, from the weights that it was found with.
#pragma once

#include <algorithm>
#include <array>

#include "math/types.h"

namespace meander {

/// A place on a triangle, whose second and third corners weigh u and v there.
struct TrianglePlace {
  glm::vec3 point;
  float u;
  float v;
};

/// The place of the weights u and v, each in [0, 1]; `near` is the place as the line has it, on the plane but
/// for rounding. Weights are off by about the rounding of a corner over the width of the triangle: along a
/// needle that is a long way, and there the place is moved along the longer sides to beside `near`, which
/// leaves it on the triangle. `normal` is as long as twice the triangle's area.
[[nodiscard]] inline TrianglePlace place_on(const std::array<glm::vec3, 3>& corners, float u, float v,
                                            const glm::vec3& near, const glm::vec3& normal) noexcept {
  constexpr float kSlender = 32;  // longest side over width
  std::array<float, 3> weights{1 - u - v, u, v};
  const auto point = [&] {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
  };
  const std::array<glm::vec3, 3> sides{corners[1] - corners[0], corners[2] - corners[1],
                                       corners[0] - corners[2]};
  const std::array<float, 3> squares{glm::dot(sides[0], sides[0]), glm::dot(sides[1], sides[1]),
                                     glm::dot(sides[2], sides[2])};
  const float longest = std::max({squares[0], squares[1], squares[2]});
  if (!(longest * longest > kSlender * kSlender * glm::dot(normal, normal))) return {point(), u, v};
  for (std::size_t from = 0; from < 3; ++from) {
    if (4 * squares[from] < longest) continue;
    const std::size_t to = (from + 1) % 3;
    const float part = glm::dot(near - point(), sides[from]) / squares[from];
    const float moved = std::clamp(part, -std::max(weights[to], 0.0f), std::max(weights[from], 0.0f));
    weights[from] -= moved;
    weights[to] += moved;
  }
  return {point(), weights[1], weights[2]};
}

}  // namespace meander
