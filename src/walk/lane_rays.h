// What lanes need that rest: their rays, and balls for those that go on.
#pragma once

#include <span>

#include "scene/crossing.h"
#include "walk/lanes.h"

namespace meander {

/// The lanes that rest, in `lane`. Of those whose steps may cross, if `wants_rays`, by lane: `clear` is how
/// far along the step balls tell that nothing is crossed (0 where the step is shorter than a cell), and
/// `ray`, where that is not all of it, which of the rays tells about the rest. Room for a vector beyond the
/// last lane.
struct RestingLanes {
  static_assert(kLanes <= Steps::kMost);
  bool wants_rays = true;
  alignas(64) std::uint32_t lane[kLanes + 16];
  int count = 0;
  Steps rays;
  int ray_count = 0;
  float clear[kLanes];
  int ray[kLanes];
};

/// The instruction set must be one that the machine has, as for advance_lanes.
void find_resting(InstructionSet set, const LaneModel& model, const Lanes& lanes,
                  RestingLanes& resting) noexcept;

/// Gives some lanes, whose walks are inside of the body, balls into which no step from there leaves it; none
/// (a negative squared radius) where none is known. Up to 15 numbers are read beyond the last one.
void give_balls(InstructionSet set, const EmptyBalls& field, Lanes& lanes,
                std::span<const std::uint32_t> to) noexcept;

}  // namespace meander
