// Which steps of lanes cross nothing, see SafeRegion.
#if defined(MEANDER_LANE_REGIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef MEANDER_LANE_REGIONS_INL_H_
#undef MEANDER_LANE_REGIONS_INL_H_
#else
#define MEANDER_LANE_REGIONS_INL_H_
#endif

#include <utility>

#include "walk/lane_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// Which steps from p to q cross nothing, see SafeRegion; a ball that is found to hold both becomes the
// lane's.
template <SafeRegion::Kind kKind>
class Region;

template <>
class Region<SafeRegion::Kind::box> {
 public:
  explicit HWY_INLINE Region(const SafeRegion& region) : region_(region) {}

  HWY_INLINE MF holds(MF running, const V3&, const V3& q, Lanes&, int) const {
    MF inside = running;
    for (int i = 0; i < 3; ++i) {
      const VF local = dot({set(region_.map[i][0]), set(region_.map[i][1]), set(region_.map[i][2])}, q);
      inside =
          hn::And(inside, hn::And(hn::Ge(local, set(region_.low[i])), hn::Le(local, set(region_.high[i]))));
    }
    return inside;
  }
  HWY_INLINE void settle(Lanes&) const {}

 private:
  const SafeRegion& region_;
};

template <>
class Region<SafeRegion::Kind::ellipsoid> {
 public:
  explicit HWY_INLINE Region(const SafeRegion& region) : region_(region) {}

  HWY_INLINE MF holds(MF running, const V3&, const V3& q, Lanes&, int) const {
    VF sum = set(0);
    for (int i = 0; i < 3; ++i) {
      const VF local = dot({set(region_.map[i][0]), set(region_.map[i][1]), set(region_.map[i][2])}, q);
      sum = hn::MulAdd(local, local, sum);
    }
    return hn::And(running, hn::Le(sum, set(1)));
  }
  HWY_INLINE void settle(Lanes&) const {}

 private:
  const SafeRegion& region_;
};

template <>
class Region<SafeRegion::Kind::balls> {
 public:
  explicit HWY_INLINE Region(const SafeRegion& region) : region_(region) {}

  HWY_INLINE MF holds(MF running, const V3& p, const V3& q, Lanes& lanes, int at) {
    const Balls own{load(lanes.ball_center, at), hn::Load(F(), lanes.ball_radius2 + at)};
    const MF held = hn::And(running, own.hold(q));
    const MF lost = hn::AndNot(held, running);
    const VU lane = hn::Iota(U(), static_cast<std::uint32_t>(at));
    hn::StoreU(hn::Compress(lane, hn::RebindMask(U(), lost)), U(), lost_.lane + lost_.count);
    store_chosen(p, lost, lost_.from, lost_.count);
    store_chosen(q, lost, lost_.to, lost_.count);
    lost_.count += static_cast<int>(hn::CountTrue(F(), lost));
    return held;
  }

  // Looks for the balls of the cells in which the steps end that left their lanes' balls. Few do: they are
  // gathered from all vectors. The lanes whose steps are in them have landed.
  HWY_INLINE void settle(Lanes& lanes) {
    const int count = std::exchange(lost_.count, 0);
    for (int at = 0; at < count; at += static_cast<int>(hn::Lanes(F()))) {
      const MF real = hn::FirstN(F(), static_cast<std::size_t>(count - at));
      look_up(real, at, lanes);
    }
  }

 private:
  // The steps of a sweep that left their lanes' balls.
  struct Lost {
    static constexpr int kRoom = kLanes + 16;
    alignas(64) float from[3][kRoom];
    alignas(64) float to[3][kRoom];
    alignas(64) std::uint32_t lane[kRoom];
    int count = 0;
  };

  HWY_INLINE void look_up(MF real, int at, Lanes& lanes) {
    const V3 p{hn::Load(F(), lost_.from[0] + at), hn::Load(F(), lost_.from[1] + at),
               hn::Load(F(), lost_.from[2] + at)};
    const V3 q{hn::Load(F(), lost_.to[0] + at), hn::Load(F(), lost_.to[1] + at),
               hn::Load(F(), lost_.to[2] + at)};
    const Balls balls = gather_balls(*region_.balls, balls_at(*region_.balls, q, real));
    const MF found = hn::And(real, hn::And(balls.hold(p), balls.hold(q)));
    if (hn::AllFalse(F(), found)) return;
    alignas(64) float center[3][hn::MaxLanes(F())];
    alignas(64) float to[3][hn::MaxLanes(F())];
    alignas(64) float radius2[hn::MaxLanes(F())];
    alignas(64) std::uint32_t lane[hn::MaxLanes(F())];
    hn::StoreU(hn::Compress(hn::Load(U(), lost_.lane + at), hn::RebindMask(U(), found)), U(), lane);
    store_chosen(balls.center, found, center, 0);
    store_chosen(q, found, to, 0);
    hn::StoreU(hn::Compress(balls.radius2, found), F(), radius2);
    for (std::size_t i = 0, count = hn::CountTrue(F(), found); i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        lanes.ball_center[axis][lane[i]] = center[axis][i];
        lanes.position[axis][lane[i]] = to[axis][i];
      }
      lanes.ball_radius2[lane[i]] = radius2[i];
      lanes.due[lane[i]] = static_cast<std::uint32_t>(LaneDue::collision);
      lanes.state[lane[i]] = static_cast<std::uint32_t>(LaneState::running);
    }
  }

  const SafeRegion& region_;
  Lost lost_;
};

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
