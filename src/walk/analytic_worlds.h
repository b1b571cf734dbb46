// Exact worlds in units of the mean free path or any other: the slab, the half-space and the sphere, for
// `measure` and for the tests. The surface that light enters through is at z = 0, the medium below it.
#pragma once

#include <cmath>

#include "scene/analytic_shapes.h"
#include "walk/world.h"

namespace meander {

/// -thickness <= z <= 0. An exit's normal tells the face: (0, 0, 1) is the one light entered through.
struct SlabWorld {
  Real thickness;

  [[nodiscard]] Crossing first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
    const Real face = d.z > 0 ? Real(0) : -thickness;
    const Real far = d.z != 0 ? std::max((face - p.z) / d.z, Real(0)) : std::numeric_limits<Real>::infinity();
    if (distance < far) return {CrossingKind::none, distance, p + distance * d, {}, {}};
    if (std::isinf(far)) return {CrossingKind::leaked, far, p, {}, {}};
    const Vec3 normal(0, 0, d.z > 0 ? 1 : -1);
    return {CrossingKind::exit, far, {p.x + far * d.x, p.y + far * d.y, face}, normal, normal};
  }
};

/// z <= 0.
struct HalfSpaceWorld {
  [[nodiscard]] Crossing first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
    const Real far = d.z > 0 ? std::max(-p.z / d.z, Real(0)) : std::numeric_limits<Real>::infinity();
    if (distance < far) return {CrossingKind::none, distance, p + distance * d, {}, {}};
    if (std::isinf(far)) return {CrossingKind::leaked, far, p, {}, {}};
    return {CrossingKind::exit, far, {p.x + far * d.x, p.y + far * d.y, 0}, {0, 0, 1}, {0, 0, 1}};
  }
};

/// Sphere of the given radius at the origin.
struct SphereWorld {
  Real radius;

  [[nodiscard]] Crossing first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
    // |p + t d|^2 = r^2 by the product rule; c <= 0 inside, and rounding above 0 means the walk is at the
    // surface.
    const Real b = glm::dot(p, d);
    const Real c = glm::dot(p, p) - radius * radius;
    const Real root = std::sqrt(std::max(b * b - c, Real(0)));
    const Real far = std::max(b > 0 ? -c / (b + root) : root - b, Real(0));
    if (distance < far) return {CrossingKind::none, distance, p + distance * d, {}, {}};
    const Vec3 normal = glm::normalize(p + far * d);
    return {CrossingKind::exit, far, radius * normal, normal, normal};
  }
};

static_assert(World<SlabWorld> && World<HalfSpaceWorld> && World<SphereWorld> && World<SphereBody>);

}  // namespace meander
