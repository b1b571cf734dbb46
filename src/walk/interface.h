// The smooth interface between two dielectrics, met by a ray from either side.
#pragma once

#include "math/frame.h"
#include "math/fresnel.h"

namespace meander {

/// Where a ray goes at an interface, and which fraction of its power is reflected. Under total internal
/// reflection the fraction is 1 and `refracted` means nothing.
struct InterfaceRay {
  Real reflectance;
  Vec3 reflected;
  Vec3 refracted;
};

/// The cosine that a ray reflected inside a curved body sets out with at least. Rounding moves the cosine of
/// light that total reflection leads along a surface by 1e-7 a bounce; at 0 it would stand still for ever.
inline constexpr Real kLeastCosine = Real(0x1p-12);

/// `d`, or where it sets out flatter than that to the side of the unit normal `n`, `d` lifted to it.
[[nodiscard]] inline Vec3 lift_off(const Vec3& d, const Vec3& n) noexcept {
  const Real cosine = glm::dot(d, n);
  return cosine >= kLeastCosine ? d : renormalise(d + (kLeastCosine - cosine) * n);
}

/// `d` travels against the unit normal `n` (d . n < 0); eta is the index ahead over the index behind (Snell's
/// law).
[[nodiscard]] inline InterfaceRay meet_interface(const Vec3& d, const Vec3& n, Real eta) noexcept {
  const Real cos_i = std::min(-glm::dot(d, n), Real(1));
  const Fresnel fresnel = eval_fresnel(cos_i, eta);
  const Vec3 along = d + cos_i * n;  // the tangential part
  return {fresnel.reflectance, renormalise(along + cos_i * n), renormalise(along / eta - fresnel.cos_t * n)};
}

/// The same with a shading normal, which bends the rays where it can: where it would send one to the wrong
/// side of the surface, the geometric normal stands in.
[[nodiscard]] inline InterfaceRay meet_interface(const Vec3& d, const Vec3& n, const Vec3& shading,
                                                 Real eta) noexcept {
  if (glm::dot(d, shading) < 0) {
    const InterfaceRay ray = meet_interface(d, shading, eta);
    const bool reflects_well = glm::dot(ray.reflected, n) > 0;
    const bool refracts_well = ray.reflectance == 1 || glm::dot(ray.refracted, n) < 0;
    if (reflects_well && refracts_well) return ray;
  }
  return meet_interface(d, n, eta);
}

}  // namespace meander
