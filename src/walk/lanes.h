// Many walks side by side in lanes of SIMD: each lane flies, collides and scatters until it needs something
// that is not vector code (a ray, a shadow ray, a new walk), and rests there until it has been seen to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "medium/medium.h"
#include "scene/safe_region.h"
#include "walk/random_walk.h"

namespace meander {

/// Lanes of one batch: enough that the rested ones are seen to in groups, few enough to stay in the nearest
/// cache.
inline constexpr int kLanes = 128;

/// Steps whose lengths a lane sums up at most: single precision holds no long sums.
inline constexpr std::uint32_t kSumInterval = 4096;

/// Why a lane rests. `running` lanes do not.
enum class LaneState : std::uint32_t {
  running,
  crossing,  // the step of length `distance` may cross the surface: a ray has to tell
  collided,  // a collision's weight has been applied and the old direction still stands
  absorbed,  // roulette ended the walk
  summed,    // has made kSumInterval steps more, and its sums are to be taken away before it runs on
  empty      // holds no walk
};

/// What a running lane does first: fly, scatter and fly, or collide where it is, `distance` having been
/// flown.
enum class LaneDue : std::uint32_t { flight, scattering, collision };

/// The walks of a batch, one a lane; single precision. Weights as in PathWeight: `ratio` are the densities of
/// the free paths in proportion, `lift` what roulette has multiplied the throughput by, which `throughput`
/// leaves out. `ball` is one into which no step from the position crosses anything, or has a negative squared
/// radius.
struct alignas(64) Lanes {
  using Row = float[kLanes];
  Row position[3];
  Row direction[3];
  Row ball_center[3];
  Row ball_radius2;
  Row throughput[3];
  Row albedo[3];
  Row ratio[3];
  Row lift;
  // Since the walk was put, or since they were last taken away.
  Row length;
  Row path;      // weight times distance, and
  Row absorbed;  // weight left behind, of the first channel
  Row distance;
  Row sigma;         // of the channel that samples the distances
  Row one_minus_mu;  // of the deflection that made the direction, and
  Row one_plus_mu;
  std::uint32_t random[4][kLanes];
  std::uint32_t order[kLanes];
  std::uint32_t steps[kLanes];
  std::uint32_t due[kLanes];  // LaneDue
  std::uint32_t state[kLanes];
};

/// Puts a walk into a lane, which runs from then on, due a flight, without a ball; `sigma` is the extinction
/// of its hero channel.
void put_walker(Lanes& lanes, int lane, const Walker& walker, const Random& random, Real sigma) noexcept;

/// Moves a walk from one lane to another, which is empty; the one it leaves is empty then.
void move_walk(Lanes& lanes, int from, int to) noexcept;

/// Lets a lane's walk collide at a point after a flight, from which on it runs, without a ball.
void land(Lanes& lanes, int lane, const Vec3& point, Real distance) noexcept;

/// The walk of a lane (but for its hero channel, and with the length that `length` holds) and the state of
/// its generator, for scalar code.
[[nodiscard]] Walker walker_of(const Lanes& lanes, int lane) noexcept;
[[nodiscard]] Random random_of(const Lanes& lanes, int lane) noexcept;

/// What the lanes walk through: implicit capture. `rests_at_collisions`: every collision needs a shadow ray.
struct LaneModel {
  Medium medium;
  SafeRegion region;
  bool rests_at_collisions = false;
};

/// Which code walks: the scalar oracle, or lanes of SIMD wherever those can (implicit capture, no light
/// inside the body). Same statistics, other rounding.
enum class WalkCode { scalar, batch };

enum class InstructionSet { baseline, sse4, avx2, avx512 };

/// Names as `--isa` takes them, and back; nothing for another name.
[[nodiscard]] std::string_view name_of(InstructionSet set) noexcept;
[[nodiscard]] std::optional<InstructionSet> instruction_set(std::string_view name) noexcept;

/// Those that this machine has, best last.
[[nodiscard]] std::span<const InstructionSet> instruction_sets() noexcept;

/// Advances the running lanes among the first `count` (a multiple of 16) until at least `enough` of all rest,
/// none runs, or each that still runs has made kStopInterval steps. The instruction set must be one that the
/// machine has. One set gives the same numbers wherever it runs.
void advance_lanes(InstructionSet set, const LaneModel& model, Lanes& lanes, int count, int enough) noexcept;

}  // namespace meander
