// A rough interface of two dielectrics: a random walk on a GGX microsurface, from which everything that
// arrives leaves again, on one side or the other. Local frame: z is the outward normal; all directions are
// unit directions of travel. incoming.z < 0 arrives from outside, outgoing.z > 0 leaves to the outside.
#pragma once

#include "math/random.h"
#include "math/types.h"

namespace meander {

/// Heights and slopes of the microsurface follow Smith's assumptions, its facets are smooth (math/fresnel.h).
struct RoughDielectric {
  Real alpha;  ///< GGX width, in [kLeastGgxAlpha, 1]: ggx_alpha(roughness)
  Real eta;    ///< index inside over index outside, > 0
};

/// How light leaves the interface. There is no weight: it is 1 for every sample.
struct InterfaceSample {
  Vec3 direction;
  Real density;  ///< per steradian, of leaving so from the last facet it met; only for weights, see below
  bool transmitted;
  int collisions;  ///< facets met on the way, at least 1; 0 if eta is 1
};

/// Follows light that arrives along `incoming` from facet to facet until it leaves (Heitz, Hanika, d'Eon,
/// Dachsbacher 2016, "Multiple-Scattering Microfacet BSDFs with the Smith Model", dielectric). Each facet
/// reflects with probability F and else refracts, so that nothing is lost, whatever the roughness. At
/// eta = 1 light goes straight on.
[[nodiscard]] InterfaceSample sample_rough_dielectric(const RoughDielectric& surface, const Vec3& incoming,
                                                      Random& random) noexcept;

/// An unbiased estimate, per steradian, of the density f with which sample_rough_dielectric leaves along
/// `outgoing`: of the power that arrives, the fraction that leaves there, the cosine included. Over both
/// sides f integrates to 1, and n_i^2 |cos_i| f(i, o) = n_o^2 |cos_o| f(-o, -i), n being the index on the
/// side of the direction. For a path followed from the camera the same f carries radiance over n^2.
/// Without bound when facets are narrow: for lights that no sampled direction can hit (points, suns). 0 if
/// |eta - 1| < 1e-3, when what is transmitted is too narrow a lobe for float and only sampling sees it.
[[nodiscard]] Real eval_rough_dielectric(const RoughDielectric& surface, const Vec3& incoming,
                                         const Vec3& outgoing, Random& random) noexcept;

/// The weight of the light along `outgoing`, which was sampled with `outgoing_density` p > 0 per steradian,
/// when the same light is also found by sample_rough_dielectric (multiple importance sampling, Veach & Guibas
/// 1995, balance heuristic). f has no closed form, but each walk over the facets has: from its last facet
/// light leaves along o with the known density q, so that walk and o are weighed together:
///   o sampled on the light:      add  this function  (a sum of (q / p) (p / (p + q)), one term a facet);
///   o sampled on the interface:  add  1 / (1 + p / q)  with q = InterfaceSample::density and p the density
///                                with which the light's sampling would have taken o (0 where it never does).
/// Unbiased together, for every light; no sample weighs more than the number of facets it met. q is infinite
/// where this function is 0 because |eta - 1| < 1e-3.
[[nodiscard]] Real weigh_rough_dielectric(const RoughDielectric& surface, const Vec3& incoming,
                                          const Vec3& outgoing, Real outgoing_density,
                                          Random& random) noexcept;

}  // namespace meander
