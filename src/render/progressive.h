// Progressive rendering: passes over tiles on oneTBB. Every pixel has one owner in a pass and takes its
// samples in order, so the bytes depend on nothing but the job.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "film/film.h"
#include "film/noise.h"
#include "film/plan.h"
#include "film/tiles.h"
#include "render/parallel.h"
#include "trace/geometry.h"
#include "walk/lanes.h"
#include "walk/path.h"

namespace meander {

/// What to render; immutable once submitted. Sample k of a pixel draws from stream(seed, pixel, first_sample
/// + k).
struct Job {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Geometry> geometry;
  std::optional<Tile> crop;  // in pixels of the scene's film, inside it and not empty
  std::uint64_t seed = 0;
  std::uint32_t first_sample = 0;
  Estimator estimator = Estimator::implicit;
  int threads = 1;
  int scale = 1;  // a power of two: one pixel of the job stands for scale x scale pixels of the scene's film
  Priority priority = Priority::normal;
  WalkCode walk = WalkCode::batch;
  InstructionSet instruction_set = instruction_sets().back();  // of the batch; one set, one result
};

struct Rendering {
  Film film;  // of the size of the job's area
  std::uint64_t spp = 0;
  double seconds = 0;
  NoiseEstimate noise;  // over the object's pixels
  PathCounters counters;
  std::uint64_t non_finite = 0;  // samples that were not finite, taken as black
};

/// What a plan asks of a rendering.
[[nodiscard]] inline Progress progress_of(const Rendering& rendering) noexcept {
  return {rendering.spp, rendering.seconds, rendering.noise.noise, rendering.noise.reliable()};
}

/// The rectangle that the job renders, in its own pixels; at a scale, the pixels that the crop touches.
[[nodiscard]] Tile area_of(const Job& job) noexcept;

/// The camera of the scene's film, and the ray through a place of it given in the job's pixels.
[[nodiscard]] CameraRays camera_of(const Job& job) noexcept;
[[nodiscard]] Ray film_ray(const Job& job, const CameraRays& camera, double x, double y) noexcept;

/// The stream of sample k of a pixel of the job, its hero channel (they take turns, from a random one on),
/// and what its paths are traced with, once its walks are prepared.
[[nodiscard]] Random sample_stream(const Job& job, int x, int y, std::uint64_t k) noexcept;
[[nodiscard]] int sample_hero(const Job& job, int x, int y, std::uint64_t k) noexcept;
[[nodiscard]] PathOptions path_options(const Job& job, const std::atomic<bool>& stop);

/// Bytes that the films of a job take.
[[nodiscard]] std::uint64_t film_bytes(const Job& job);

/// A job's passes over its area, one at a time.
class Passes {
 public:
  /// `stop` must outlive the passes.
  Passes(const Job& job, const std::atomic<bool>& stop);

  /// Renders `samples` more samples a pixel than `before` has and puts film, spp, counters and non_finite
  /// into `after`, a different object. False when it was interrupted: `after` is then of no use. A pass is
  /// kept whole or not at all: keeping the walks that had ended would keep the short ones.
  [[nodiscard]] bool advance(const Rendering& before, std::uint64_t samples, Rendering& after) const;

 private:
  Job job_;
  const std::atomic<bool>& stop_;
  CameraRays camera_;
  Tile area_;
};

/// Renders until the budget is met or `stop` becomes true. `published` is called after every pass, on the
/// calling thread. A pass that was interrupted is discarded.
[[nodiscard]] Rendering render(const Job& job, const Budget& budget, const std::atomic<bool>& stop,
                               const std::function<void(const Rendering&)>& published);

/// Whether the job walks in lanes wherever the scene allows it.
[[nodiscard]] bool uses_lanes(const Job& job) noexcept;

/// Waits for what the job's geometry still makes for its walks, which a pass would do otherwise; false when
/// it was interrupted. Errors: what stopped the making.
[[nodiscard]] bool prepare_walks(const Job& job, const std::atomic<bool>& stop);

/// What walks in a scene have to deal with, in words, "grey isotropic matched"; and with which code a job
/// does so before it, "batch grey isotropic matched".
[[nodiscard]] std::string describe_media(const Scene& scene);
[[nodiscard]] std::string describe_model(const Job& job);

}  // namespace meander
