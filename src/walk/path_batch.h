// Paths side by side: their walks in lanes, everything between two walks in scalar code. A path that needs a
// walk in another body waits until that body's turn comes.
#pragma once

#include <deque>
#include <vector>

#include "walk/lane_walks.h"
#include "walk/path.h"

namespace meander {

/// A geometry whose bodies know where a step crosses nothing. walks_in_lanes: whether a body has such a
/// region and wants its walks in lanes; others are walked by the scalar code.
template <class G>
concept LaneGeometry = SceneGeometry<G> && requires(const G& geometry, std::size_t object) {
  { geometry.walks_in_lanes(object) } -> std::same_as<bool>;
  { geometry.safe_region(object) } -> std::same_as<SafeRegion>;
};

/// A sample to take.
struct BatchSample {
  std::size_t number = 0;  // as its source has it
  PathStart start;
  Random random{{1, 0, 0, 0}};
};

/// Where a batch has its samples from and where they go. next: a sample to begin, which stands until the next
/// one is asked for; nullptr when none is left. done: all that the sample found.
template <class C, class S>
concept SampleSource = requires(C& source, std::size_t number, const S& sink) {
  { source.next() } -> std::same_as<const BatchSample*>;
  source.done(number, sink);
};

/// Traces all the samples of a source, each into a sink of its own. What a sample finds depends on nothing
/// but the sample and the instruction set.
template <LaneGeometry G, Sink S, SampleSource<S> C>
class PathBatch {
 public:
  PathBatch(const Scene& scene, const G& geometry, PathTracer<G>& tracer, C& source)
      : scene_(scene),
        geometry_(geometry),
        tracer_(tracer),
        source_(source),
        waiting_(scene.objects.size()) {}

  /// False when it was interrupted. Errors: std::bad_alloc, and whatever the source throws.
  [[nodiscard]] bool run(InstructionSet set) {
    for (;;) {
      const auto longest = std::ranges::max_element(waiting_, {}, &std::vector<Slot*>::size);
      if (longest == waiting_.end() || longest->empty()) {
        if (tracer_.stop()) return false;
        if (!draw()) return !interrupted_;
        continue;
      }
      const auto object = static_cast<std::size_t>(longest - waiting_.begin());
      const auto& material =
          std::get<TranslucentMaterial>(scene_.materials[scene_.objects[object].material].kind);
      const LaneModel model{material.medium, geometry_.safe_region(object),
                            tracer_.lights_collisions(material)};
      Client client{*this, object};
      const bool ended = geometry_.with_body(object, [&](const auto& world) {
        LaneWalks walks(set, world, model, client);
        const bool whole = walks.run();
        if (geometry_.traces_rays(object)) tracer_.counters().rays += walks.counters().rays;
        return whole;
      });
      if (!ended) return false;
    }
  }

 private:
  /// Paths that wait before no new ones are begun.
  static constexpr std::size_t kMostWaiting = 1024;

  struct Slot {
    std::size_t sample = 0;
    Path path;
    Random random{{1, 0, 0, 0}};
    S sink;
  };

  // The paths that walk in one body.
  struct Client {
    PathBatch& batch;
    std::size_t object;
    Slot* slots[kLanes] = {};

    [[nodiscard]] bool start(int lane, Walker& walker, Random& random) {
      std::vector<Slot*>& waiting = batch.waiting_[object];
      while (waiting.empty())
        if (stop() || batch.count_waiting_ >= kMostWaiting || !batch.draw()) return false;
      Slot* slot = slots[lane] = waiting.back();
      waiting.pop_back();
      --batch.count_waiting_;
      walker = slot->path.walker;
      random = slot->random;
      return true;
    }
    [[nodiscard]] bool end(int lane, const WalkResult& walked, Walker& walker, Random& random) {
      Slot& slot = *slots[lane];
      slot.path.walker = walker;
      slot.random = random;
      batch.settle(slot, batch.tracer_.resume(slot.path, walked, slot.random, slot.sink));
      return start(lane, walker, random);
    }
    void collided(int lane, Real clearance, Walker& walker, Random& random) {
      Slot& slot = *slots[lane];
      slot.path.walker = walker;
      batch.tracer_.collided(slot.path, clearance, random, slot.sink);
    }
    [[nodiscard]] bool stop() const noexcept { return batch.interrupted_ || batch.tracer_.stop(); }
  };

  // Begins a sample; false when there is none, or when it was interrupted.
  [[nodiscard]] bool draw() {
    if (interrupted_) return false;
    if (free_.empty()) free_.push_back(&slots_.emplace_back());
    Slot& slot = *free_.back();
    const BatchSample* sample = source_.next();
    if (!sample) return false;
    free_.pop_back();
    slot.sample = sample->number;
    slot.random = sample->random;
    slot.sink = {};
    settle(slot, tracer_.begin(slot.path, sample->start, slot.random, slot.sink));
    return true;
  }

  // Files a path under what it needs next.
  void settle(Slot& slot, PathStep step) {
    while (step == PathStep::walk) {
      const std::size_t object = slot.path.hit.object;
      if (geometry_.walks_in_lanes(object)) {
        waiting_[object].push_back(&slot);
        ++count_waiting_;
        return;
      }
      const WalkResult walked = tracer_.walk(slot.path, slot.random, slot.sink);
      step = tracer_.resume(slot.path, walked, slot.random, slot.sink);
    }
    if (step == PathStep::interrupted)
      interrupted_ = true;
    else
      source_.done(slot.sample, slot.sink);
    free_.push_back(&slot);
  }

  const Scene& scene_;
  const G& geometry_;
  PathTracer<G>& tracer_;
  C& source_;
  std::deque<Slot> slots_;
  std::vector<Slot*> free_;
  std::vector<std::vector<Slot*>> waiting_;  // by object
  std::size_t count_waiting_ = 0;
  bool interrupted_ = false;
};

}  // namespace meander
