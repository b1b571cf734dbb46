// One walk in an exact shape after another, counted: by the scalar code, or in whichever order others walk
// them.
#pragma once

#include <algorithm>

#include "math/fresnel.h"
#include "stability/exact/exact_cases.h"
#include "stats/moments.h"
#include "walk/analytic_worlds.h"
#include "walk/interface.h"
#include "walk/random_walk.h"

namespace meander {

/// By kExactQuantities; what a case does not count has no samples.
using ExactResults = std::array<Moments, kExactQuantities.size()>;

[[nodiscard]] inline Medium medium_of(const ExactCase& of) {
  return {Rgb(of.sigma_t), Rgb(static_cast<Real>(of.albedo)), static_cast<Real>(of.g)};
}

/// The walks of a case, of streams of its own.
class ExactWalk {
 public:
  ExactWalk(const ExactCase& of, ExactResults& results) : case_(of), results_(results) {}

  /// Sets up walk `number`: walker() and its random numbers.
  [[nodiscard]] Random begin(std::uint64_t seed, std::uint32_t number) {
    Random random = stream(seed, 0, number);
    walker_ = Walker{};
    found_ = {};
    if (case_.shape == ExactShape::sphere) walker_.position.z = 1;
    if (case_.kind == ExactKind::thin) random = with_early_flight(random);
    if (case_.kind == ExactKind::chromatic)
      walker_.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
    enter(random);
    return random;
  }
  [[nodiscard]] Walker& walker() { return walker_; }

  /// What the end of a walk means: true when it goes on inside.
  [[nodiscard]] bool goes_on(const WalkResult& walk, Random& random) {
    return walk.end == WalkEnd::exited && stays(walk.crossing, random);
  }

  /// What others have flown and left behind for it.
  void tally(double path, double absorbed) {
    found_.path += path;
    found_.absorbed += absorbed;
  }

  void record() {
    if (case_.kind == ExactKind::whole) return record_whole();
    if (case_.kind == ExactKind::capped) {
      count("left", found_.out > 0);
      count("depth", found_.out > 0 ? 0 : depth() * case_.sigma_t.x);
      return;
    }
    if (case_.kind == ExactKind::thin) {
      count("scattered", walker_.weight.order > 0 ? share_ : 0);
      count("scattered_back", walker_.weight.order > 0 && found_.back > 0 ? share_ : 0);
      return;
    }
    count("escaped_r", found_.channels.x);
    count("escaped_g", found_.channels.y);
    count("escaped_b", found_.channels.z);
    if (case_.shape == ExactShape::slab) count("transmittance_b", found_.transmitted_blue);
  }

  // What a scalar walk reports as it goes.
  void segment(const Walker& walker, Real distance) {
    found_.path += static_cast<double>(walker.weight.carried().x) * static_cast<double>(distance);
  }
  void absorbed(const Rgb& amount) { found_.absorbed += static_cast<double>(amount.x); }
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return case_.kind == ExactKind::capped; }

 private:
  struct Found {
    double out = 0, back = 0, absorbed = 0, path = 0, transmitted_blue = 0;
    DVec3 channels{0};
  };

  void count(std::string_view quantity, double value) {
    const auto* const place = std::ranges::find(kExactQuantities, quantity);
    results_[static_cast<std::size_t>(place - kExactQuantities.begin())].add(value);
  }

  void record_whole() {
    if (case_.albedo == 1 || case_.shape == ExactShape::sphere) count("escaped", found_.out);
    if (case_.shape != ExactShape::sphere) count("reflectance", found_.back);
    if (case_.shape == ExactShape::slab) count("transmittance", found_.out - found_.back);
    if (case_.albedo < 1) count("absorbed", found_.absorbed);
    count("path", found_.path);
  }

  [[nodiscard]] double depth() const {
    const DVec3 p(walker_.position);
    return case_.shape == ExactShape::sphere ? 1 - glm::length(p) : -p.z;
  }

  // Draws the first word of a walk from the part of its range in which the flight may end inside the body:
  // twice the optical thickness. The other words all pass.
  [[nodiscard]] Random with_early_flight(const Random& random) {
    const double tau = case_.sigma_t.x * (case_.shape == ExactShape::sphere ? 2 : 1);
    const double words = std::ceil(2 * tau * 0x1p32);
    share_ = words * 0x1p-32 / tau;
    auto state = random.state();
    Random source = random;
    const auto word = static_cast<std::uint32_t>(source.next_bits() * 0x1p-32 * words);
    const std::uint32_t sum = word - state[0];
    state[3] = ((sum >> 7) | (sum << 25)) - state[0];
    return Random(state);
  }

  void enter(Random& random) {
    const bool normal = case_.kind == ExactKind::thin;
    const Real cosine = normal ? Real(1) : std::sqrt(1 - random.next());
    const Fresnel fresnel =
        case_.ior == 1 ? Fresnel{0, cosine} : eval_fresnel(cosine, static_cast<Real>(case_.ior));
    walker_.weight.throughput = Rgb(1 - fresnel.reflectance);
    found_.out = found_.back = static_cast<double>(fresnel.reflectance);
    if (case_.boundary == Boundary::diffuse)
      send_inward({0, 0, 1}, random);
    else
      walker_.direction = {std::sqrt((1 - fresnel.cos_t) * (1 + fresnel.cos_t)), 0, -fresnel.cos_t};
  }

  void send_inward(const Vec3& normal, Random& random) {
    const Real u1 = random.next();
    const Real u2 = random.next();
    walker_.direction = renormalise(make_frame(-normal).to_world(sample_cosine_hemisphere({u1, u2})));
  }

  [[nodiscard]] bool stays(const Crossing& exit, Random& random) {
    const Vec3& n = exit.normal;
    const bool diffuse = case_.boundary == Boundary::diffuse;
    const Real cosine =
        diffuse ? std::sqrt(1 - random.next()) : std::min(glm::dot(walker_.direction, n), Real(1));
    const Fresnel fresnel =
        case_.ior == 1 ? Fresnel{0, cosine} : eval_fresnel(cosine, static_cast<Real>(1 / case_.ior));
    let_out(exit, 1 - fresnel.reflectance);
    walker_.weight.throughput *= fresnel.reflectance;
    if (fresnel.reflectance == 0 || !walker_.weight.survives_roulette(random, kRouletteThreshold))
      return false;
    if (diffuse)
      send_inward(n, random);
    else
      walker_.direction = lift_off(renormalise(walker_.direction - 2 * cosine * n), -n);
    return true;
  }

  void let_out(const Crossing& exit, Real fraction) {
    const Rgb carried = walker_.weight.carried() * fraction;
    const double weight = static_cast<double>(carried.x);
    found_.out += weight;
    if (exit.normal.z > 0) found_.back += weight;
    if (case_.kind != ExactKind::chromatic) return;
    found_.channels = DVec3(carried * walker_.weight.free_path_weight());
    if (exit.normal.z < 0) found_.transmitted_blue = found_.channels.z;
  }

  const ExactCase& case_;
  ExactResults& results_;
  Walker walker_;
  Found found_;
  double share_ = 0;  // of the words that are drawn, over the optical thickness
};

/// Calls f with the World of a case's shape.
template <class F>
auto with_world(const ExactCase& of, const F& f) {
  if (of.shape == ExactShape::slab) return f(SlabWorld{1});
  if (of.shape == ExactShape::sphere) return f(SphereWorld{1});
  return f(HalfSpaceWorld{});
}

/// Walks a case by the scalar code.
[[nodiscard]] inline ExactResults walk_scalar(const ExactCase& of, std::uint64_t walks, std::uint64_t seed) {
  ExactResults results;
  ExactWalk walk(of, results);
  const WalkModel model{medium_of(of), Estimator::implicit};
  with_world(of, [&](const auto& world) {
    for (std::uint32_t i = 0; i < walks; ++i) {
      Random random = walk.begin(seed, i);
      while (walk.goes_on(random_walk(world, model, walk.walker(), random, walk), random)) {
      }
      walk.record();
    }
  });
  return results;
}

}  // namespace meander
