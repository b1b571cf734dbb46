// What light that meets a rough dielectric is held against in tests: the textbook's single facet, in double,
// and cells in which its lobes are resolved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/fresnel.h"
#include "math/ggx.h"
#include "math/random.h"
#include "math/rough_dielectric.h"
#include "math/warp.h"
#include "stats/distributions.h"
#include "support/quadrature.h"

namespace meander {

inline constexpr double kDoublePi = glm::pi<double>();

// ---- Light that meets a single facet, in double and in the textbook's form: `away` points back along the
// light, `out` along what leaves, z is up on the light's side and `eta` the index ahead over that behind.

inline double lambda(double alpha, const DVec3& w) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
}

inline double ggx(double alpha, const DVec3& m) {
  const double cos2 = m.z * m.z;
  const double tan2 = (m.x * m.x + m.y * m.y) / cos2;
  return 1 / (kDoublePi * alpha * alpha * cos2 * cos2 * std::pow(1 + tan2 / (alpha * alpha), 2));
}

inline double visible(double alpha, const DVec3& away, const DVec3& m) {
  return std::max(glm::dot(away, m), 0.0) * ggx(alpha, m) / ((1 + lambda(alpha, away)) * away.z);
}

inline double reflectance(double cos_i, double eta) {
  return eval_fresnel(static_cast<Real>(std::min(cos_i, 1.0)), static_cast<Real>(eta)).reflectance;
}

// The half vector of Walter et al. 2007, z up; what the facet must look like to send `away` to `out`.
inline DVec3 half_vector(double eta, const DVec3& away, const DVec3& out) {
  const DVec3 sum = glm::normalize(out.z > 0 ? away + out : away + eta * out);
  return sum.z < 0 ? -sum : sum;
}

// Density of leaving the first facet along `out`, whether or not another facet is in the way.
inline double first_facet_density(double alpha, double eta, const DVec3& away, const DVec3& out) {
  const DVec3 m = half_vector(eta, away, out);
  const double cos_i = glm::dot(away, m);
  const double cos_o = glm::dot(out, m);
  if (cos_i <= 0 || cos_o * out.z <= 0) return 0;
  const double f = reflectance(cos_i, eta);
  if (out.z > 0) return f * visible(alpha, away, m) / (4 * cos_i);
  return (1 - f) * visible(alpha, away, m) * eta * eta * -cos_o / std::pow(cos_i + eta * cos_o, 2);
}

// The chance that no other facet is in the way: heights correlated (Heitz 2014, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs", eq. 99, and for the other side the beta function).
inline double unshadowed(double alpha, const DVec3& away, const DVec3& out) {
  const double in = 1 + lambda(alpha, away);
  const double on = lambda(alpha, out);
  return out.z > 0 ? in / (in + on)
                   : in * std::exp(std::lgamma(in) + std::lgamma(1 + on) - std::lgamma(in + 1 + on));
}

// Reflected and transmitted fractions after one facet, by quadrature over the facets.
inline std::array<double, 2> single_facet_fractions(double alpha, double eta, const DVec3& away) {
  std::array<double, 2> result{};
  for (const bool through : {false, true}) {
    const auto integrand = [&](double angle, double azimuth) {
      const double slope = alpha * std::tan(angle);
      const double cosine = 1 / std::sqrt(1 + slope * slope);
      const double sine = slope * cosine;
      const DVec3 m(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
      const double cos_i = glm::dot(away, m);
      if (cos_i <= 0) return 0.0;
      const double f = reflectance(cos_i, eta);
      if (through && f == 1) return 0.0;
      const double cos_t = std::sqrt(std::max(0.0, eta * eta - 1 + cos_i * cos_i)) / eta;
      const DVec3 out = through ? (cos_i * m - away) / eta - cos_t * m : 2 * cos_i * m - away;
      if (through ? out.z >= 0 : out.z <= 0) return 0.0;
      return (through ? 1 - f : f) * visible(alpha, away, m) * unshadowed(alpha, away, out) * sine * alpha /
             std::pow(std::cos(angle), 2) * cosine * cosine;
    };
    result[through] = 2 * integrate_rectangle(integrand, {0, 0}, {0.5 * kDoublePi, kDoublePi}, 30);
  }
  return result;
}

// ---- The interface as seen by light from one side.

struct Arrival {
  RoughDielectric surface;
  Vec3 incoming;
  double side;  // +1 from outside, -1 from inside
  double eta;   // ahead over behind

  Arrival(const RoughDielectric& r, const Vec3& direction)
      : surface(r), incoming(direction), side(direction.z < 0 ? 1 : -1) {
    eta = side > 0 ? r.eta : 1 / double{r.eta};
  }
  [[nodiscard]] DVec3 away() const { return {-incoming.x, -incoming.y, -incoming.z * side}; }
  [[nodiscard]] DVec3 local(const Vec3& v) const { return {v.x, v.y, v.z * side}; }
};

// Directions to estimate eval's integral with, and their density: half by the first facet, half by the cosine
// of either side. `usable` is false where the first facet sends light into the surface.
struct Proposal {
  Vec3 direction;
  double density;
  bool usable;
};

inline double proposal_density(const Arrival& at, const Vec3& direction) {
  const DVec3 out = at.local(direction);
  return 0.5 * first_facet_density(at.surface.alpha, at.eta, at.away(), out) +
         0.5 * std::abs(out.z) / (2 * kDoublePi);
}

inline Proposal propose(const Arrival& at, Random& random) {
  const bool cosine = random.next() < Real(0.5);
  const Real first = random.next();
  const Vec2 u(first, random.next());
  const Real choice = random.next();
  DVec3 out;
  if (cosine) {
    out = sample_cosine_hemisphere(u);
    if (choice < Real(0.5)) out.z = -out.z;
  } else {
    const DVec3 m = sample_visible_normal(at.surface.alpha, Vec3(at.away()), u);
    const double cos_i = glm::dot(at.away(), m);
    const bool reflected = choice < reflectance(cos_i, at.eta);
    const double cos_t = std::sqrt(std::max(0.0, at.eta * at.eta - 1 + cos_i * cos_i)) / at.eta;
    out = reflected ? 2 * cos_i * m - at.away() : (cos_i * m - at.away()) / at.eta - cos_t * m;
    if (reflected == (out.z <= 0)) return {{}, 1, false};
  }
  const Vec3 direction(out.x, out.y, out.z * at.side);
  return {direction, proposal_density(at, direction), true};
}

// Cells by side and by the slope of the half vector in units of alpha: they resolve every lobe.
inline constexpr int kCells = 2 * 13 * 13;
inline int cell_of(const Arrival& at, const Vec3& outgoing) {
  const DVec3 out = at.local(outgoing);
  const DVec3 m = half_vector(at.eta, at.away(), out);
  const auto index = [&](double slope) {
    return std::clamp(static_cast<int>(13 * (0.5 + std::atan(slope / at.surface.alpha) / kDoublePi)), 0, 12);
  };
  return (out.z > 0 ? 0 : 169) + 13 * index(m.x / m.z) + index(m.y / m.z);
}

struct Cells {
  std::vector<double> sum = std::vector<double>(kCells);
  std::vector<double> square = std::vector<double>(kCells);

  void add(int cell, double value) {
    sum[cell] += value;
    square[cell] += value * value;
  }
};

// p-value of the hypothesis that both have the same mean in every cell. Cells with too little for a normal
// law join one pool.
inline double same_cells_p(const Cells& a, const Cells& b) {
  double statistic = 0, pool_difference = 0, pool_variance = 0;
  int degrees = 0;
  for (int cell = 0; cell < kCells; ++cell) {
    const double difference = a.sum[cell] - b.sum[cell];
    const double variance = a.square[cell] + b.square[cell];
    if (a.sum[cell] + b.sum[cell] < 50) {
      pool_difference += difference;
      pool_variance += variance;
    } else {
      statistic += difference * difference / variance;
      ++degrees;
    }
  }
  if (pool_variance > 0) {
    statistic += pool_difference * pool_difference / pool_variance;
    ++degrees;
  }
  return chi_square_survival(statistic, degrees);
}

}  // namespace meander
