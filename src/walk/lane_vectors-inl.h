// Vectors over lanes, one instruction set an inclusion (Highway's way: no include guard of the usual kind).
#if defined(MEANDER_LANE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef MEANDER_LANE_VECTORS_INL_H_
#undef MEANDER_LANE_VECTORS_INL_H_
#else
#define MEANDER_LANE_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include "walk/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::ScalableTag<float>;
using U = hn::ScalableTag<std::uint32_t>;
using VF = hn::Vec<F>;
using VU = hn::Vec<U>;
using I = hn::RebindToSigned<F>;
using MF = hn::Mask<F>;

struct V3 {
  VF x, y, z;
};

HWY_INLINE VF set(float value) { return hn::Set(F(), value); }
HWY_INLINE VF dot(const V3& a, const V3& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE V3 load(const Lanes::Row (&rows)[3], int at) {
  return {hn::Load(F(), rows[0] + at), hn::Load(F(), rows[1] + at), hn::Load(F(), rows[2] + at)};
}
HWY_INLINE void store(const V3& v, Lanes::Row (&rows)[3], int at) {
  hn::Store(v.x, F(), rows[0] + at);
  hn::Store(v.y, F(), rows[1] + at);
  hn::Store(v.z, F(), rows[2] + at);
}
// Rows of no alignment of their own.
template <class Rows>
HWY_INLINE void store_chosen(const V3& v, MF mask, Rows& rows, int at) {
  hn::StoreU(hn::Compress(v.x, mask), F(), rows[0] + at);
  hn::StoreU(hn::Compress(v.y, mask), F(), rows[1] + at);
  hn::StoreU(hn::Compress(v.z, mask), F(), rows[2] + at);
}
HWY_INLINE V3 choose(MF mask, const V3& yes, const V3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

// A ball, a lane.
struct Balls {
  V3 center;
  VF radius2;

  [[nodiscard]] HWY_INLINE MF hold(const V3& p) const {
    const V3 d{hn::Sub(p.x, center.x), hn::Sub(p.y, center.y), hn::Sub(p.z, center.z)};
    return hn::Le(dot(d, d), radius2);
  }
};

// The numbers of the balls of the cells of places; 0 where the mask is not.
HWY_INLINE hn::Vec<I> balls_at(const EmptyBalls& field, const V3& place, MF mask) {
  const I d;
  const auto cell = [&](VF coordinate, int axis) HWY_ATTR {
    const VF along = hn::Mul(hn::Sub(coordinate, set(field.low[axis])), set(field.cells_per_unit));
    const VF last = set(static_cast<float>(field.size[axis] - 1));
    return hn::ConvertTo(d, hn::Min(hn::Max(hn::Floor(along), set(0)), last));
  };
  auto index = hn::Mul(cell(place.z, 2), hn::Set(d, field.size.y));
  index = hn::Mul(hn::Add(index, cell(place.y, 1)), hn::Set(d, field.size.x));
  index = hn::Add(index, cell(place.x, 0));
  index = hn::IfThenElseZero(hn::RebindMask(d, mask), index);
  return hn::GatherIndex(d, reinterpret_cast<const std::int32_t*>(field.cells.data()), index);
}

HWY_INLINE Balls gather_balls(const EmptyBalls& field, hn::Vec<I> number) {
  const auto at = hn::ShiftLeft<2>(number);
  const float* balls = &field.balls[0].center.x;
  return {{hn::GatherIndex(F(), balls, at), hn::GatherIndex(F(), balls + 1, at),
           hn::GatherIndex(F(), balls + 2, at)},
          hn::GatherIndex(F(), balls + 3, at)};
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
