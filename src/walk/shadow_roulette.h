// Which of a walk's shadow rays are traced. At most collisions a light is worth little: the walk carries
// little there, lies deep in the medium, or faces the wrong way. Once a step needs no ray, shadow rays are
// what a walk costs.
#pragma once

#include <algorithm>

#include "walk/path_weight.h"

namespace meander {

/// The worth from which on every shadow ray is traced, see ShadowRoulette. Measured as 1 / (variance x time)
/// on a knot across its own mean free path (2 to 30 collisions a walk, g 0.3 and 0.8, albedo 0.5 to 0.99): 2
/// is never less efficient than to trace every ray by over 1 %, and up to 4 times more; 4 may lose 20 %.
inline constexpr Real kShadowThreshold = 2;

/// Systematic sampling (Madow 1949): a ray of worth w is traced with probability p = min(1, w / threshold),
/// and counts 1 / p then; of rays whose p sum up to n, n or the next integer are traced. The sum starts at u,
/// uniform in [0, 1), so that each ray's expectation stands, whatever the worths are made from but u.
class ShadowRoulette {
 public:
  ShadowRoulette() noexcept = default;
  explicit ShadowRoulette(Real u) noexcept : sum_(u) {}

  /// What the next ray counts, 0 where it is not traced. `worth` >= 0.
  [[nodiscard]] Real draw(Real worth) noexcept {
    const Real p = std::min(worth / kShadowThreshold, Real(1));
    sum_ += double{p};
    if (sum_ < 1) return 0;
    sum_ -= 1;
    return 1 / p;
  }

 private:
  double sum_ = 0;  // of single precision it would lose what is below 2^-25
};

/// The largest channel of what a path may bring to a light from a collision, over what one without any
/// history does, if the surface is at least `clearance` (scene units, 0 where nothing is known) away: carried
/// weight, free-path weight, transmittance.
[[nodiscard]] inline Real most_carried(const PathWeight& weight, const Rgb& sigma_t,
                                       Real clearance) noexcept {
  Rgb passed = weight.ratio;
  if (clearance > 0)
    for (int c = 0; c < 3; ++c) passed[c] *= transmittance(sigma_t[c], clearance);
  return largest(weight.carried() * passed) / average(weight.ratio);
}

}  // namespace meander
