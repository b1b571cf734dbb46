#include "math/rough_dielectric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/frame.h"
#include "math/fresnel.h"
#include "math/ggx.h"

namespace meander {
namespace {

// Under Smith's assumptions a microsurface is a medium: with C the fraction of the surface that lies below a
// height, depth = -ln C, a ray meets facets at the rate (their area projected on it) / |cos| per unit of
// depth, whatever the distribution of heights, and leaves at depth 0. Seen from the other side C is 1 - C and
// z is -z.
struct MicrosurfaceRay {
  Vec3 direction;  // z up on the side the ray is on
  Real depth;
  bool outside;
};

// What is left of C or 1 - C at least, so that both logarithms are finite.
constexpr Real kLeastDepth = Real(1e-26);
// A ray along the mean surface would meet facets without end.
constexpr Real kLeastCosine = Real(1e-6);
constexpr Real kLeastBend = Real(1e-3);

Vec3 mirrored(const Vec3& v) { return {v.x, v.y, -v.z}; }

Real depth_from_other_side(Real depth) {
  const Real other = depth < Real(0.7) ? -std::log(-std::expm1(-depth)) : -std::log1p(-std::exp(-depth));
  return std::max(other, kLeastDepth);
}

// Facets met per unit of depth by a ray that leaves along `direction` (of either side): Smith's Lambda.
Real leaving_rate(Real alpha, const Vec3& direction) {
  const Real up = std::abs(direction.z);
  return ggx_projected_area(alpha, {direction.x, direction.y, -up}) / up;
}

// The index ahead of a ray that refracts, over the index behind.
Real index_ratio(const RoughDielectric& surface, bool outside) {
  return outside ? surface.eta : 1 / surface.eta;
}

MicrosurfaceRay enter(const Vec3& incoming) {
  const Real down = std::max(std::abs(incoming.z), kLeastCosine);
  return {{incoming.x, incoming.y, -down}, 0, incoming.z <= 0};
}

// To the next facet; false when the ray leaves instead.
bool fly(MicrosurfaceRay& ray, Real alpha, Random& random) {
  const Real z = ray.direction.z;
  const Real step = -std::log(1 - random.next()) * std::abs(z) / ggx_projected_area(alpha, -ray.direction);
  ray.depth += z > 0 ? -step : step;
  if (!(z <= 0) && !(ray.depth > 0)) return false;  // NaN leaves too
  ray.depth = std::max(ray.depth, kLeastDepth);
  return true;
}

// Reflects or refracts the ray at a facet it sees.
void scatter(MicrosurfaceRay& ray, const RoughDielectric& surface, Random& random) {
  const Real first = random.next();
  const Vec3 m = sample_visible_normal(surface.alpha, -ray.direction, {first, random.next()});
  const Real eta = index_ratio(surface, ray.outside);
  const Real cos_i = std::clamp(-glm::dot(ray.direction, m), Real(0), Real(1));
  const Fresnel f = eval_fresnel(cos_i, eta);
  if (random.next() < f.reflectance) {
    ray.direction = renormalise(ray.direction + 2 * cos_i * m);
    return;
  }
  ray.direction = mirrored(renormalise((ray.direction + cos_i * m) / eta - f.cos_t * m));
  ray.depth = depth_from_other_side(ray.depth);
  ray.outside = !ray.outside;
}

// Density per steradian of leaving a facet along `to`, z > 0, on the ray's side: from the density of the half
// vector, dm = do / (4 i.m).
Real reflection_density(Real alpha, Real eta, const Vec3& from, const Vec3& to) {
  const Vec3 sum = to - from;
  if (sum.z <= 0) return 0;
  const Real length = glm::length(sum);
  const Real reflectance = eval_fresnel(std::min(Real(0.5) * length, Real(1)), eta).reflectance;
  return reflectance * eval_ggx(alpha, sum / length) / (4 * ggx_projected_area(alpha, -from));
}

// The same on the other side, z < 0: dm = eta^2 |o.m| / |i + eta o|^2 do (Walter et al. 2007, eq. 17).
Real transmission_density(Real alpha, Real eta, const Vec3& from, const Vec3& to) {
  Vec3 sum = eta * to - from;
  if (sum.z < 0) sum = -sum;
  const Real length2 = glm::dot(sum, sum);
  const Vec3 m = sum / std::sqrt(length2);
  const Real cos_i = -glm::dot(from, m);
  const Real cos_o = -glm::dot(to, m);
  if (!(cos_i > 0 && cos_o > 0)) return 0;
  const Real transmittance = 1 - eval_fresnel(std::min(cos_i, Real(1)), eta).reflectance;
  return transmittance * pdf_visible_normal(alpha, -from, m) * eta * eta * cos_o / length2;
}

// Density per steradian of going straight from this facet to outside of the surface along `outgoing`, in the
// frame of the interface; `rate` is leaving_rate of it.
Real leaving_density(const MicrosurfaceRay& ray, const RoughDielectric& surface, const Vec3& outgoing,
                     Real rate) {
  const Vec3 to = ray.outside ? outgoing : mirrored(outgoing);
  const Real eta = index_ratio(surface, ray.outside);
  const bool reflected = to.z > 0;
  const Real density = reflected ? reflection_density(surface.alpha, eta, ray.direction, to)
                                 : transmission_density(surface.alpha, eta, ray.direction, to);
  if (!(density > 0)) return 0;
  return density * std::exp(-rate * (reflected ? ray.depth : depth_from_other_side(ray.depth)));
}

bool too_narrow(const RoughDielectric& surface) { return std::abs(surface.eta - 1) < kLeastBend; }

// The sum over a walk's facets of share(density of leaving there along `outgoing`).
template <class Share>
Real sum_over_facets(const RoughDielectric& surface, const Vec3& incoming, const Vec3& outgoing,
                     Random& random, const Share& share) {
  if (too_narrow(surface)) return 0;
  const Real rate = leaving_rate(surface.alpha, outgoing);
  MicrosurfaceRay ray = enter(incoming);
  Real sum = 0;
  while (fly(ray, surface.alpha, random)) {
    sum += share(leaving_density(ray, surface, outgoing, rate));
    scatter(ray, surface, random);
  }
  return sum;
}

}  // namespace

InterfaceSample sample_rough_dielectric(const RoughDielectric& surface, const Vec3& incoming,
                                        Random& random) noexcept {
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
  if (surface.eta == 1) return {incoming, kInfinity, true, 0};  // no bound on the facets a grazing ray meets
  MicrosurfaceRay ray = enter(incoming);
  MicrosurfaceRay last = ray;  // as it came to the facet it left from
  int collisions = 0;
  for (; fly(ray, surface.alpha, random); ++collisions) {
    last = ray;
    scatter(ray, surface, random);
  }
  const Vec3 outgoing = ray.outside ? ray.direction : mirrored(ray.direction);
  const bool transmitted = ray.outside != (incoming.z <= 0);
  if (too_narrow(surface)) return {outgoing, kInfinity, transmitted, collisions};
  const Real density = leaving_density(last, surface, outgoing, leaving_rate(surface.alpha, outgoing));
  return {outgoing, std::max(density, std::numeric_limits<Real>::min()), transmitted, collisions};
}

Real eval_rough_dielectric(const RoughDielectric& surface, const Vec3& incoming, const Vec3& outgoing,
                           Random& random) noexcept {
  return sum_over_facets(surface, incoming, outgoing, random, [](Real density) { return density; });
}

Real weigh_rough_dielectric(const RoughDielectric& surface, const Vec3& incoming, const Vec3& outgoing,
                            Real outgoing_density, Random& random) noexcept {
  return sum_over_facets(surface, incoming, outgoing, random,
                         [=](Real density) { return density / (outgoing_density + density); });
}

}  // namespace meander
