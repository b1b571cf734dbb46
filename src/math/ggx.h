// The isotropic GGX distribution of microfacet normals and its Smith masking. Local frame: z is the normal of
// the mean surface, on the side from which the facets are seen; every facet normal has z > 0.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/types.h"
#include "math/warp.h"

namespace meander {

/// The least width that keeps its digits in float: narrower lobes come near the spacing of directions.
inline constexpr Real kLeastGgxAlpha = Real(1e-4);

/// alpha = roughness^2 for an artist's roughness in (0, 1] (Burley 2012, "Physically Based Shading at
/// Disney", section 5.4; OpenPBR does the same), at least kLeastGgxAlpha. Roughness 0 is a smooth surface:
/// not this.
[[nodiscard]] inline Real ggx_alpha(Real roughness) noexcept {
  return std::max(roughness * roughness, kLeastGgxAlpha);
}

/// Area of facets with normal m, per steradian and per area of the mean surface (Walter, Marschner, Li,
/// Torrance 2007, eq. 33); m.z > 0. Integrates to 1 when weighted with m.z.
[[nodiscard]] inline Real eval_ggx(Real alpha, const Vec3& m) noexcept {
  const Real a2 = alpha * alpha;
  const Real q = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
  return a2 / (kPi * q * q);
}

/// Area of the facets that face `v`, projected onto it, per area of the mean surface: the integral of
/// max(v.m, 0) D(m). `v` is any unit vector, below the horizon too; (1 + Lambda) cos in Smith's terms (Heitz,
/// Hanika, d'Eon, Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs with the Smith Model", section 3).
[[nodiscard]] inline Real ggx_projected_area(Real alpha, const Vec3& v) noexcept {
  const Real tilt = alpha * alpha * (v.x * v.x + v.y * v.y);
  const Real root = std::sqrt(v.z * v.z + tilt);
  return Real(0.5) * (v.z >= 0 ? v.z + root : tilt / (root - v.z));
}

/// Density per steradian of the facets' normals as seen from `v`: max(v.m, 0) D(m) / projected area.
[[nodiscard]] inline Real pdf_visible_normal(Real alpha, const Vec3& v, const Vec3& m) noexcept {
  if (m.z <= 0) return 0;
  return std::max(glm::dot(v, m), Real(0)) * eval_ggx(alpha, m) / ggx_projected_area(alpha, v);
}

/// The view stretched to where GGX is a hemisphere, with 1 + z and 1 - z to full relative precision.
struct StretchedView {
  Vec3 v;
  Real one_plus_z;
  Real one_minus_z;
};

[[nodiscard]] inline StretchedView stretch_view(Real alpha, const Vec3& view) noexcept {
  const Vec3 v = glm::normalize(Vec3(alpha * view.x, alpha * view.y, view.z));
  const Real sin2 = v.x * v.x + v.y * v.y;
  return {v, v.z >= 0 ? 1 + v.z : sin2 / (1 - v.z), v.z >= 0 ? sin2 / (1 + v.z) : 1 - v.z};
}

/// A facet normal as seen from the unit vector `view`, which may lie below the horizon but not at the nadir.
/// The distribution is that of Heitz 2018, "Sampling the GGX Distribution of Visible Normals"; it is drawn as
/// the half vector of the stretched view and a direction uniform on the cap z > -v.z (Dupuy & Benyoub 2023,
/// "Sampling Visible GGX Normals with Spherical Caps"), whose every term here is a sum of positive ones.
[[nodiscard]] inline Vec3 sample_visible_normal(Real alpha, const Vec3& view, const Vec2& u) noexcept {
  const StretchedView s = stretch_view(alpha, view);
  const Real height = (1 - u.x) * s.one_plus_z;  // of the unnormalised half vector
  const Real sine = std::sqrt(u.x * s.one_plus_z * (height + s.one_minus_z));
  const Vec2 azimuth = sample_azimuth(u.y);
  return glm::normalize(Vec3(alpha * (sine * azimuth.x + s.v.x), alpha * (sine * azimuth.y + s.v.y), height));
}

/// The numbers that give m.
[[nodiscard]] inline Vec2 invert_visible_normal(Real alpha, const Vec3& view, const Vec3& m) noexcept {
  const StretchedView s = stretch_view(alpha, view);
  const Vec3 half = glm::normalize(Vec3(m.x, m.y, alpha * m.z));
  const Vec3 on_cap = 2 * glm::dot(s.v, half) * half - s.v;
  return {(1 - on_cap.z) / s.one_plus_z, invert_azimuth(on_cap.x, on_cap.y)};
}

}  // namespace meander
