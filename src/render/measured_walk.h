// A walk that `measure` counts.
#pragma once

#include "math/fresnel.h"
#include "render/measure.h"
#include "walk/analytic_worlds.h"
#include "walk/interface.h"
#include "walk/rough_interface.h"

namespace meander {

/// In units of the mean free path.
[[nodiscard]] inline Medium measured_medium(const MeasureJob& job) noexcept {
  return {Rgb(1), Rgb(static_cast<Real>(job.albedo)), static_cast<Real>(job.g)};
}

/// One walk from the surface at z = `top` and what it leaves where; the first channel counts, all three are
/// alike.
class MeasuredWalk {
 public:
  MeasuredWalk(const MeasureJob& job, Real top, Measurement& result, const std::atomic<bool>& stop)
      : job_(job), top_(top), result_(result), stop_(stop) {}

  [[nodiscard]] const Walker& walker() const noexcept { return walker_; }

  /// Lets the light in through the surface; false when all of it was mirrored.
  [[nodiscard]] bool begin(Random& random) {
    tallied_ = {};
    walker_ = Walker{};
    walker_.position = {0, 0, top_};
    return enter(random);
  }

  /// Walks until nothing is left inside; false when interrupted.
  template <World W>
  [[nodiscard]] bool travel(const W& world, Random& random) {
    const WalkModel model{measured_medium(job_), job_.estimator};
    for (;;) {
      const WalkResult walk = random_walk(world, model, walker_, random, *this);
      if (walk.end == WalkEnd::interrupted) return false;
      if (!goes_on(walk, random)) return true;
    }
  }

  /// The same where others walk: what was flown, times the weight, and what was absorbed; and the end of a
  /// walk, true when it goes on inside.
  void tally(double path, double absorbed) noexcept {
    tallied_.path += path;
    tallied_.absorptance += absorbed;
  }
  [[nodiscard]] bool end(const WalkResult& walk, const Walker& walker, Random& random) {
    walker_ = walker;
    return goes_on(walk, random);
  }

  /// Counts the walk, once it has ended.
  void record() { record(tallied_); }

  // What a scalar walk reports as it goes.
  void segment(const Walker& walker, Real distance) {
    const double weight = double{walker.weight.carried().x};
    tallied_.path += weight * double{distance};
    if (job_.bins.depth > 0)
      spread(double{walker.position.z}, double{walker.direction.z}, double{distance}, weight);
  }
  void absorbed(const Rgb& amount) {
    tallied_.absorptance += double{amount.x};
    if (job_.bins.depth > 0)
      result_.resolved.absorbed_depth.add(
          bin_of(depth_at(walker_.position.z), job_.bins.depth, job_.bins.max_depth), double{amount.x});
  }
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return stop_.load(std::memory_order_relaxed); }

 private:
  // One walk's share of each quantity.
  struct Tallied {
    double reflected = 0, transmitted = 0, direct_reflected = 0, direct_transmitted = 0, specular = 0;
    double absorptance = 0, path = 0;
    double reflected_path = 0, transmitted_path = 0;  // weight times path length
  };

  [[nodiscard]] double depth_at(Real z) const noexcept { return double{top_} - double{z}; }
  [[nodiscard]] bool analog() const noexcept { return job_.estimator == Estimator::analog; }

  // Lets the light in through the surface; false when all of it was mirrored.
  [[nodiscard]] bool enter(Random& random) {
    const double mu = job_.incidence.diffuse ? std::sqrt(1 - double{random.next()}) : job_.incidence.cosine;
    const auto cosine = static_cast<Real>(mu);
    if (job_.roughness > 0) return enter_rough(cosine, random);
    const auto ior = static_cast<Real>(job_.ior);
    const Fresnel fresnel = job_.ior == 1 ? Fresnel{0, cosine} : eval_fresnel(cosine, ior);
    if (analog()) {
      if (random.next() < fresnel.reflectance) {
        tallied_.specular = 1;
        return false;
      }
    } else {
      tallied_.specular = double{fresnel.reflectance};
      walker_.weight.throughput = Rgb(1 - fresnel.reflectance);
    }
    if (job_.boundary == Boundary::diffuse)
      send_inward({0, 0, 1}, random);
    else
      walker_.direction = {std::sqrt((1 - fresnel.cos_t) * (1 + fresnel.cos_t)), 0, -fresnel.cos_t};
    return true;
  }

  // What arrives along the walker's direction, whole: a rough interface decides by chance, with any
  // estimator.
  [[nodiscard]] RoughInterface::Sample meet_rough(const Vec3& normal, Random& random) {
    const RoughDielectric surface{ggx_alpha(static_cast<Real>(job_.roughness)), static_cast<Real>(job_.ior)};
    const RoughInterface::Sample sample =
        RoughInterface(normal, normal, surface, walker_.direction).sample(random);
    walker_.direction = sample.direction;
    return sample;
  }

  [[nodiscard]] bool enter_rough(Real cosine, Random& random) {
    walker_.direction = {std::sqrt((1 - cosine) * (1 + cosine)), 0, -cosine};
    if (!meet_rough({0, 0, 1}, random).outside) return true;
    tallied_.specular = 1;
    return false;
  }

  void send_inward(const Vec3& normal, Random& random) {
    const Real u1 = random.next();
    const Real u2 = random.next();
    walker_.direction = renormalise(make_frame(-normal).to_world(sample_cosine_hemisphere({u1, u2})));
  }

  [[nodiscard]] bool goes_on(const WalkResult& walk, Random& random) {
    result_.leaked_walks += walk.end == WalkEnd::leaked;
    return walk.end == WalkEnd::exited && stays(walk.crossing, random);
  }

  // At the surface from inside: lets out what gets out; true when some goes on inside.
  [[nodiscard]] bool stays(const Crossing& exit, Random& random) {
    const Vec3& n = exit.normal;
    if (job_.roughness > 0) {
      const bool outside = meet_rough(n, random).outside;
      if (outside) let_out(exit, 1, glm::dot(walker_.direction, n));
      return !outside;
    }
    const bool diffuse = job_.boundary == Boundary::diffuse;
    Real cosine = std::min(glm::dot(walker_.direction, n), Real(1));
    if (diffuse) cosine = std::sqrt(1 - random.next());
    const Fresnel fresnel =
        job_.ior == 1 ? Fresnel{0, cosine} : eval_fresnel(cosine, static_cast<Real>(1 / job_.ior));
    if (analog()) {
      const bool reflected = random.next() < fresnel.reflectance;
      if (!reflected) let_out(exit, 1, fresnel.cos_t);
      if (!reflected) return false;
    } else {
      let_out(exit, 1 - fresnel.reflectance, fresnel.cos_t);
      walker_.weight.throughput *= fresnel.reflectance;
      if (fresnel.reflectance == 0 || !walker_.weight.survives_roulette(random, kRouletteThreshold))
        return false;
    }
    if (diffuse)
      send_inward(n, random);
    else
      walker_.direction = lift_off(renormalise(walker_.direction - 2 * cosine * n), -n);
    return true;
  }

  void let_out(const Crossing& exit, Real fraction, Real cosine) {
    const double weight = double{walker_.weight.carried().x * fraction};
    if (weight == 0) return;
    const bool back = std::holds_alternative<MeasuredSphere>(job_.shape) || exit.normal.z > 0;
    const bool direct = walker_.weight.order == 0;
    const double path = walker_.weight.length;
    Tallied& t = tallied_;
    (back ? t.reflected : t.transmitted) += weight;
    if (direct) {
      const bool as_reflected = back && !std::holds_alternative<MeasuredSphere>(job_.shape);
      (as_reflected ? t.direct_reflected : t.direct_transmitted) += weight;
    }
    (back ? t.reflected_path : t.transmitted_path) += weight * path;
    ResolvedBins& bins = result_.resolved;
    const BinOptions& o = job_.bins;
    if (o.angular > 0 && !direct)
      (back ? bins.reflected_angle : bins.transmitted_angle)
          .add(std::min(static_cast<int>(double{cosine} * o.angular), o.angular - 1), weight);
    if (o.radial > 0)
      (back ? bins.reflected_radius : bins.transmitted_radius)
          .add(bin_of(std::hypot(double{exit.point.x}, double{exit.point.y}), o.radial, o.radius), weight);
    if (o.path > 0)
      (back ? bins.reflected_path : bins.transmitted_path).add(bin_of(path, o.path, o.max_path), weight);
  }

  // Shares a flown segment out over the depth bins that it passes.
  void spread(double z, double dz, double distance, double weight) {
    const int count = job_.bins.depth;
    const double width = job_.bins.max_depth / count;
    const double from = depth_at(static_cast<Real>(z));
    const double to = from - dz * distance;
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    const int first = bin_of(std::max(low, 0.0), count, job_.bins.max_depth);
    const int last = bin_of(std::max(high, 0.0), count, job_.bins.max_depth);
    if (first == last) {
      result_.resolved.fluence.add(first, weight * distance);
      return;
    }
    for (int bin = first; bin <= last; ++bin) {
      const double begin = bin == first ? low : bin * width;
      const double end = bin == last ? high : (bin + 1) * width;
      result_.resolved.fluence.add(bin, weight * distance * (end - begin) / (high - low));
    }
  }

  void record(const Tallied& t) {
    const bool sphere = std::holds_alternative<MeasuredSphere>(job_.shape);
    result_.reflectance.add(t.reflected + t.specular);
    result_.transmittance.add(t.transmitted);
    result_.unscattered_reflectance.add(sphere ? t.specular : t.direct_reflected + t.specular);
    result_.unscattered_transmittance.add(t.direct_transmitted);
    result_.specular_reflectance.add(t.specular);
    result_.absorptance.add(t.absorptance);
    result_.mean_path_length.add(t.path);
    result_.from_below.add(t.reflected, 1 - t.specular);
    result_.resolved.mean_path_reflected.add(t.reflected_path, t.reflected);
    result_.resolved.mean_path_transmitted.add(t.transmitted_path, t.transmitted);
    result_.resolved.end_walk();
    result_.walks += 1;
    result_.steps += walker_.steps;
  }

  const MeasureJob& job_;
  Real top_;
  Measurement& result_;
  const std::atomic<bool>& stop_;
  Walker walker_;
  Tallied tallied_;
};

}  // namespace meander
