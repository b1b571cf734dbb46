// The live session: one worker that always renders the newest request, coarse images first, and publishes
// what it has. The thread that draws never waits for it.
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
  bool interactive = false;  // under a drag: coarse images alone, 20 and more of them a second
};

struct NoisePoint {
  double seconds;
  std::uint64_t spp;
  double noise;
};

/// One image, never changed once it is published.
struct Frame {
  std::uint64_t generation = 0;        // of the submit() that it answers
  std::shared_ptr<const Scene> scene;  // what it shows
  int scale = 1;                       // one pixel of the planes stands for scale x scale pixels of the film
  Tile area;  // film pixels that the planes cover: scale times their size; beyond the film's edge by < scale
  int film_width = 0;
  int film_height = 0;
  FilmPlanes planes;
  std::uint64_t spp = 0;         // 1 for a coarse image
  double seconds = 0;            // spent tracing this image; pauses and coarser images do not count
  double noise = 0;              // relative noise, see film.h; infinite below two samples
  PathCounters counters;         // of this image
  std::uint64_t non_finite = 0;  // samples that were not finite, taken as black
  std::vector<NoisePoint>
      history;                     // of this generation, after every full-resolution pass from two samples on
  bool complete = false;           // its budget is met
  double first_image_seconds = 0;  // from submit() to the first frame of this generation
  double waited_seconds = 0;       // from submit() until the worker took it up: how long the stop took
};

/// Every member may be called from any thread; none waits for a walk but the destructor, which stops the
/// running pass and joins.
class Session {
 public:
  /// Traces on at most `threads` threads, at a lower priority than the rest of the process.
  explicit Session(int threads);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Replaces the job and returns its generation (1, 2, …). The running pass is stopped, except for the first
  /// image of a job while it is about to appear: that one is still finished and published.
  std::uint64_t submit(SessionRequest request);

  /// A paused session stops its pass, keeps its film and goes on later. What is submitted meanwhile shows its
  /// coarse images and waits at full resolution.
  void set_paused(bool paused);

  /// Replaces the newest request's budget; what has been done stands.
  void set_budget(const Budget& budget);

  /// The newest frame of any generation, null before the first. Generations never go back.
  [[nodiscard]] std::shared_ptr<const Frame> latest() const;

  /// The full-resolution film of that generation after its last pass, null when there is none (any more).
  [[nodiscard]] std::shared_ptr<const Rendering> rendering(std::uint64_t generation) const;

  /// What went wrong on the worker since the last call. Its job is given up; the session takes the next one.
  [[nodiscard]] std::optional<std::string> take_error();

  /// Whether a request waits or is being traced; false when paused, complete or failed.
  [[nodiscard]] bool working() const;

 private:
  struct Shared;
  class Worker;
  std::unique_ptr<Shared> shared_;
  std::unique_ptr<Worker> worker_;
};

}  // namespace meander
