// The number, vector and colour types of every room. Nothing here knows what they stand for.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

namespace meander {

#ifdef MEANDER_REAL_DOUBLE
using Real = double;  // a correctness tool: the statistical tests run in double as well
#else
using Real = float;
#endif

using Vec2 = glm::vec<2, Real>;
using Vec3 = glm::vec<3, Real>;
using Mat3 = glm::mat<3, 3, Real>;
using Rgb = glm::vec<3, Real>;  // linear Rec. 709
using DVec3 = glm::dvec3;
using DMat3 = glm::dmat3;

inline constexpr Real kPi = glm::pi<Real>();

[[nodiscard]] constexpr Real average(const Rgb& c) noexcept { return (c.x + c.y + c.z) * (Real(1) / 3); }
[[nodiscard]] constexpr Real largest(const Rgb& c) noexcept {
  return c.x > c.y ? (c.x > c.z ? c.x : c.z) : (c.y > c.z ? c.y : c.z);
}
[[nodiscard]] constexpr bool is_grey(const Rgb& c) noexcept { return c.x == c.y && c.y == c.z; }

}  // namespace meander
