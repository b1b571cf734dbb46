// One request of a live session on its way from the first coarse image to its budget, one image at a time.
#pragma once

#include "render/first_hits.h"
#include "render/live_frame.h"
#include "render/pool.h"

namespace meander {

/// What outlives a request: whatever the next one may use again.
struct LiveStock {
  int threads = 1;
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const FirstHits> hits;  // of hits_scene and hits_area, at full resolution
  std::shared_ptr<const Scene> hits_scene;
  Tile hits_area;
  double seconds_per_pixel = 3e-6;  // of a coarse image, as last measured; a cautious guess at first
  Pool<Rendering> films;
  Pool<LiveFrame> frames;
};

/// How coarse a first image has to be: the smallest power of two at which `pixels` are predicted to take at
/// most `target` seconds, at most 64.
[[nodiscard]] int coarse_scale(double pixels, double seconds_per_pixel, double target) noexcept;

class LiveImage {
 public:
  /// Builds the geometry. Errors: Error when the film does not fit into the memory, or from Embree.
  LiveImage(SessionRequest request, LiveStock& stock);

  /// Renders the next image, coarse ones first; nothing when `stop` became true, or when what was rendered is
  /// not worth showing. An interrupted image is discarded. Of the frame, generation and the times since
  /// submit() are left to the caller.
  [[nodiscard]] std::shared_ptr<LiveFrame> step(const std::atomic<bool>& stop);

  /// Whether step() has something to do; `paused` holds the full-resolution passes back
  /// once there is an image.
  [[nodiscard]] bool has_work(bool paused) const noexcept;

  void set_budget(const Budget& budget) noexcept;

  /// The full-resolution film after its last pass, null before the first.
  [[nodiscard]] const std::shared_ptr<const Rendering>& film() const noexcept { return done_; }

 private:
  enum class Stage { probe, coarse, full, finished };

  [[nodiscard]] std::shared_ptr<LiveFrame> render_coarse(const std::atomic<bool>& stop);
  [[nodiscard]] std::shared_ptr<LiveFrame> render_pass(const std::atomic<bool>& stop);
  [[nodiscard]] bool find_first_hits(const std::atomic<bool>& stop);
  [[nodiscard]] bool judge_probe(double cost);
  void refine();
  [[nodiscard]] std::uint64_t next_samples() const noexcept;
  [[nodiscard]] bool resolve(const Job& job, const Rendering& film, const Image& normals, LiveFrame& frame,
                             const std::atomic<bool>& stop) const;

  LiveStock& stock_;
  SessionRequest request_;
  Job job_;
  double pixels_;  // of the full resolution
  Stage stage_ = Stage::probe;
  int scale_ = 1;
  double spent_ = 0;  // seconds, on coarse images
  std::shared_ptr<const Rendering> done_;
  std::vector<NoisePoint> history_;
  std::optional<std::vector<std::string>> overlaps_;
  bool shown_ = false;  // some image
  bool shown_complete_ = false;
};

}  // namespace meander
