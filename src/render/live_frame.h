// What a live session takes and what it gives: plain data.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "film/film_planes.h"
#include "render/progressive.h"

namespace meander {

/// What to render. `scene` has the film's size already; `region` lies inside that film and is not empty.
struct SessionRequest {
  std::shared_ptr<const Scene> scene;
  std::optional<Tile> region;  // render this rectangle of the film only
  Budget budget;
  std::uint64_t seed = 0;
  Estimator estimator = Estimator::implicit;
  WalkCode walk = WalkCode::batch;
  InstructionSet instruction_set = instruction_sets().back();
  bool interactive = false;  // under a drag: coarse images alone, 20 and more of them a second
};

struct NoisePoint {
  double seconds;
  std::uint64_t spp;
  double noise;
};

/// One image, never changed once it is published.
struct LiveFrame {
  std::uint64_t generation = 0;        // of the submit() that it answers
  std::shared_ptr<const Scene> scene;  // what it shows
  int scale = 1;                       // one pixel of the planes stands for scale x scale pixels of the film
  Tile area;  // film pixels that the planes cover: scale times their size; beyond the film's edge by < scale
  int film_width = 0;
  int film_height = 0;
  FilmPlanes planes;
  std::uint64_t spp = 0;  // 1 for a coarse image
  double seconds = 0;     // spent tracing this image; pauses and coarser images do not count
  double noise = 0;       // relative noise, see film/noise.h; infinite below two samples
  bool noise_reliable = true;
  PathCounters counters;         // of this image
  std::uint64_t non_finite = 0;  // samples that were not finite, taken as black
  std::vector<NoisePoint>
      history;            // of this generation, after every full-resolution pass from two samples on
  bool complete = false;  // its budget is met
  // Which bodies overlap (trace/overlaps.h): known at full resolution.
  std::optional<std::vector<std::string>> overlaps;
  double first_image_seconds = 0;  // from submit() to the first frame of this generation
  double waited_seconds = 0;       // from submit() until the worker took it up: how long the stop took
};

}  // namespace meander
