// The live session: one worker that always renders the newest request, coarse images first, and publishes
// what it has. The thread that draws never waits for it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "render/live_frame.h"

namespace meander {

/// Every member may be called from any thread; none waits for a walk but the destructor, which stops the
/// running pass and joins.
class Session {
 public:
  /// Traces on at most `threads` threads, at a lower priority than the rest of the process. Generations go on
  /// from `generation`, so that the frames of a session before it are never taken for this one's.
  explicit Session(int threads, std::uint64_t generation = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Replaces the job and returns its generation (1, 2, … from the one given). The running pass is stopped,
  /// except for the first image of a job in its first 60 ms: a stream of submits, however fast, shows images.
  std::uint64_t submit(SessionRequest request);

  /// A paused session stops its pass, keeps its film and goes on later. What is submitted meanwhile shows its
  /// coarse images, or its first one if that is of full resolution, and then waits.
  void set_paused(bool paused);

  /// Replaces the newest request's budget; what has been done stands.
  void set_budget(const Budget& budget);

  /// The newest frame of any generation, null before the first. Generations never go back.
  [[nodiscard]] std::shared_ptr<const LiveFrame> latest() const;

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
