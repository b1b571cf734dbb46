// What rays ask of packets, one instruction set an inclusion, and their way through the cells.
#if defined(MEANDER_PACKET_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef MEANDER_PACKET_RAYS_INL_H_
#undef MEANDER_PACKET_RAYS_INL_H_
#else
#define MEANDER_PACKET_RAYS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "trace/packet_lanes-inl.h"
#include "trace/packet_rays.h"
#include "trace/triangle_place.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// One component of the cross product of two edges, by those two of the three edges whose products cancel
// less.
template <class V>
HWY_INLINE V stable(V ay, V bz, V az, V by, V cz, V cy) {
  const V ab = hn::Mul(az, by);
  const V bc = hn::Mul(bz, cy);
  return hn::IfThenElse(hn::Lt(hn::Abs(ab), hn::Abs(bc)), hn::Sub(hn::Mul(ay, bz), ab),
                        hn::Sub(hn::Mul(by, cz), bc));
}
template <class V>
HWY_INLINE Vec3Of<V> normal_of(const Vec3Of<V>& a, const Vec3Of<V>& b, const Vec3Of<V>& c) {
  return {stable(a.y, b.z, a.z, b.y, c.z, c.y), stable(a.z, b.x, a.x, b.z, c.x, c.z),
          stable(a.x, b.y, a.y, b.x, c.y, c.x)};
}

template <class V>
struct Flight {
  Vec3Of<V> origin;
  Vec3Of<V> direction;
  V distance;
};

// Which planes, of a normal and an offset, a flight passes outward, or nearly.
template <class D, class V>
[[nodiscard]] HWY_INLINE hn::Mask<D> passes(D d, const Flight<V>& flight, const Vec3Of<V>& normal, V offset) {
  const V from = hn::Sub(dot(normal, flight.origin), offset);
  const V to = hn::Add(from, hn::Mul(flight.distance, dot(normal, flight.direction)));
  const V slack = hn::Set(d, 2 * kPlaneError);
  return hn::And(hn::Le(from, slack), hn::Ge(to, hn::Neg(slack)));
}

// Whether any of a packet's planes is passed outward, or nearly.
[[nodiscard]] HWY_INLINE bool may_leave(const PacketPlanes& planes, const Flight<VF>& flight) {
  bool may = false;
  for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F()))
    may |=
        !hn::AllFalse(F(), passes(F(), flight, load(planes.normal, at), hn::Load(F(), planes.offset + at)));
  return may;
}

// Where a flight leaves by some triangles: the distance, infinite where it does not; the weights of the
// second and third corners; the normals, of any length.
template <class V>
struct Exits {
  V t;
  V u;
  V v;
  Vec3Of<V> normal;
};

// The corners relative to the origin.
template <class D, class V>
[[nodiscard]] HWY_INLINE Exits<V> exits_by(D d, const Flight<V>& flight, const Vec3Of<V>& v0,
                                           const Vec3Of<V>& v1, const Vec3Of<V>& v2) {
  const Vec3Of<V> e0 = v2 - v0;
  const Vec3Of<V> e1 = v0 - v1;
  const Vec3Of<V> e2 = v1 - v2;
  const V u = dot(cross(e0, v2 + v0), flight.direction);
  const V v = dot(cross(e1, v0 + v1), flight.direction);
  const V w = dot(cross(e2, v1 + v2), flight.direction);
  const V sum = hn::Add(hn::Add(u, v), w);
  const V rounding = hn::Mul(hn::Abs(sum), hn::Set(d, 0x1p-23f));
  const auto leaving = hn::Ge(hn::Min(u, hn::Min(v, w)), hn::Neg(rounding));
  const auto entering = hn::Le(hn::Max(u, hn::Max(v, w)), rounding);
  const Vec3Of<V> normal = normal_of(e0, e1, e2);
  const V along = dot(normal, flight.direction);
  const V t = hn::Div(dot(v0, normal), along);
  const auto within = hn::And(hn::Ge(t, hn::Zero(d)), hn::Le(t, flight.distance));
  const auto exits = hn::And(hn::And(hn::Or(leaving, entering), hn::Gt(along, hn::Zero(d))), within);
  return {hn::IfThenElse(exits, t, hn::Inf(d)), hn::Div(u, sum), hn::Div(v, sum), normal};
}

[[nodiscard]] HWY_INLINE Exits<VF> exits_by(const Packet& packet, std::size_t at, const Flight<VF>& flight) {
  return exits_by(F(), flight, load(packet.corner[0], at) - flight.origin,
                  load(packet.corner[1], at) - flight.origin, load(packet.corner[2], at) - flight.origin);
}

// The exit of a ray by one of a packet's triangles; unknown where rounding leaves no weights.
[[nodiscard]] HWY_INLINE GridExit pick(const Exits<VF>& exits, const Packet& packet, std::size_t at,
                                       std::size_t lane, const GridRay& ray) {
  alignas(32) float rows[6][kPacket];
  const VF values[6] = {exits.t, exits.u, exits.v, exits.normal.x, exits.normal.y, exits.normal.z};
  for (int i = 0; i < 6; ++i) hn::Store(values[i], F(), rows[i]);
  if (std::isnan(rows[1][lane])) return {};  // seen edge-on, its corners weigh 0 / 0
  const float u = std::clamp(rows[1][lane], 0.0f, 1.0f);
  const float v = std::clamp(rows[2][lane], 0.0f, 1.0f);
  const std::size_t slot = at + lane;
  const auto corner = [&](int k) {
    return glm::vec3(packet.corner[k][0][slot], packet.corner[k][1][slot], packet.corner[k][2][slot]);
  };
  const glm::vec3 normal(rows[3][lane], rows[4][lane], rows[5][lane]);
  const glm::vec3 near = ray.origin + rows[0][lane] * ray.direction;
  const TrianglePlace place = place_on({corner(0), corner(1), corner(2)}, u, v, near, normal);
  return {GridExit::Kind::exit, rows[0][lane], place.u, place.v, place.point, normal, packet.triangle[slot]};
}

constexpr int kMostCells = 1024;  // more than any ray passes in a grid

// Steps from cell to cell.
struct CellWalk {
  glm::ivec3 cell;
  glm::ivec3 step;
  glm::vec3 next;     // distance along the ray to the next cell along each axis
  glm::vec3 between;  // two such

  CellWalk() = default;
  HWY_INLINE CellWalk(const SurfaceCells& grid, const GridRay& ray) {
    const glm::vec3 place = (ray.origin - grid.low) * grid.cells_per_unit;
    for (int axis = 0; axis < 3; ++axis) {
      const float floor = std::floor(place[axis]);
      cell[axis] = static_cast<int>(floor);
      const float d = ray.direction[axis] * grid.cells_per_unit;
      const bool forward = d > 0;
      step[axis] = forward ? 1 : -1;
      const float way = forward ? floor + 1 - place[axis] : place[axis] - floor;
      const bool moves = std::abs(d) > 1e-12f;
      const float inverse = 1 / std::abs(d);
      between[axis] = moves ? inverse : std::numeric_limits<float>::infinity();
      next[axis] = moves ? way * inverse : std::numeric_limits<float>::infinity();
    }
  }
  // Where the ray leaves the cell.
  [[nodiscard]] HWY_INLINE float end() const { return std::min(next.x, std::min(next.y, next.z)); }
  HWY_INLINE void advance() {
    const float least = end();
    const int x = next.x == least;
    const int y = next.y == least && !x;
    const int z = 1 - x - y;
    cell += step * glm::ivec3(x, y, z);
    next = {x ? next.x + between.x : next.x, y ? next.y + between.y : next.y,
            z ? next.z + between.z : next.z};
  }
};

HWY_INLINE bool in_grid(const SurfaceCells& grid, const glm::ivec3& cell) {
  return static_cast<unsigned>(cell.x) < static_cast<unsigned>(grid.size.x) &&
         static_cast<unsigned>(cell.y) < static_cast<unsigned>(grid.size.y) &&
         static_cast<unsigned>(cell.z) < static_cast<unsigned>(grid.size.z);
}

HWY_INLINE std::size_t brick_of(const SurfaceCells& grid, const glm::ivec3& cell) {
  return static_cast<std::size_t>(((cell.z >> 2) * grid.bricks_size.y + (cell.y >> 2)) * grid.bricks_size.x +
                                  (cell.x >> 2));
}

HWY_INLINE const SurfaceCells::List* list_of(const SurfaceCells& grid, const glm::ivec3& cell) {
  const SurfaceCells::Brick& brick = grid.bricks[brick_of(grid, cell)];
  const int bit = ((cell.z & 3) * 4 + (cell.y & 3)) * 4 + (cell.x & 3);
  if (!((brick.cells >> bit) & 1)) return nullptr;
  const std::uint64_t before = brick.cells & ((std::uint64_t{1} << bit) - 1);
  return grid.lists.data() + brick.first + std::popcount(before);
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
