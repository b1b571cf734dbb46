#include "walk/lane_rays.h"

// The instruction sets this file is compiled for, once each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/lane_rays.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "walk/lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

using Room = float[kLanes + 16];  // a vector may be stored at the last lane

HWY_INLINE void store_chosen(VF v, MF mask, float* row) { hn::StoreU(hn::Compress(v, mask), F(), row); }
HWY_INLINE void store_chosen(VU v, MF mask, std::uint32_t* row) {
  hn::StoreU(hn::Compress(v, hn::RebindMask(U(), mask)), U(), row);
}
HWY_INLINE V3 load_rows(const Room (&rows)[3], int at) {
  return {hn::Load(F(), rows[0] + at), hn::Load(F(), rows[1] + at), hn::Load(F(), rows[2] + at)};
}
HWY_INLINE V3 along(const V3& p, VF length, const V3& d) {
  return {hn::MulAdd(length, d.x, p.x), hn::MulAdd(length, d.y, p.y), hn::MulAdd(length, d.z, p.z)};
}
HWY_INLINE MF promise(const Balls& balls, EmptyBall::Promise promise) {
  const auto bits = hn::And(hn::BitCast(U(), balls.radius2), hn::Set(U(), 3));
  const MF good = hn::Gt(balls.radius2, set(0));
  return hn::And(good, hn::RebindMask(F(), hn::Eq(bits, hn::Set(U(), promise))));
}

// The steps of the lanes that cross, gathered.
struct Crossings {
  alignas(64) Room from[3];
  alignas(64) Room direction[3];
  alignas(64) Room distance;
  alignas(64) Room center[3];
  alignas(64) Room radius2;
  alignas(64) std::uint32_t lane[kLanes + 16];
  int count = 0;

  HWY_INLINE void add(const Lanes& lanes, int at, MF crossing) {
    store_chosen(hn::Iota(U(), static_cast<std::uint32_t>(at)), crossing, lane + count);
    store_chosen(load(lanes.position, at), crossing, from, count);
    store_chosen(load(lanes.direction, at), crossing, direction, count);
    store_chosen(load(lanes.ball_center, at), crossing, center, count);
    store_chosen(hn::Load(F(), lanes.ball_radius2 + at), crossing, radius2 + count);
    store_chosen(hn::Load(F(), lanes.distance + at), crossing, distance + count);
    count += static_cast<int>(hn::CountTrue(F(), crossing));
  }
};

// How far along its step each of some crossings is clear: through its lane's ball, then from ball to ball.
HWY_INLINE VF clear_length(const EmptyBalls& field, const Crossings& crossings, int at) {
  constexpr int kBalls = 4;
  constexpr float kWithin = 1 - 0x1p-10f;  // of the way to a ball's far side
  const V3 p = load_rows(crossings.from, at);
  const V3 d = load_rows(crossings.direction, at);
  const VF distance = hn::Load(F(), crossings.distance + at);
  const MF real = hn::FirstN(F(), static_cast<std::size_t>(crossings.count - at));
  Balls balls{load_rows(crossings.center, at), hn::Load(F(), crossings.radius2 + at)};
  // Without a ball (a negative squared radius) rounding may find one all the same in a large body.
  MF open = hn::And(real, hn::Gt(balls.radius2, set(0)));
  open = hn::And(open, hn::Gt(hn::Mul(distance, set(field.cells_per_unit)), set(1)));
  VF clear = set(0);
  for (int i = 0; i < kBalls && !hn::AllFalse(F(), open); ++i) {
    const V3 place = along(p, clear, d);
    if (i > 0) balls = gather_balls(field, balls_at(field, place, open));
    const V3 to{hn::Sub(place.x, balls.center.x), hn::Sub(place.y, balls.center.y),
                hn::Sub(place.z, balls.center.z)};
    const VF near = hn::Neg(dot(to, d));
    const VF square = hn::Sub(hn::MulAdd(near, near, balls.radius2), dot(to, to));
    open = hn::And(open, hn::Gt(square, set(0)));
    if (i > 0) open = hn::And(open, balls.hold(place));
    const VF further = hn::Mul(hn::Add(near, hn::Sqrt(hn::Max(square, set(0)))), set(kWithin));
    open = hn::And(open, hn::Gt(further, set(0)));
    clear = hn::IfThenElse(open, hn::Min(hn::Add(clear, further), distance), clear);
    open = hn::And(open, hn::Lt(clear, distance));
  }
  return clear;
}

HWY_INLINE void make_rays(const EmptyBalls* field, const Crossings& crossings, RestingLanes& resting) {
  const int width = static_cast<int>(hn::Lanes(F()));
  alignas(64) std::uint32_t lane[kLanes + 16];
  int rays = 0;
  for (int at = 0; at < crossings.count; at += width) {
    const VF clear = field ? clear_length(*field, crossings, at) : set(0);
    const VF distance = hn::Load(F(), crossings.distance + at);
    const V3 d = load_rows(crossings.direction, at);
    const VF left = hn::Sub(distance, clear);
    const MF real = hn::FirstN(F(), static_cast<std::size_t>(crossings.count - at));
    const MF ray = hn::And(real, hn::Gt(left, set(0)));
    store_chosen(hn::Load(U(), crossings.lane + at), ray, lane + rays);
    store_chosen(along(load_rows(crossings.from, at), clear, d), ray, resting.rays.from, rays);
    store_chosen(d, ray, resting.rays.direction, rays);
    store_chosen(left, ray, resting.rays.distance + rays);
    rays += static_cast<int>(hn::CountTrue(F(), ray));
    alignas(64) float row[hn::MaxLanes(F())];
    hn::Store(clear, F(), row);
    for (int i = at; i < std::min(at + width, crossings.count); ++i)
      resting.clear[crossings.lane[i]] = row[i - at];
  }
  for (int i = 0; i < rays; ++i) resting.ray[lane[i]] = i;
  resting.ray_count = rays;
}

void find_resting(const LaneModel& model, const Lanes& lanes, RestingLanes& resting) {
  const int width = static_cast<int>(hn::Lanes(F()));
  Crossings crossings;
  resting.count = 0;
  for (int at = 0; at < kLanes; at += width) {
    const VU state = hn::Load(U(), lanes.state + at);
    const auto in = [&](LaneState s) HWY_ATTR {
      return hn::RebindMask(F(), hn::Eq(state, hn::Set(U(), static_cast<std::uint32_t>(s))));
    };
    const MF rests = hn::Not(hn::Or(in(LaneState::running), in(LaneState::empty)));
    store_chosen(hn::Iota(U(), static_cast<std::uint32_t>(at)), rests, resting.lane + resting.count);
    resting.count += static_cast<int>(hn::CountTrue(F(), rests));
    if (resting.wants_rays) crossings.add(lanes, at, in(LaneState::crossing));
  }
  if (resting.wants_rays) make_rays(model.region.balls, crossings, resting);
}

void give_balls(const EmptyBalls& field, Lanes& lanes, std::span<const std::uint32_t> to) {
  const auto count = static_cast<int>(to.size());
  for (int at = 0; at < count; at += static_cast<int>(hn::Lanes(F()))) {
    const MF real = hn::FirstN(F(), static_cast<std::size_t>(count - at));
    const auto lane = hn::IfThenElseZero(hn::RebindMask(U(), real), hn::LoadU(U(), to.data() + at));
    const auto of = hn::BitCast(I(), lane);
    const V3 p{hn::GatherIndex(F(), lanes.position[0], of), hn::GatherIndex(F(), lanes.position[1], of),
               hn::GatherIndex(F(), lanes.position[2], of)};
    const auto number = balls_at(field, p, real);
    Balls balls = gather_balls(field, number);
    const MF good = hn::Or(promise(balls, EmptyBall::facing), balls.hold(p));
    const MF next = hn::AndNot(good, promise(balls, EmptyBall::followed));
    const MF none = hn::Not(hn::Or(good, next));
    if (!hn::AllFalse(F(), next)) {
      const auto behind = hn::Add(number, hn::Set(I(), 1));
      const Balls facing = gather_balls(field, hn::IfThenElse(hn::RebindMask(I(), next), behind, number));
      balls = {choose(next, facing.center, balls.center),
               hn::IfThenElse(next, facing.radius2, balls.radius2)};
    }
    alignas(64) float rows[4][hn::MaxLanes(F())];
    hn::Store(balls.center.x, F(), rows[0]);
    hn::Store(balls.center.y, F(), rows[1]);
    hn::Store(balls.center.z, F(), rows[2]);
    hn::Store(hn::IfThenElse(none, set(-1), balls.radius2), F(), rows[3]);
    for (int i = at; i < std::min(at + static_cast<int>(hn::Lanes(F())), count); ++i) {
      for (int axis = 0; axis < 3; ++axis) lanes.ball_center[axis][to[i]] = rows[axis][i - at];
      lanes.ball_radius2[to[i]] = rows[3][i - at];
    }
  }
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

void find_resting(InstructionSet set, const LaneModel& model, const Lanes& lanes,
                  RestingLanes& resting) noexcept {
  switch (set) {
    case InstructionSet::avx512:
      return N_AVX3::find_resting(model, lanes, resting);
    case InstructionSet::avx2:
      return N_AVX2::find_resting(model, lanes, resting);
    case InstructionSet::sse4:
      return N_SSE4::find_resting(model, lanes, resting);
    case InstructionSet::baseline:
      return HWY_STATIC_DISPATCH(find_resting)(model, lanes, resting);
  }
}

void give_balls(InstructionSet set, const EmptyBalls& field, Lanes& lanes,
                std::span<const std::uint32_t> to) noexcept {
  switch (set) {
    case InstructionSet::avx512:
      return N_AVX3::give_balls(field, lanes, to);
    case InstructionSet::avx2:
      return N_AVX2::give_balls(field, lanes, to);
    case InstructionSet::sse4:
      return N_SSE4::give_balls(field, lanes, to);
    case InstructionSet::baseline:
      return HWY_STATIC_DISPATCH(give_balls)(field, lanes, to);
  }
}

}  // namespace meander
#endif
