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
