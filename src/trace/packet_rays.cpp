#include "trace/packet_rays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>

// The instruction sets this file is compiled for, once each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/packet_rays.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "trace/packet_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// One component of the cross product of two edges, by those two of the three edges whose products cancel
// less.
HWY_INLINE VF stable(VF ay, VF bz, VF az, VF by, VF cz, VF cy) {
  const VF ab = hn::Mul(az, by);
  const VF bc = hn::Mul(bz, cy);
  return hn::IfThenElse(hn::Lt(hn::Abs(ab), hn::Abs(bc)), hn::Sub(hn::Mul(ay, bz), ab),
                        hn::Sub(hn::Mul(by, cz), bc));
}
HWY_INLINE V3 normal_of(const V3& a, const V3& b, const V3& c) {
  return {stable(a.y, b.z, a.z, b.y, c.z, c.y), stable(a.z, b.x, a.x, b.z, c.x, c.z),
          stable(a.x, b.y, a.y, b.x, c.y, c.x)};
}

// The nearest exit so far along one ray.
class ExitSearch {
 public:
  HWY_INLINE ExitSearch(const Packets& packets, const ShortRay& ray)
      : packets_(packets),
        origin_(set(ray.origin)),
        direction_(set(ray.direction)),
        distance_(ray.distance) {}

  [[nodiscard]] HWY_INLINE float distance() const { return distance_; }
  [[nodiscard]] HWY_INLINE const ShortExit& found() const { return found_; }

  HWY_INLINE void look_into(const SurfaceCells::List& list, bool more) {
    std::uint32_t numbers[4];
    for (int i = 0; i < 4; ++i) numbers[i] = list.packets[i];
    if (more) numbers[3] = packets_.nothing();
    unsigned due = 0;
    for (unsigned i = 0; i < 4; ++i) due |= static_cast<unsigned>(may_leave(numbers[i])) << i;
    for (; due != 0; due &= due - 1) {
      const Packet& packet = packets_.packets[numbers[std::countr_zero(due)]];
      for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F())) look_into(packet, at);
    }
  }

 private:
  // Whether any of a packet's planes is passed outward, or nearly.
  [[nodiscard]] HWY_INLINE bool may_leave(std::uint32_t number) const {
    const PacketPlanes& planes = packets_.planes[number];
    bool may = false;
    for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F())) {
      const V3 normal = load(planes.normal, at);
      const VF from = hn::Sub(dot(normal, origin_), hn::Load(F(), planes.offset + at));
      const VF to = hn::Add(from, hn::Mul(hn::Set(F(), distance_), dot(normal, direction_)));
      const VF slack = hn::Set(F(), 2 * kPlaneError);
      may |= !hn::AllFalse(F(), hn::And(hn::Le(from, slack), hn::Ge(to, hn::Neg(slack))));
    }
    return may;
  }

  HWY_INLINE void look_into(const Packet& packet, std::size_t at) {
    const V3 v0 = load(packet.corner[0], at) - origin_;
    const V3 v1 = load(packet.corner[1], at) - origin_;
    const V3 v2 = load(packet.corner[2], at) - origin_;
    const V3 e0 = v2 - v0;
    const V3 e1 = v0 - v1;
    const V3 e2 = v1 - v2;
    const VF u = dot(cross(e0, v2 + v0), direction_);
    const VF v = dot(cross(e1, v0 + v1), direction_);
    const VF w = dot(cross(e2, v1 + v2), direction_);
    const VF sum = hn::Add(hn::Add(u, v), w);
    const VF rounding = hn::Mul(hn::Abs(sum), hn::Set(F(), 0x1p-23f));
    const MF leaving = hn::Ge(hn::Min(u, hn::Min(v, w)), hn::Neg(rounding));
    const MF entering = hn::Le(hn::Max(u, hn::Max(v, w)), rounding);
    const MF met = hn::Or(leaving, entering);
    if (hn::AllFalse(F(), met)) return;
    const V3 normal = normal_of(e0, e1, e2);
    const VF along = dot(normal, direction_);
    const VF t = hn::Div(dot(v0, normal), along);
    const MF within = hn::And(hn::Ge(t, hn::Zero(F())), hn::Le(t, hn::Set(F(), distance_)));
    const MF exits = hn::And(hn::And(met, hn::Gt(along, hn::Zero(F()))), within);
    if (hn::AllFalse(F(), exits)) return;
    keep({hn::IfThenElse(exits, t, hn::Inf(F())), hn::Div(u, sum), hn::Div(v, sum)}, normal, packet, at);
  }

  void keep(const V3& met, const V3& normal, const Packet& packet, std::size_t at) {
    alignas(32) float t[kPacket];
    hn::Store(met.x, F(), t);
    std::size_t best = kPacket;
    for (std::size_t i = 0; i < hn::Lanes(F()); ++i) {
      if (!(t[i] <= distance_) || (found_.kind == ShortExit::Kind::exit && t[i] == distance_)) continue;
      distance_ = t[i];
      found_.kind = ShortExit::Kind::exit;
      best = i;
    }
    if (best == kPacket) return;
    const auto pick = [&](VF lanes) {
      alignas(32) float values[kPacket];
      hn::Store(lanes, F(), values);
      return values[best];
    };
    const float u = std::clamp(pick(met.y), 0.0f, 1.0f);
    const float v = std::clamp(pick(met.z), 0.0f, 1.0f);
    const std::size_t slot = at + best;
    const auto corner = [&](int k) {
      return glm::vec3(packet.corner[k][0][slot], packet.corner[k][1][slot], packet.corner[k][2][slot]);
    };
    found_.distance = distance_;
    found_.u = u;
    found_.v = v;
    found_.point = (1 - u - v) * corner(0) + u * corner(1) + v * corner(2);
    found_.normal = {pick(normal.x), pick(normal.y), pick(normal.z)};
    found_.triangle = packet.triangle[slot];
  }

  const Packets& packets_;
  V3 origin_;
  V3 direction_;
  float distance_;
  ShortExit found_{ShortExit::Kind::none, 0, 0, 0, glm::vec3(0), glm::vec3(0), 0};
};

constexpr int kMostCells = 24;  // that a short ray passes
constexpr float kLongest = 24;  // of a short ray, in cells

// Steps from cell to cell.
struct CellWalk {
  glm::ivec3 cell;
  glm::ivec3 step;
  glm::vec3 next;     // distance along the ray to the next cell along each axis
  glm::vec3 between;  // two such

  HWY_INLINE CellWalk(const SurfaceCells& grid, const ShortRay& ray) {
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

HWY_INLINE const SurfaceCells::List* list_of(const SurfaceCells& grid, const glm::ivec3& cell) {
  const int number =
      ((cell.z >> 2) * grid.bricks_size.y + (cell.y >> 2)) * grid.bricks_size.x + (cell.x >> 2);
  const SurfaceCells::Brick& brick = grid.bricks[static_cast<std::size_t>(number)];
  const int bit = ((cell.z & 3) * 4 + (cell.y & 3)) * 4 + (cell.x & 3);
  if (!((brick.cells >> bit) & 1)) return nullptr;
  const std::uint64_t before = brick.cells & ((std::uint64_t{1} << bit) - 1);
  return grid.lists.data() + brick.first + std::popcount(before);
}

ShortExit find(const Packets& packets, const SurfaceCells& grid, const ShortRay& ray) {
  if (!(ray.distance * grid.cells_per_unit < kLongest)) return {};
  ExitSearch search(packets, ray);
  CellWalk walk(grid, ray);
  if (!in_grid(grid, walk.cell)) return {};
  for (int i = 0; i < kMostCells; ++i) {
    for (const SurfaceCells::List* list = list_of(grid, walk.cell); list != nullptr;) {
      const bool more = list->packets[3] >= SurfaceCells::kMore;
      search.look_into(*list, more);
      list = more ? grid.lists.data() + (list->packets[3] - SurfaceCells::kMore) : nullptr;
    }
    if (walk.end() >= search.distance()) return search.found();
    walk.advance();
    if (!in_grid(grid, walk.cell)) return search.found();
  }
  return {};
}

void prefetch(const Packets& packets, const SurfaceCells& grid, const glm::vec3& origin) {
  const glm::vec3 place = (origin - grid.low) * grid.cells_per_unit;
  const glm::ivec3 cell(glm::floor(place));
  if (!in_grid(grid, cell)) return;
  const SurfaceCells::List* list = list_of(grid, cell);
  if (list == nullptr) return;
  for (const std::uint32_t number : list->packets) {
    if (number >= packets.nothing()) continue;
    const auto* line = reinterpret_cast<const char*>(&packets.planes[number]);
    hwy::Prefetch(line);
    hwy::Prefetch(line + 64);
  }
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

HWY_EXPORT(find);
HWY_EXPORT(prefetch);

ShortExit find_exit(const Packets& packets, const SurfaceCells& cells, const ShortRay& ray) noexcept {
  return HWY_DYNAMIC_DISPATCH(find)(packets, cells, ray);
}

void prefetch_exit(const Packets& packets, const SurfaceCells& cells, const glm::vec3& origin) noexcept {
  HWY_DYNAMIC_DISPATCH(prefetch)(packets, cells, origin);
}

}  // namespace meander
#endif
