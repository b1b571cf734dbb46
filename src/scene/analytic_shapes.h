// Exact convex shapes under a linear map: the sphere, the box and the unbounded slab. Each answers where a
// line is inside it; no tessellation and no epsilon. Parallel and grazing lines are ordinary cases.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "math/types.h"
#include "scene/crossing.h"

namespace meander {

/// The part near <= t <= far of a line o + t d that is inside a shape, with the outward gradients at its ends
/// (not normalised).
template <class T>
struct Interval {
  T near;
  T far;
  glm::vec<3, T> near_gradient;
  glm::vec<3, T> far_gradient;
};

/// Where a line leaves a shape, for a point inside: the distance, and the outward gradient there (not
/// normalised). A point that rounding put just outside has left already: the distance is then 0 or less.
struct Exit {
  Real far;
  Vec3 gradient;
};

/// Unit sphere at the origin.
struct UnitSphere {
  /// Roots by the product rule, so that neither loses digits to cancellation; the discriminant from the
  /// closest point (Haines, Günther, Akenine-Möller 2019, "Precision Improvements for Ray/Sphere
  /// Intersection").
  template <class T>
  [[nodiscard]] static std::optional<Interval<T>> inside(const glm::vec<3, T>& o,
                                                         const glm::vec<3, T>& d) noexcept {
    const T inverse = 1 / glm::dot(d, d);
    const T middle = -glm::dot(o, d) * inverse;
    const glm::vec<3, T> closest = o + middle * d;
    const T discriminant = 1 - glm::dot(closest, closest);
    if (!(discriminant >= 0)) return std::nullopt;
    const T half = std::sqrt(discriminant * inverse);
    const T product = (glm::dot(o, o) - 1) * inverse;
    const T outer = middle + std::copysign(half, middle);
    const T inner = outer != 0 ? product / outer : -outer;
    const T near = std::min(outer, inner);
    const T far = std::max(outer, inner);
    return Interval<T>{near, far, o + near * d, o + far * d};
  }
  /// A line so near the rim that rounding makes it miss goes from a point of the surface along the chord, if
  /// it goes in.
  [[nodiscard]] static Exit exit(const Vec3& o, const Vec3& d) noexcept {
    if (const auto interval = inside(o, d)) return {interval->far, interval->far_gradient};
    const Real chord = std::max(-2 * glm::dot(o, d) / glm::dot(d, d), Real(0));
    return {chord, o + chord * d};
  }
  [[nodiscard]] static Vec3 snap(const Vec3& p, const Vec3&) noexcept { return glm::normalize(p); }
};

namespace detail {

/// Clips an interval to |o_axis + t d_axis| <= 1.
template <class T>
[[nodiscard]] inline bool clip_to_slab(Interval<T>& interval, const glm::vec<3, T>& o,
                                       const glm::vec<3, T>& d, int axis) noexcept {
  glm::vec<3, T> gradient(0);
  if (d[axis] == 0) return std::abs(o[axis]) <= 1;
  const T sign = std::copysign(T(1), d[axis]);
  gradient[axis] = sign;
  const T near = (-sign - o[axis]) / d[axis];
  const T far = (sign - o[axis]) / d[axis];
  if (near > interval.near) {
    interval.near = near;
    interval.near_gradient = -gradient;
  }
  if (far < interval.far) {
    interval.far = far;
    interval.far_gradient = gradient;
  }
  return interval.near <= interval.far;
}

/// Puts a point onto the face of a box or slab that a gradient (a signed axis) names.
[[nodiscard]] inline Vec3 snap_to_face(const Vec3& p, const Vec3& gradient) noexcept {
  return p + gradient * (1 - glm::dot(p, gradient));
}

template <class T>
[[nodiscard]] inline Interval<T> whole_line() noexcept {
  constexpr T kInfinity = std::numeric_limits<T>::infinity();
  return {-kInfinity, kInfinity, {0, 0, 1}, {0, 0, 1}};
}

}  // namespace detail

/// [-1, 1]^3.
struct UnitBox {
  template <class T>
  [[nodiscard]] static std::optional<Interval<T>> inside(const glm::vec<3, T>& o,
                                                         const glm::vec<3, T>& d) noexcept {
    Interval<T> interval = detail::whole_line<T>();
    for (int axis = 0; axis < 3; ++axis)
      if (!detail::clip_to_slab(interval, o, d, axis)) return std::nullopt;
    return interval;
  }
  /// The first face ahead, whichever faces the line has yet to come in by: from a point that is outside of
  /// two of them by rounding the line may miss the box, and leaves by a face that it travels toward all the
  /// same.
  [[nodiscard]] static Exit exit(const Vec3& o, const Vec3& d) noexcept {
    Interval<Real> interval = detail::whole_line<Real>();
    for (int axis = 0; axis < 3; ++axis) (void)detail::clip_to_slab(interval, o, d, axis);
    return {interval.far, interval.far_gradient};
  }
  [[nodiscard]] static Vec3 snap(const Vec3& p, const Vec3& gradient) noexcept {
    return detail::snap_to_face(p, gradient);
  }
};

/// |y| <= 1, unbounded in x and z.
struct UnitSlab {
  template <class T>
  [[nodiscard]] static std::optional<Interval<T>> inside(const glm::vec<3, T>& o,
                                                         const glm::vec<3, T>& d) noexcept {
    Interval<T> interval = detail::whole_line<T>();
    if (!detail::clip_to_slab(interval, o, d, 1)) return std::nullopt;
    return interval;
  }
  [[nodiscard]] static Exit exit(const Vec3& o, const Vec3& d) noexcept {
    Interval<Real> interval = detail::whole_line<Real>();
    (void)detail::clip_to_slab(interval, o, d, 1);
    return {interval.far, interval.far_gradient};
  }
  [[nodiscard]] static Vec3 snap(const Vec3& p, const Vec3& gradient) noexcept {
    return detail::snap_to_face(p, gradient);
  }
};

/// A unit shape under the linear map `from_unit`, in the body's own coordinates (its centre at the origin).
template <class Unit>
struct AffineShape {
  Mat3 from_unit;
  Mat3 to_unit;
  Mat3 gradient_map;  // transpose of to_unit: takes gradients back
  DMat3 precise_to_unit;

  explicit AffineShape(const DMat3& map)
      : from_unit(map),
        to_unit(glm::inverse(map)),
        gradient_map(glm::transpose(glm::inverse(map))),
        precise_to_unit(glm::inverse(map)) {}

  /// A point that is on the surface but for rounding, put onto it.
  [[nodiscard]] Vec3 snap(const Vec3& p, const Vec3& gradient) const noexcept {
    return from_unit * Unit::snap(to_unit * p, gradient);
  }

  [[nodiscard]] Vec3 normal_from(const Vec3& gradient) const noexcept {
    return glm::normalize(gradient_map * gradient);
  }

  /// Where a line with unit direction is inside, distances in body units; gradients are the unit shape's. In
  /// Real, or in double for rays from far away.
  template <class T>
  [[nodiscard]] std::optional<Interval<T>> inside(const glm::vec<3, T>& o,
                                                  const glm::vec<3, T>& d) const noexcept {
    const glm::mat<3, 3, T>& map = to_unit_in(T());
    return Unit::template inside<T>(map * o, map * d);
  }

  /// The step of length `distance` (>= 0, may be infinite) from a point inside along a unit direction. A
  /// point that rounding put just outside leaves at once; nothing leaks.
  [[nodiscard]] Crossing first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
    const Exit exit = Unit::exit(to_unit * p, to_unit * d);
    const Real far = std::max(exit.far, Real(0));
    if (distance < far) return {CrossingKind::none, distance, p + distance * d, {}, {}};
    if (far == std::numeric_limits<Real>::infinity()) return {CrossingKind::leaked, far, p, {}, {}};
    const Vec3 normal = normal_from(exit.gradient);
    return {CrossingKind::exit, far, snap(p + far * d, exit.gradient), normal, normal};
  }

 private:
  template <class T>
  [[nodiscard]] const glm::mat<3, 3, T>& to_unit_in(T) const noexcept {
    if constexpr (std::is_same_v<T, Real>)
      return to_unit;
    else
      return precise_to_unit;
  }
};

using SphereBody = AffineShape<UnitSphere>;
using BoxBody = AffineShape<UnitBox>;
using SlabBody = AffineShape<UnitSlab>;

}  // namespace meander
