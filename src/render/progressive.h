// Progressive rendering: passes over tiles on oneTBB. Every pixel has one owner in a pass and takes its
// samples in order, so the bytes depend on nothing but the job.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "film/film.h"
#include "film/plan.h"
#include "film/tiles.h"
#include "trace/geometry.h"
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
};

struct Rendering {
  Film film;  // of the crop's size, or the scene's
  std::uint64_t spp = 0;
  double seconds = 0;
  double noise = 0;  // relative noise over the object's pixels, see film.h
  PathCounters counters;
  std::uint64_t non_finite = 0;  // samples that were not finite, taken as black
};

/// The rectangle of the scene's film that the job renders.
[[nodiscard]] Tile area_of(const Job& job);

/// One byte a pixel of the job's area: 1 where its whole square shows a translucent object, judged at its
/// corners and its middle. Once `stop` is true the rest is left 0.
[[nodiscard]] std::vector<std::uint8_t> object_mask(const Job& job, const std::atomic<bool>& stop);

/// Bytes that the films of a job take.
[[nodiscard]] std::uint64_t film_bytes(const Job& job);

/// Renders until the budget is met or `stop` becomes true. `published` is called after every pass, on the
/// calling thread. A pass that was interrupted is discarded whole: keeping the walks that had ended would
/// keep the short ones.
[[nodiscard]] Rendering render(const Job& job, const Budget& budget, const std::atomic<bool>& stop,
                               const std::function<void(const Rendering&)>& published);

/// What the job's walks have to deal with, in words: "grey isotropic matched".
[[nodiscard]] std::string describe_model(const Scene& scene);

}  // namespace meander
