// Runs many walks in one exact world and keeps what tests ask of them.
#pragma once

#include <functional>

#include "math/warp.h"
#include "stats/moments.h"
#include "walk/analytic_worlds.h"
#include "walk/random_walk.h"

namespace meander {

struct WalkTally {
  Moments back;         // weight through the face that light entered by
  Moments through;      // weight through any other
  Moments unscattered;  // weight without a collision
  Moments absorbed;
  Moments path;   // sum of weight times segment
  Moments order;  // scatterings per walk
};

struct TallyEvents {
  double path = 0;
  double absorptance = 0;
  void segment(const Walker& walker, Real distance) noexcept {
    path += double{walker.weight.carried().x} * double{distance};
  }
  void absorbed(const Rgb& amount) noexcept { absorptance += double{amount.x}; }
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

/// Starts `walks` walks with start(walker, random), and adds up the first channel.
template <World W>
WalkTally tally_walks(const W& world, const WalkModel& model, std::uint32_t walks, std::uint64_t seed,
                      const std::function<void(Walker&, Random&)>& start) {
  WalkTally tally;
  for (std::uint32_t i = 0; i < walks; ++i) {
    Random random = stream(seed, 0, i);
    Walker walker;
    start(walker, random);
    TallyEvents events;
    const WalkResult result = random_walk(world, model, walker, random, events);
    const bool exited = result.end == WalkEnd::exited;
    const double weight = exited ? double{walker.weight.carried().x * walker.weight.free_path_weight().x} : 0;
    const bool back = result.crossing.normal.z > 0;
    tally.back.add(exited && back ? weight : 0);
    tally.through.add(exited && !back ? weight : 0);
    tally.unscattered.add(walker.weight.order == 0 ? weight : 0);
    tally.absorbed.add(events.absorptance);
    tally.path.add(events.path);
    tally.order.add(walker.weight.order);
  }
  return tally;
}

/// Enters at the top (0, 0, top) under a cosine, or diffusely when the cosine is 0.
inline std::function<void(Walker&, Random&)> enter(Real top, Real cosine) {
  return [=](Walker& walker, Random& random) {
    walker.position = {0, 0, top};
    if (cosine > 0) {
      walker.direction = {std::sqrt(1 - cosine * cosine), 0, -cosine};
      return;
    }
    const Real u1 = random.next();
    const Real u2 = random.next();
    walker.direction = -sample_cosine_hemisphere({u1, u2});
  };
}

}  // namespace meander
