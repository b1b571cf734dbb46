// Unpolarised Fresnel reflection at a smooth interface of two dielectrics.
#pragma once

#include <cmath>

#include "math/types.h"

namespace meander {

/// The reflected fraction and the cosine of the refracted ray; cos_t is 0 under total internal reflection.
struct Fresnel {
  Real reflectance;
  Real cos_t;
};

/// cos_i in [0, 1] is the incident cosine, eta = n_t / n_i > 0 the index ahead over the index behind.
/// Reflectance is (r_par^2 + r_perp^2) / 2 (Born & Wolf 1999, section 1.5.2).
[[nodiscard]] inline Fresnel eval_fresnel(Real cos_i, Real eta) noexcept {
  // By Snell's law, without passing through sin^2, which rounds to 1 at grazing angles.
  const Real eta2_cos2_t = (eta - 1) * (eta + 1) + cos_i * cos_i;
  if (eta2_cos2_t <= 0) return {1, 0};
  const Real cos_t = std::sqrt(eta2_cos2_t) / eta;
  const Real parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const Real perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return {Real(0.5) * (parallel * parallel + perpendicular * perpendicular), cos_t};
}

}  // namespace meander
