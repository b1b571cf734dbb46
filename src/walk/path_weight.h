// What a path carries. The albedos and the free-path densities are kept apart, so that an image can be
// re-weighted for another albedo and so that no free-path weight ever exceeds 3.
#pragma once

#include <cstdint>

#include "math/free_path.h"
#include "math/random.h"
#include "medium/medium.h"

namespace meander {

/// One channel (the hero) samples every distance of a path; the one-sample balance heuristic over the
/// channels (Wilkie, Nawaz, Droske, Weidlich, Hanika 2014, eq. 6) weighs channel c by p_c / mean_j(p_j), p
/// the product of the whole path's free-path densities. Only proportions of p are kept: products underflow.
struct PathWeight {
  Rgb throughput{1};        // everything but albedos and free paths: surface reflectance, roulette
  Rgb albedo{1};            // product of the single-scattering albedos, alpha^n
  Rgb ratio{1};             // p_c up to the last vertex, scaled so that the largest is 1
  Rgb since{1};             // transmittance from the last vertex to here, per channel
  int hero = 0;             // channel that samples the distances
  std::uint32_t order = 0;  // number of scatterings in media
  double length = 0;        // path length inside media, scene units

  [[nodiscard]] Rgb carried() const noexcept { return throughput * albedo; }

  /// The free-path weight p_c / mean(p) of a contribution made here.
  [[nodiscard]] Rgb free_path_weight() const noexcept {
    const Rgb p = ratio * since;
    return p / average(p);
  }

  /// Flies a distance through a medium without colliding.
  void pass(const Medium& medium, Real distance) noexcept {
    length += double{distance};
    for (int c = 0; c < 3; ++c) since[c] *= transmittance(medium.sigma_t[c], distance);
  }

  /// Flies a distance and collides there: a new vertex.
  void collide(const Medium& medium, Real distance) noexcept {
    length += double{distance};
    if (is_grey(medium.sigma_t)) {
      vertex();
      return;
    }
    for (int c = 0; c < 3; ++c) since[c] *= pdf_free_path(medium.sigma_t[c], distance);
    vertex();
  }

  /// Folds what was flown since the last vertex into the densities. A grey stretch leaves them alone.
  void vertex() noexcept {
    if (!is_grey(since)) {
      ratio *= since;
      ratio /= largest(ratio);
    }
    since = Rgb(1);
  }

  /// Russian roulette on what is carried: false when the path ends. A weight that falls below `threshold` is
  /// lifted back to it with the matching probability, so the expectation stands.
  [[nodiscard]] bool survives_roulette(Random& random, Real threshold) noexcept {
    const Real weight = largest(carried());
    if (weight >= threshold) return true;
    const Real survival = weight / threshold;
    if (!(random.next() < survival)) return false;
    throughput /= survival;
    return true;
  }
};

}  // namespace meander
