// Runs walks in lanes through one body: the vector code advances them, scalar code sees to the lanes that
// rest.
#pragma once

#include <hwy/cache_control.h>

#include <limits>
#include <utility>

#include "walk/lanes.h"

namespace meander {

/// What gives a batch its walks and takes them back.
/// start(lane, walker, random): sets up the first walk of a lane, or says false when there is none left.
/// end(lane, result, walker, random): a walk of the lane has ended; true when another (the same one, sent
/// back inside, or a new one) has been set up in its place. collided(lane, walker, random): see WalkEvents::
/// scattered; the random numbers it draws are the walk's. tally(lane, path, absorbed), which a client may
/// have besides: what the walk has flown, times its weight, and left behind, of the first channel, since the
/// last call.
template <class C>
concept LaneClient = requires(C& client, int lane, const WalkResult& result, Walker& walker, Random& random) {
  { client.start(lane, walker, random) } -> std::same_as<bool>;
  { client.end(lane, result, walker, random) } -> std::same_as<bool>;
  client.collided(lane, walker, random);
  { client.stop() } -> std::same_as<bool>;
};

/// Lanes that rest before scalar code sees to them: few, so that most lanes run.
inline constexpr int kRestingLanes = 16;

/// Steps that cost a ray, of all.
struct LaneCounters {
  std::uint64_t rays = 0;
};

/// The walks that a client gives, in one body; implicit capture.
template <World W, LaneClient C>
class LaneWalks {
 public:
  LaneWalks(InstructionSet set, const W& world, const LaneModel& model, C& client) noexcept
      : set_(set), world_(world), model_(model), client_(client) {}

  /// Runs until the client has no walk left; false when it said stop, which is asked whenever rays are
  /// traced, and every kStopInterval steps at least. Errors: whatever the client throws.
  [[nodiscard]] bool run() {
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes_.state[lane] = static_cast<std::uint32_t>(LaneState::empty);
      Walker walker;
      Random random({1, 0, 0, 0});
      if (client_.start(lane, walker, random)) put(lane, walker, random, false);
    }
    give_balls();
    while (in_use_ > 0) {
      if (client_.stop()) return false;
      advance_lanes(set_, model_, lanes_, kLanes, kLanes - in_use_ + std::min(kRestingLanes, in_use_));
      find_resting();
      if constexpr (kTogether)
        begin_rays();
      else
        cross_together();
      for (int i = 0; i < resting_count_; ++i) see_to(resting_[i]);
      give_balls();
    }
    return true;
  }

  [[nodiscard]] const LaneCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr bool kTallies = requires(C & client) { client.tally(0, Real(0), Real(0)); };

  // Of a walk's weight, as it was put into its lane.
  struct Put {
    Rgb ratio{1};
    Rgb since{1};
    std::uint32_t order = 0;
    int hero = 0;
  };

  void put(int lane, const Walker& walker, const Random& random, bool scatters) noexcept {
    if (lanes_.state[lane] == static_cast<std::uint32_t>(LaneState::empty)) ++in_use_;
    put_walker(lanes_, lane, walker, random, scatters, model_.medium.sigma_t);
    fresh_[fresh_count_++] = lane;
    put_[lane] = {walker.weight.ratio, walker.weight.since, walker.weight.order, walker.weight.hero};
  }

  // The walk of a lane. What it came with from before the body is folded in at its first collision; until
  // then it stands.
  [[nodiscard]] Walker walker_in(int lane) const noexcept {
    Walker walker = walker_of(lanes_, lane);
    const Put& put = put_[lane];
    walker.weight.hero = put.hero;
    if (walker.weight.order == put.order) {
      walker.weight.ratio = put.ratio;
      walker.weight.since = put.since;
    }
    return walker;
  }

  // Gives the lanes that have been put their balls, whose memory comes for all at once.
  void give_balls() noexcept {
    const int count = std::exchange(fresh_count_, 0);
    const EmptyBalls* balls = model_.region.balls;
    if (!balls) return;
    std::size_t cells[kLanes];
    for (int i = 0; i < count; ++i) {
      cells[i] = balls->cell_at(position(fresh_[i]));
      hwy::Prefetch(&balls->cells[cells[i]]);
    }
    for (int i = 0; i < count; ++i) hwy::Prefetch(&balls->balls[balls->cells[cells[i]]]);
    for (int i = 0; i < count; ++i) put_ball(lanes_, fresh_[i], balls->from(position(fresh_[i])));
  }

  [[nodiscard]] glm::vec3 position(int lane) const noexcept {
    return {lanes_.position[0][lane], lanes_.position[1][lane], lanes_.position[2][lane]};
  }

  [[nodiscard]] Vec3 direction(int lane) const noexcept {
    return {lanes_.direction[0][lane], lanes_.direction[1][lane], lanes_.direction[2][lane]};
  }

  // Rays are begun for all resting lanes together where the world can, part by part, so that one does not
  // wait for what another waits for.
  static constexpr bool kTogether = requires(const W& world, const Vec3& p, Real t) {
    world.prefetch(p);
    world.finish_crossing(world.begin_crossing(p, p, t, world.foresee_crossing(p, p, t)));
  };

  void find_resting() noexcept {
    resting_count_ = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      resting_[resting_count_] = lane;
      const auto state = static_cast<LaneState>(lanes_.state[lane]);
      resting_count_ += int{state != LaneState::running} & int{state != LaneState::empty};
    }
  }

  // A ray under way: what balls do not answer for of a lane's step.
  struct LaneRay {
    int lane;
    Vec3 origin;
    Vec3 direction;
    Real distance;
  };

  void begin_rays() noexcept {
    LaneRay rays[kLanes];
    decltype(std::declval<const W&>().foresee_crossing(Vec3(), Vec3(), Real())) hints[kLanes];
    int count = 0;
    for (int i = 0; i < resting_count_; ++i) {
      const int lane = resting_[i];
      if (lanes_.state[lane] != static_cast<std::uint32_t>(LaneState::crossing)) continue;
      LaneRay& ray = rays[count];
      ray = ray_of(lane);
      count += ray.distance > 0;
    }
    counters_.rays += static_cast<std::uint64_t>(count);
    for (int i = 0; i < count; ++i) world_.prefetch(rays[i].origin);
    for (int i = 0; i < count; ++i)
      hints[i] = world_.foresee_crossing(rays[i].origin, rays[i].direction, rays[i].distance);
    for (int i = 0; i < count; ++i)
      begun_[rays[i].lane] =
          world_.begin_crossing(rays[i].origin, rays[i].direction, rays[i].distance, hints[i]);
  }

  // Steps that leave an exact body, one after another, so that the roots and divisions of one do not wait for
  // those of another.
  void cross_together() noexcept {
    for (int i = 0; i < resting_count_; ++i) {
      const int lane = resting_[i];
      if (lanes_.state[lane] != static_cast<std::uint32_t>(LaneState::crossing)) continue;
      begun_[lane] = world_.first_crossing(Vec3(position(lane)), direction(lane), distance_of(lane));
      ++counters_.rays;
    }
  }

  // Of a lane's step. Where the hero channel does not collide, the kernel divides 0 by 0 once in 2^24 steps.
  [[nodiscard]] Real distance_of(int lane) const noexcept {
    const Real distance(lanes_.distance[lane]);
    return distance >= 0 ? distance : std::numeric_limits<Real>::infinity();
  }

  // The first part of a long step is often in balls, and all of some.
  [[nodiscard]] LaneRay ray_of(int lane) noexcept {
    const Vec3 p(position(lane));
    const Vec3 d = direction(lane);
    const Real distance = distance_of(lane);
    const EmptyBalls* balls = model_.region.balls;
    Real clear = 0;
    if (balls && distance * Real(balls->cells_per_unit) > 1)
      clear = balls->clear_length(ball_of(lanes_, lane), position(lane), glm::vec3(d), distance);
    clear_[lane] = clear;
    return {lane, p + clear * d, d, distance - clear};
  }

  [[nodiscard]] Crossing finish_ray(int lane, const Walker& walker) noexcept {
    const Real distance = distance_of(lane);
    if constexpr (kTogether) {
      if (clear_[lane] == distance)
        return {CrossingKind::none, distance, walker.position + distance * walker.direction, {}, {}};
      Crossing crossing = world_.finish_crossing(begun_[lane]);
      crossing.distance += clear_[lane];
      return crossing;
    } else {
      return begun_[lane];
    }
  }

  void see_to(int lane) {
    const auto state = static_cast<LaneState>(lanes_.state[lane]);
    if constexpr (kTallies) {
      client_.tally(lane, Real(lanes_.path[lane]), Real(lanes_.absorbed[lane]));
      lanes_.path[lane] = lanes_.absorbed[lane] = 0;
    }
    Walker walker = walker_in(lane);
    Random random = random_of(lanes_, lane);
    if (state == LaneState::absorbed) return end(lane, {WalkEnd::absorbed, {}}, walker, random);
    if (state == LaneState::crossing && !cross(lane, walker, random)) return;
    if (model_.rests_at_collisions) client_.collided(lane, walker, random);
    put(lane, walker, random, true);
  }

  // Ends a step that needed a ray; true when it ended in a collision that the walk survived.
  [[nodiscard]] bool cross(int lane, Walker& walker, Random& random) {
    const Crossing crossing = finish_ray(lane, walker);
    if constexpr (kTallies) {
      const Real carried = walker.weight.carried().x;
      const bool stays = crossing.kind == CrossingKind::none;
      if (crossing.kind != CrossingKind::leaked)
        client_.tally(lane, carried * crossing.distance,
                      stays ? carried * (1 - model_.medium.albedo.x) : Real(0));
    }
    if (crossing.kind != CrossingKind::none) {
      walker.weight.pass(model_.medium, crossing.distance);
      if (crossing.kind == CrossingKind::exit) walker.position = crossing.point;
      const bool exited = crossing.kind == CrossingKind::exit;
      end(lane, {exited ? WalkEnd::exited : WalkEnd::leaked, crossing}, walker, random);
      return false;
    }
    walker.position = crossing.point;
    walker.weight.collide(model_.medium, crossing.distance);
    walker.weight.albedo *= model_.medium.albedo;
    if (!walker.weight.survives_roulette(random, kRouletteThreshold)) {
      end(lane, {WalkEnd::absorbed, crossing}, walker, random);
      return false;
    }
    ++walker.weight.order;
    return true;
  }

  void end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    if (client_.end(lane, result, walker, random)) {
      put(lane, walker, random, false);
      return;
    }
    lanes_.state[lane] = static_cast<std::uint32_t>(LaneState::empty);
    --in_use_;
  }

  InstructionSet set_;
  const W& world_;
  const LaneModel& model_;
  C& client_;
  Lanes lanes_{};
  Put put_[kLanes] = {};
  int in_use_ = 0;
  static auto begun_kind() {
    if constexpr (kTogether)
      return typename W::Begun{};
    else
      return Crossing{};
  }
  decltype(begun_kind()) begun_[kLanes];
  Real clear_[kLanes] = {};  // of each crossing lane's step, the part that balls answer for
  int resting_[kLanes + 1] = {};
  int resting_count_ = 0;
  int fresh_[kLanes] = {};  // lanes that have been put and have no ball yet
  int fresh_count_ = 0;
  LaneCounters counters_;
};

}  // namespace meander
