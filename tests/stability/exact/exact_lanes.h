// The walks of a case in lanes.
#pragma once

#include <limits>

#include "stability/exact/exact_walk.h"
#include "walk/lane_walks.h"

namespace meander {

/// Lanes ask whether to stop for all of them at once, never for a walk.
[[nodiscard]] inline bool walks_in_lanes(const ExactCase& of) { return of.kind != ExactKind::capped; }

/// The inside of a case's shape.
[[nodiscard]] inline SafeRegion region_of(const ExactCase& of) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  SafeRegion region;
  if (of.shape == ExactShape::sphere) {
    region.kind = SafeRegion::Kind::ellipsoid;
    return region;
  }
  for (int axis = 0; axis < 2; ++axis) {
    region.low[axis] = -kEndless;
    region.high[axis] = kEndless;
  }
  region.low[2] = of.shape == ExactShape::slab ? -1 : -kEndless;
  region.high[2] = 0;
  return region;
}

/// Each lane counts one walk after another.
class ExactLanes {
 public:
  ExactLanes(const ExactCase& of, std::uint64_t walks, std::uint64_t seed, ExactResults& results)
      : walks_(walks), seed_(seed), lanes_(kLanes, ExactWalk(of, results)) {}

  [[nodiscard]] bool start(int lane, Walker& walker, Random& random) {
    if (next_ == walks_) return false;
    random = at(lane).begin(seed_, next_++);
    walker = at(lane).walker();
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& walked, Walker& walker, Random& random) {
    at(lane).walker() = walker;
    if (at(lane).goes_on(walked, random)) {
      walker = at(lane).walker();
      return true;
    }
    at(lane).record();
    return start(lane, walker, random);
  }
  void collided(int, Real, Walker&, Random&) const noexcept {}
  void tally(int lane, double path, double absorbed) {
    at(lane).tally(path, absorbed);
  }
  [[nodiscard]] bool stop() const noexcept { return false; }

 private:
  [[nodiscard]] ExactWalk& at(int lane) { return lanes_[static_cast<std::size_t>(lane)]; }

  std::uint64_t walks_;
  std::uint64_t seed_;
  std::uint32_t next_ = 0;
  std::vector<ExactWalk> lanes_;
};

/// Walks a case in lanes of the machine's best instruction set.
[[nodiscard]] inline ExactResults walk_lanes(const ExactCase& of, std::uint64_t walks, std::uint64_t seed) {
  ExactResults results;
  const LaneModel model{medium_of(of), region_of(of), false};
  ExactLanes client(of, walks, seed, results);
  with_world(
      of, [&](const auto& world) { (void)LaneWalks(instruction_sets().back(), world, model, client).run(); });
  return results;
}

}  // namespace meander
