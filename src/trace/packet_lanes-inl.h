// Vectors over the triangles of a packet, one instruction set an inclusion (Highway's way: no include guard
// of the usual kind). No fused operations: every instruction set gives the same bits.
#if defined(MEANDER_PACKET_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef MEANDER_PACKET_LANES_INL_H_
#undef MEANDER_PACKET_LANES_INL_H_
#else
#define MEANDER_PACKET_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "trace/packets.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::CappedTag<float, kPacket>;
using VF = hn::Vec<F>;
using MF = hn::Mask<F>;

template <class V>
struct Vec3Of {
  V x, y, z;
};
using V3 = Vec3Of<VF>;

template <class V>
HWY_INLINE Vec3Of<V> operator-(const Vec3Of<V>& a, const Vec3Of<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3Of<V> operator+(const Vec3Of<V>& a, const Vec3Of<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator*(VF a, const V3& b) { return {hn::Mul(a, b.x), hn::Mul(a, b.y), hn::Mul(a, b.z)}; }
template <class V>
HWY_INLINE V dot(const Vec3Of<V>& a, const Vec3Of<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class V>
HWY_INLINE Vec3Of<V> cross(const Vec3Of<V>& a, const Vec3Of<V>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 set(const glm::vec3& v) { return {hn::Set(F(), v.x), hn::Set(F(), v.y), hn::Set(F(), v.z)}; }
HWY_INLINE V3 load(const float (&rows)[3][kPacket], std::size_t at) {
  return {hn::Load(F(), rows[0] + at), hn::Load(F(), rows[1] + at), hn::Load(F(), rows[2] + at)};
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
