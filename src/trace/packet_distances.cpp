#include "trace/packet_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

// The instruction sets this file is compiled for, once each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/packet_distances.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "trace/packet_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

constexpr std::size_t kDeepest = 96;  // of the stack: 7 a level, and a level divides by 4 at least

struct Pending {
  float distance2;
  std::int32_t child;
};

// The children of a node that are nearer than `limit2`, the farthest first.
HWY_INLINE std::size_t nearer_children(const PacketNode& node, const V3& p, float limit2, Pending* pending) {
  alignas(32) float distance2[kPacket];
  for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F())) {
    const V3 low = load(node.low, at) - p;
    const V3 high = p - load(node.high, at);
    const VF zero = hn::Zero(F());
    const V3 out{hn::Max(zero, hn::Max(low.x, high.x)), hn::Max(zero, hn::Max(low.y, high.y)),
                 hn::Max(zero, hn::Max(low.z, high.z))};
    hn::Store(dot(out, out), F(), distance2 + at);
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (!(distance2[i] < limit2)) continue;
    std::size_t place = count++;
    for (; place > 0 && pending[place - 1].distance2 < distance2[i]; --place)
      pending[place] = pending[place - 1];
    pending[place] = {distance2[i], node.child[i]};
  }
  return count;
}

// f(packet) for the packets nearer than the square root of limit2, which f may lower, nearly by distance.
template <class Function>
HWY_INLINE void visit(const Packets& packets, const glm::vec3& p, float& limit2, const Function& f) {
  const V3 place = set(p);
  Pending stack[kDeepest];
  std::size_t count = nearer_children(packets.nodes[0], place, limit2, stack);
  while (count > 0) {
    const Pending next = stack[--count];
    if (!(next.distance2 < limit2)) continue;
    if (next.child < 0)
      f(static_cast<std::uint32_t>(~next.child));
    else
      count +=
          nearer_children(packets.nodes[static_cast<std::size_t>(next.child)], place, limit2, stack + count);
  }
}

struct Foot {
  V3 to;  // from the place looked for
  VF distance2;
};

HWY_INLINE Foot nearer(const Foot& a, const Foot& b, MF allowed) {
  const MF better = hn::And(allowed, hn::Lt(b.distance2, a.distance2));
  return {{hn::IfThenElse(better, b.to.x, a.to.x), hn::IfThenElse(better, b.to.y, a.to.y),
           hn::IfThenElse(better, b.to.z, a.to.z)},
          hn::IfThenElse(better, b.distance2, a.distance2)};
}

// The nearest point of an edge from the origin.
HWY_INLINE Foot on_edge(const V3& from, const V3& edge) {
  const VF length2 = dot(edge, edge);
  const VF along = hn::Neg(dot(from, edge));
  const VF part = hn::Div(along, hn::Max(length2, hn::Set(F(), std::numeric_limits<float>::min())));
  const V3 to = from + hn::Min(hn::Max(part, hn::Zero(F())), hn::Set(F(), 1)) * edge;
  return {to, dot(to, to)};
}

// The nearest of its edges' points and, where that is inside, the foot of the perpendicular. Edges always
// count, so that a needle's normal may be as bad as it likes.
HWY_INLINE Foot nearest_in(const Packet& packet, std::size_t at, const V3& p) {
  const V3 a = load(packet.corner[0], at) - p;
  const V3 b = load(packet.corner[1], at) - p;
  const V3 c = load(packet.corner[2], at) - p;
  const V3 ab = b - a;
  const V3 bc = c - b;
  const V3 ca = a - c;
  const MF always = hn::Ge(hn::Zero(F()), hn::Zero(F()));
  const Foot edges = nearer(nearer(on_edge(a, ab), on_edge(b, bc), always), on_edge(c, ca), always);
  const V3 normal = cross(ca, ab);
  const VF normal2 = dot(normal, normal);
  // The origin's foot is on the inner side of an edge when the corner is on the outer side of it.
  const VF zero = hn::Zero(F());
  MF inside = hn::Gt(normal2, zero);
  inside = hn::And(inside, hn::Le(dot(cross(ab, a), normal), zero));
  inside = hn::And(inside, hn::Le(dot(cross(bc, b), normal), zero));
  inside = hn::And(inside, hn::Le(dot(cross(ca, c), normal), zero));
  const V3 to = hn::Div(dot(a, normal), normal2) * normal;
  return nearer(edges, {to, dot(to, to)}, inside);
}

NearestPoint nearest(const Packets& packets, const glm::vec3& p, float limit) {
  NearestPoint found;
  float limit2 = limit * limit;
  const V3 place = set(p);
  visit(packets, p, limit2, [&](std::uint32_t number) HWY_ATTR {
    const Packet& packet = packets.packets[number];
    ++found.looked;
    for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F())) {
      const Foot foot = nearest_in(packet, at, place);
      if (hn::AllFalse(F(), hn::Lt(foot.distance2, hn::Set(F(), limit2)))) continue;
      alignas(32) float rows[4][kPacket];
      hn::Store(foot.distance2, F(), rows[3]);
      hn::Store(foot.to.x, F(), rows[0]);
      hn::Store(foot.to.y, F(), rows[1]);
      hn::Store(foot.to.z, F(), rows[2]);
      for (std::size_t i = 0; i < hn::Lanes(F()); ++i) {
        if (!(rows[3][i] < limit2)) continue;
        limit2 = rows[3][i];
        found.point = p + glm::vec3(rows[0][i], rows[1][i], rows[2][i]);
        found.triangle = packet.triangle[at + i];
      }
    }
  });
  found.distance = std::sqrt(limit2);
  return found;
}

constexpr float kSafety = 1 + 0x1p-12f;  // on what is compared, for its rounding

// The convex hull of two balls: along the axis between their centres one ball grows into the other.
class Hull {
 public:
  Hull(const Ball& from, const Ball& to)
      : from_(from), axis_(to.center - from.center), taper_(to.radius - from.radius) {
    length2_ = std::max(glm::dot(axis_, axis_), std::numeric_limits<float>::min());
    bound_ = std::max(std::sqrt(length2_) + from.radius, to.radius) * kSafety;
    // A place sees the hull's side at right angles, which leans when the balls differ. Where one ball holds
    // the other it is alone.
    const float side2 = length2_ - taper_ * taper_;
    lean_ = side2 > 0 ? taper_ / std::sqrt(side2 * length2_) : 0;
    push_ = side2 > 0 ? 0 : std::copysign(1e9f, taper_);
  }

  // Of a ball about the second one's centre that holds it all.
  [[nodiscard]] float bound() const { return bound_; }

  // Which balls reach into it, or nearly.
  [[nodiscard]] HWY_INLINE MF meets(const V3& center, VF radius) const {
    const V3 axis = set(axis_);
    const V3 from = center - set(from_.center);
    const VF along = hn::Div(dot(from, axis), hn::Set(F(), length2_));
    const V3 aside = from - along * axis;
    const VF shift = hn::Add(hn::Mul(hn::Sqrt(dot(aside, aside)), hn::Set(F(), lean_)), hn::Set(F(), push_));
    const VF part = hn::Min(hn::Max(hn::Add(along, shift), hn::Zero(F())), hn::Set(F(), 1));
    const V3 apart = from - part * axis;
    const VF own = hn::Add(hn::Set(F(), from_.radius), hn::Mul(part, hn::Set(F(), taper_)));
    const VF reach = hn::Mul(hn::Add(radius, own), hn::Set(F(), kSafety));
    return hn::Le(dot(apart, apart), hn::Mul(reach, reach));
  }

 private:
  Ball from_;
  glm::vec3 axis_;
  float taper_;
  float length2_;
  float bound_;
  float lean_;
  float push_;
};

// The depth beneath a packet's planes where its triangles meet the hull; `enough` where they do not.
HWY_INLINE float depth_in(const Packets& packets, std::uint32_t number, const Hull& hull,
                          const glm::vec3& place, float enough) {
  const Packet& packet = packets.packets[number];
  const PacketPlanes& planes = packets.planes[number];
  VF least = hn::Set(F(), enough);
  for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F())) {
    const V3 a = load(packet.corner[0], at);
    const V3 b = load(packet.corner[1], at);
    const V3 c = load(packet.corner[2], at);
    const V3 middle = hn::Set(F(), 1.0f / 3) * (a + b + c);
    const V3 to_a = a - middle;
    const V3 to_b = b - middle;
    const V3 to_c = c - middle;
    const VF radius2 = hn::Max(dot(to_a, to_a), hn::Max(dot(to_b, to_b), dot(to_c, to_c)));
    const MF meets = hull.meets(middle, hn::Add(hn::Sqrt(radius2), hn::Set(F(), kPlaneError)));
    const V3 normal = load(planes.normal, at);
    const VF depth = hn::Sub(hn::Load(F(), planes.offset + at), dot(normal, set(place)));
    const MF known = hn::Gt(dot(normal, normal), hn::Zero(F()));
    const VF met = hn::IfThenElse(known, depth, hn::Neg(hn::Inf(F())));
    least = hn::IfThenElse(meets, hn::Min(least, met), least);
  }
  return hn::GetLane(hn::MinOfLanes(F(), least));
}

float depth(const Packets& packets, const Ball& from, const Ball& to, float enough) {
  const Hull hull(from, to);
  float limit2 = hull.bound() * hull.bound();
  visit(packets, to.center, limit2, [&](std::uint32_t number) HWY_ATTR {
    enough = std::min(enough, depth_in(packets, number, hull, to.center, enough));
    if (!(enough > 0)) limit2 = 0;
  });
  return enough;
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

HWY_EXPORT(nearest);
HWY_EXPORT(depth);

NearestPoint find_nearest(const Packets& packets, const glm::vec3& p, float limit) noexcept {
  return HWY_DYNAMIC_DISPATCH(nearest)(packets, p, limit);
}

float find_depth(const Packets& packets, const Ball& from, const Ball& to, float enough) noexcept {
  return HWY_DYNAMIC_DISPATCH(depth)(packets, from, to, enough);
}

}  // namespace meander
#endif
