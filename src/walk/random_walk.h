// The scalar random walk in a homogeneous medium: sample a distance, ask whether the step crosses the
// surface, scatter, weigh. Short, and kept as the oracle for every faster one. No cap on the number of
// scatterings.
#pragma once

#include <cmath>

#include "math/frame.h"
#include "math/henyey_greenstein.h"
#include "math/warp.h"
#include "walk/path_weight.h"
#include "walk/world.h"

namespace meander {

/// analog: absorbed with probability 1 - albedo at each collision. implicit: the weight takes the albedo, and
/// roulette ends light that matters no more.
enum class Estimator { analog, implicit };

struct WalkModel {
  Medium medium;
  Estimator estimator = Estimator::implicit;
};

/// Below this weight an implicit walk plays roulette. Measured as 1 / (variance x time) of the escaping
/// weight, on half-spaces of albedo 0.5 to 0.999, a sphere and a slab: 0.3 is within 11 % of the best
/// threshold in every case, 0.1 within 29 %, 1 (which is analog) within 78 %.
inline constexpr Real kRouletteThreshold = Real(0.3);

/// Steps between two questions whether to stop.
inline constexpr std::uint64_t kStopInterval = 1024;

/// A walk under way, in the body's own coordinates. `last` is the deflection that made the direction.
struct Walker {
  Vec3 position{0};
  Vec3 direction{0, 0, 1};
  PathWeight weight;
  Deflection last{1, 0, 2, 0};
  std::uint64_t steps = 0;
};

enum class WalkEnd { exited, absorbed, leaked, interrupted };

struct WalkResult {
  WalkEnd end = WalkEnd::absorbed;
  Crossing crossing;  // where it left; meaningful for `exited` and `leaked`
};

/// What a walk tells as it goes; every call may be empty.
/// segment: about to fly `distance` inside. absorbed: this much of the weight stays in the medium here.
/// scattered: a collision's weight has been applied and the old direction still stands. stop: asked every
/// kStopInterval steps.
template <class E>
concept WalkEvents = requires(E& events, const Walker& walker, Real distance, const Rgb& amount) {
  events.segment(walker, distance);
  events.absorbed(amount);
  events.scattered(walker);
  { events.stop() } -> std::same_as<bool>;
};

/// A new direction from the phase function about the old one.
inline void scatter_direction(Walker& walker, Real g, Random& random) noexcept {
  const Real u1 = random.next();
  const Real u2 = random.next();
  if (g == 0) {
    walker.direction = sample_sphere({u1, u2});
    return;
  }
  walker.last = sample_henyey_greenstein(g, u1);
  const Vec2 azimuth = sample_azimuth(u2);
  const Vec3 local(walker.last.sin_theta * azimuth.x, walker.last.sin_theta * azimuth.y, walker.last.mu);
  walker.direction = renormalise(make_frame(walker.direction).to_world(local));
}

/// Density per steradian of the direction that the last scattering chose.
[[nodiscard]] inline Real pdf_last_direction(const Walker& walker, Real g) noexcept {
  if (g == 0) return pdf_sphere();
  return pdf_henyey_greenstein_cosine(g, walker.last.one_minus_mu, walker.last.one_plus_mu) / (2 * kPi);
}

/// Takes the albedo of one collision; false when the walk ends here.
template <WalkEvents E>
[[nodiscard]] bool survives_collision(const WalkModel& model, Walker& walker, Random& random,
                                      E& events) noexcept {
  PathWeight& weight = walker.weight;
  const Rgb& albedo = model.medium.albedo;
  if (model.estimator == Estimator::analog) {
    const Real survival = largest(albedo);
    if (!(random.next() < survival)) {
      events.absorbed(weight.carried());
      return false;
    }
    weight.albedo *= albedo / survival;
    return true;
  }
  events.absorbed(weight.carried() * (Rgb(1) - albedo));
  weight.albedo *= albedo;
  return weight.survives_roulette(random, kRouletteThreshold);
}

/// Walks from walker.position (inside) along walker.direction until the walk leaves the body, is absorbed,
/// leaks through a hole or is interrupted. Distances follow the hero channel; weights follow PathWeight.
template <World W, WalkEvents E>
[[nodiscard]] WalkResult random_walk(const W& world, const WalkModel& model, Walker& walker, Random& random,
                                     E& events) noexcept {
  const Medium& medium = model.medium;
  const Real sigma = medium.sigma_t[walker.weight.hero];
  for (;;) {
    if (++walker.steps % kStopInterval == 0 && events.stop()) return {WalkEnd::interrupted, {}};
    const Real distance = sample_free_path(sigma, random.next_fine());
    const Crossing crossing = world.first_crossing(walker.position, walker.direction, distance);
    if (crossing.kind == CrossingKind::leaked) {
      walker.weight.pass(medium, crossing.distance);
      return {WalkEnd::leaked, crossing};
    }
    events.segment(walker, crossing.distance);
    walker.position = crossing.point;
    if (crossing.kind == CrossingKind::exit) {
      walker.weight.pass(medium, crossing.distance);
      return {WalkEnd::exited, crossing};
    }
    walker.weight.collide(medium, crossing.distance);
    if (!survives_collision(model, walker, random, events)) return {WalkEnd::absorbed, crossing};
    ++walker.weight.order;
    events.scattered(walker);
    scatter_direction(walker, medium.g, random);
  }
}

}  // namespace meander
