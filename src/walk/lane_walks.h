// Runs walks in lanes through one body: the vector code advances them, scalar code sees to the lanes that
// rest.
#pragma once

#include <span>
#include <utility>

#include "walk/lane_rays.h"

namespace meander {

/// What gives a batch its walks and takes them back.
/// start(lane, walker, random): sets up the first walk of a lane, or says false when there is none left.
/// end(lane, result, walker, random): a walk of the lane has ended; true when another (the same one, sent
/// back inside, or a new one) has been set up in its place. collided(lane, clearance, walker, random): see
/// WalkEvents::scattered; the surface is at least `clearance` (scene units, 0 where nothing is known) away,
/// and the random numbers it draws are the walk's. tally(lane, path, absorbed), which a client may have
/// besides: what the walk has flown, times its weight, and left behind, of the first channel, since the last
/// call.
template <class C>
concept LaneClient = requires(C& client, int lane, const WalkResult& result, Walker& walker, Random& random) {
  { client.start(lane, walker, random) } -> std::same_as<bool>;
  { client.end(lane, result, walker, random) } -> std::same_as<bool>;
  client.collided(lane, Real(0), walker, random);
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
      : set_(set), world_(world), model_(model), client_(client) {
    resting_.wants_rays = kTogether;
  }

  LaneWalks(InstructionSet, const W&&, const LaneModel&, C&) = delete;  // it keeps a reference

  /// Runs until the client has no walk left; false when it said stop, which is asked whenever rays are
  /// traced, and every kStopInterval steps at least. Errors: whatever the client throws.
  [[nodiscard]] bool run() {
    for (int lane = 0; lane < kLanes; ++lane) {
      seat_[lane] = lane;
      lanes_.state[lane] = static_cast<std::uint32_t>(LaneState::empty);
      Walker walker;
      Random random({1, 0, 0, 0});
      if (client_.start(lane, walker, random)) set_out(lane, walker, random);
    }
    give_balls();
    while (in_use_ > 0) {
      if (client_.stop()) return false;
      close_ranks();
      advance_lanes(set_, model_, lanes_, ranks_, ranks_ - in_use_ + std::min(kRestingLanes, in_use_));
      find_resting(set_, model_, lanes_, resting_);
      give_balls_where_collided();
      if constexpr (kTogether)
        begin_rays();
      else
        cross_together();
      for (int i = 0; i < resting_.count; ++i) see_to(static_cast<int>(resting_.lane[i]));
      give_balls();
    }
    return true;
  }

  [[nodiscard]] const LaneCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr bool kTallies = requires(C & client) { client.tally(0, 0.0, 0.0); };

  // Of a walk's weight, as it was put into its lane.
  struct Put {
    Rgb ratio{1};
    Rgb since{1};
    std::uint32_t order = 0;
    int hero = 0;
  };

  // What a lane's walk has flown and left behind before the lane's own sums began.
  struct Gathered {
    double length = 0;
    double path = 0;
    double absorbed = 0;
  };

  void gather(int lane) noexcept {
    Gathered& sum = gathered_[lane];
    sum.length += double{std::exchange(lanes_.length[lane], 0.0f)};
    sum.path += double{std::exchange(lanes_.path[lane], 0.0f)};
    sum.absorbed += double{std::exchange(lanes_.absorbed[lane], 0.0f)};
  }

  void put(int lane, const Walker& walker, const Random& random) noexcept {
    gathered_[lane].length = walker.weight.length;
    put_walker(lanes_, lane, walker, random, model_.medium.sigma_t[walker.weight.hero]);
    put_[lane] = {walker.weight.ratio, walker.weight.since, walker.weight.order, walker.weight.hero};
  }

  // Moves the walks that are left, once no others come, into as few vectors as hold them.
  void close_ranks() noexcept {
    constexpr int kRank = 16;  // lanes of the widest vectors
    if (in_use_ + kRank > ranks_) return;
    const auto is_empty = [&](int lane) {
      return lanes_.state[lane] == static_cast<std::uint32_t>(LaneState::empty);
    };
    for (int from = in_use_, to = 0; from < ranks_; ++from) {
      if (is_empty(from)) continue;
      while (!is_empty(to)) ++to;
      move_walk(lanes_, from, to);
      put_[to] = put_[from];
      gathered_[to] = gathered_[from];
      std::swap(seat_[to], seat_[from]);
    }
    ranks_ = (in_use_ + kRank - 1) / kRank * kRank;
  }

  // A new walk, or one that was sent back inside.
  void set_out(int lane, const Walker& walker, const Random& random) noexcept {
    if (lanes_.state[lane] == static_cast<std::uint32_t>(LaneState::empty)) ++in_use_;
    put(lane, walker, random);
    fresh_[fresh_count_++] = static_cast<std::uint32_t>(lane);
  }

  // Collisions want the best ball that is known about their place, not the one that they came in.
  void give_balls_where_collided() noexcept {
    if (!model_.rests_at_collisions) return;
    for (int i = 0; i < resting_.count; ++i) {
      const std::uint32_t lane = resting_.lane[i];
      fresh_[fresh_count_] = lane;
      fresh_count_ += lanes_.state[lane] == static_cast<std::uint32_t>(LaneState::collided);
    }
    give_balls();
  }

  // After a collision: the lane keeps its ball, which the walk is in still.
  void go_on(int lane, const Walker& walker, const Random& random) noexcept {
    const float radius2 = lanes_.ball_radius2[lane];
    put(lane, walker, random);
    lanes_.ball_radius2[lane] = radius2;
    lanes_.due[lane] = static_cast<std::uint32_t>(LaneDue::scattering);
  }

  // How far away from a lane's walk the surface is, at least.
  [[nodiscard]] Real clearance(int lane) const noexcept {
    if (!model_.region.balls) return model_.region.clearance(position(lane));
    const Vec3 center(lanes_.ball_center[0][lane], lanes_.ball_center[1][lane], lanes_.ball_center[2][lane]);
    const Real square(lanes_.ball_radius2[lane]);
    return square > 0 ? std::max(std::sqrt(square) - glm::distance(center, position(lane)), Real(0)) : 0;
  }

  // The walk of a lane. What it came with from before the body is folded in at its first collision; until
  // then it stands.
  [[nodiscard]] Walker walker_in(int lane) const noexcept {
    Walker walker = walker_of(lanes_, lane);
    walker.weight.length += gathered_[lane].length;
    const Put& put = put_[lane];
    walker.weight.hero = put.hero;
    if (walker.weight.order == put.order) {
      walker.weight.ratio = put.ratio;
      walker.weight.since = put.since;
    }
    return walker;
  }

  // Gives the lanes that have been put their balls.
  void give_balls() noexcept {
    const auto count = static_cast<std::size_t>(std::exchange(fresh_count_, 0));
    if (const EmptyBalls* balls = model_.region.balls)
      meander::give_balls(set_, *balls, lanes_, std::span(fresh_).first(count));
  }

  [[nodiscard]] Vec3 position(int lane) const noexcept {
    return {lanes_.position[0][lane], lanes_.position[1][lane], lanes_.position[2][lane]};
  }
  [[nodiscard]] Vec3 direction(int lane) const noexcept {
    return {lanes_.direction[0][lane], lanes_.direction[1][lane], lanes_.direction[2][lane]};
  }

  // Rays are begun for all resting lanes together where the world can, so that one does not wait for what
  // another waits for.
  static constexpr bool kTogether = requires(const W& world, const Steps& steps) {
    world.begin_crossings(steps, std::span<typename W::Begun>());
  };

  void begin_rays() noexcept {
    counters_.rays += static_cast<std::uint64_t>(resting_.ray_count);
    world_.begin_crossings(resting_.rays,
                           std::span(begun_).first(static_cast<std::size_t>(resting_.ray_count)));
  }

  // Steps that leave an exact body, one after another, so that the roots and divisions of one do not wait for
  // those of another.
  void cross_together() noexcept {
    for (int i = 0; i < resting_.count; ++i) {
      const auto lane = static_cast<int>(resting_.lane[i]);
      if (lanes_.state[lane] != static_cast<std::uint32_t>(LaneState::crossing)) continue;
      begun_[lane] = world_.first_crossing(position(lane), direction(lane), Real(lanes_.distance[lane]));
      ++counters_.rays;
    }
  }

  [[nodiscard]] Crossing finish_ray(int lane) noexcept {
    const Real distance(lanes_.distance[lane]);
    if constexpr (kTogether) {
      const Real clear(resting_.clear[lane]);
      if (clear == distance)
        return {CrossingKind::none, distance, position(lane) + distance * direction(lane), {}, {}};
      Crossing crossing = world_.finish_crossing(begun_[resting_.ray[lane]]);
      crossing.distance += clear;
      return crossing;
    } else {
      return begun_[lane];
    }
  }

  void see_to(int lane) {
    const auto state = static_cast<LaneState>(lanes_.state[lane]);
    // By its own steps, so that its sums are rounded alike in whatever company it walks.
    if (lanes_.steps[lane] % kSumInterval == 0) gather(lane);
    if (state == LaneState::summed) {
      lanes_.state[lane] = static_cast<std::uint32_t>(LaneState::running);
      return;
    }
    WalkResult result{WalkEnd::absorbed, {}};
    if (state == LaneState::crossing) {
      result.crossing = finish_ray(lane);
      if (result.crossing.kind == CrossingKind::none) {
        land(lanes_, lane, result.crossing.point, result.crossing.distance);
        fresh_[fresh_count_++] = static_cast<std::uint32_t>(lane);
        return;
      }
    }
    if constexpr (kTallies) {
      Gathered& sum = gathered_[lane];
      client_.tally(seat_[lane], sum.path + double{lanes_.path[lane]},
                    sum.absorbed + double{lanes_.absorbed[lane]});
      sum.path = sum.absorbed = 0;
      lanes_.path[lane] = lanes_.absorbed[lane] = 0;
    }
    Walker walker = walker_in(lane);
    Random random = random_of(lanes_, lane);
    if (state == LaneState::collided) {
      client_.collided(seat_[lane], clearance(lane), walker, random);
      go_on(lane, walker, random);
      return;
    }
    if (state == LaneState::crossing) leave(lane, result, walker);
    end(lane, result, walker, random);
  }

  // Ends a walk that has crossed the surface, or leaked.
  void leave(int lane, WalkResult& result, Walker& walker) {
    const Crossing& crossing = result.crossing;
    const bool exits = crossing.kind == CrossingKind::exit;
    if constexpr (kTallies)
      if (exits) client_.tally(seat_[lane], double{walker.weight.carried().x * crossing.distance}, 0.0);
    walker.weight.pass(model_.medium, crossing.distance);
    if (exits) walker.position = crossing.point;
    result.end = exits ? WalkEnd::exited : WalkEnd::leaked;
  }

  void end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    if (client_.end(seat_[lane], result, walker, random)) {
      set_out(lane, walker, random);
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
  Gathered gathered_[kLanes];
  int seat_[kLanes];    // the lane that the client knows a lane's walk by
  int ranks_ = kLanes;  // lanes beyond are empty for good
  int in_use_ = 0;
  static auto begun_kind() {
    if constexpr (kTogether)
      return typename W::Begun{};
    else
      return Crossing{};
  }
  decltype(begun_kind()) begun_[kLanes];  // by ray, or by lane where each is found alone
  RestingLanes resting_;
  std::uint32_t fresh_[kLanes + 16] = {};  // lanes that have been put and have no ball yet
  int fresh_count_ = 0;
  LaneCounters counters_;
};

}  // namespace meander
