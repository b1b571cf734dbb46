// Warps of the unit square to directions, each with its density and its inverse. Local frame: z up.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/types.h"

namespace meander {

/// (cos, sin) of the azimuth 2 pi u.
[[nodiscard]] inline Vec2 sample_azimuth(Real u) noexcept {
  const Real phi = 2 * kPi * u;
  return {std::cos(phi), std::sin(phi)};
}

/// The turn in [0, 1) at which (x, y) lies; what rounds to a whole turn is 0.
[[nodiscard]] inline Real invert_azimuth(Real x, Real y) noexcept {
  const Real turn = std::atan2(y, x) / (2 * kPi);
  const Real positive = turn < 0 ? turn + 1 : turn;
  return positive < 1 ? positive : Real(0);
}

/// Cosine-distributed on the upper hemisphere. u.x in [0, 1) sets the height (cos theta = sqrt(1 - u.x),
/// never 0), u.y the azimuth.
[[nodiscard]] inline Vec3 sample_cosine_hemisphere(const Vec2& u) noexcept {
  const Real sin_theta = std::sqrt(u.x);
  const Vec2 azimuth = sample_azimuth(u.y);
  return {sin_theta * azimuth.x, sin_theta * azimuth.y, std::sqrt(1 - u.x)};
}
/// Per steradian.
[[nodiscard]] inline Real pdf_cosine_hemisphere(Real cos_theta) noexcept {
  return std::max(cos_theta, Real(0)) / kPi;
}
[[nodiscard]] inline Vec2 invert_cosine_hemisphere(const Vec3& d) noexcept {
  return {d.x * d.x + d.y * d.y, invert_azimuth(d.x, d.y)};
}

/// Uniform on the sphere: z = 2 u.x - 1.
[[nodiscard]] inline Vec3 sample_sphere(const Vec2& u) noexcept {
  const Real sin_theta = 2 * std::sqrt(u.x * (1 - u.x));
  const Vec2 azimuth = sample_azimuth(u.y);
  return {sin_theta * azimuth.x, sin_theta * azimuth.y, 2 * u.x - 1};
}
/// Per steradian.
[[nodiscard]] inline Real pdf_sphere() noexcept { return 1 / (4 * kPi); }
[[nodiscard]] inline Vec2 invert_sphere(const Vec3& d) noexcept {
  return {Real(0.5) * (d.z + 1), invert_azimuth(d.x, d.y)};
}

/// Uniform on the cone about +z whose half-angle has 1 - cosine `one_minus_cos` (in (0, 2]); exact for narrow
/// cones too, where the cosine itself would round to 1.
[[nodiscard]] inline Vec3 sample_cone(Real one_minus_cos, const Vec2& u) noexcept {
  const Real depth = u.x * one_minus_cos;  // 1 - cos theta
  const Real sin_theta = std::sqrt(depth * (2 - depth));
  const Vec2 azimuth = sample_azimuth(u.y);
  return {sin_theta * azimuth.x, sin_theta * azimuth.y, 1 - depth};
}
/// Per steradian.
[[nodiscard]] inline Real pdf_cone(Real one_minus_cos) noexcept { return 1 / (2 * kPi * one_minus_cos); }
[[nodiscard]] inline Vec2 invert_cone(Real one_minus_cos, const Vec3& d) noexcept {
  const Real sin2 = d.x * d.x + d.y * d.y;
  const Real depth = d.z > 0 ? sin2 / (1 + d.z) : 1 - d.z;
  return {depth / one_minus_cos, invert_azimuth(d.x, d.y)};
}

}  // namespace meander
