// Reflectance, transmittance and absorption of exact shapes, with error bars: the same walk that renders, in
// units of the mean free path.
#pragma once

#include <atomic>
#include <variant>

#include "render/measure_bins.h"
#include "scene/scene.h"
#include "stats/moments.h"
#include "walk/lanes.h"

namespace meander {

struct MeasuredSlab {
  double tau = 1;  // optical thickness
};
struct MeasuredHalfSpace {};
struct MeasuredSphere {
  double tau_radius = 1;  // optical radius
};

/// How light arrives: at one cosine with the surface normal, or diffuse (cosine-weighted).
struct Incidence {
  bool diffuse = false;
  double cosine = 1;
};

struct MeasureJob {
  std::variant<MeasuredSlab, MeasuredHalfSpace, MeasuredSphere> shape;
  double albedo = 0.9;
  double g = 0;
  Boundary boundary = Boundary::matched;
  double ior = 1;        // index inside over outside, >= 1; 1 with a matched boundary
  double roughness = 0;  // of a dielectric boundary, in [0, 1]
  Incidence incidence;
  Estimator estimator = Estimator::implicit;
  std::uint64_t walks = 1'000'000;
  std::uint64_t seed = 0;
  int threads = 1;
  BinOptions bins;  // where there are any, walks are scalar
  WalkCode walk = WalkCode::batch;
  InstructionSet instruction_set = instruction_sets().back();
};

/// Per incident flux, as the mean over the walks; totals include the unscattered part. For the sphere,
/// reflectance is all that comes out. `mean_path_length` is in mean free paths.
struct Measurement {
  Moments reflectance;
  Moments transmittance;
  Moments unscattered_reflectance;
  Moments unscattered_transmittance;
  Moments specular_reflectance;
  Moments absorptance;
  Moments mean_path_length;
  RatioOfSums from_below;  // of what entered, what leaves again where it entered: the half-space's colour
  ResolvedBins resolved;
  std::uint64_t walks = 0;
  std::uint64_t steps = 0;
  std::uint64_t leaked_walks = 0;
  double seconds = 0;

  void merge(const Measurement& other);
};

/// Runs the walks; the result depends on nothing but the job's numbers, not on its threads. When `stop`
/// becomes true only what whole blocks of walks had found, in order, is returned.
[[nodiscard]] Measurement measure(const MeasureJob& job, const std::atomic<bool>& stop);

}  // namespace meander
