#include "trace/packet_rays.h"

// The instruction sets this file is compiled for, once each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/packet_rays.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "trace/packet_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// The nearest exit so far along one ray.
class ExitSearch {
 public:
  HWY_INLINE ExitSearch(const Packets& packets, const GridRay& ray)
      : packets_(packets),
        ray_(ray),
        flight_{set(ray.origin), set(ray.direction), hn::Set(F(), ray.distance)},
        distance_(ray.distance) {}

  [[nodiscard]] HWY_INLINE float distance() const { return distance_; }
  [[nodiscard]] HWY_INLINE const GridExit& found() const { return found_; }

  HWY_INLINE void look_into(const SurfaceCells::List& list) {
    for (const std::uint32_t number : list.packets) {
      if (number >= packets_.nothing()) return;
      if (!may_leave(packets_.planes[number], flight_)) continue;
      const Packet& packet = packets_.packets[number];
      for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F()))
        keep(exits_by(packet, at, flight_), packet, at);
    }
  }

 private:
  void keep(const Exits<VF>& exits, const Packet& packet, std::size_t at) {
    const float t = hn::GetLane(hn::MinOfLanes(F(), exits.t));
    if (!(t <= distance_) || (found_.kind != GridExit::Kind::none && t == distance_)) return;
    const auto lane = hn::FindFirstTrue(F(), hn::Eq(exits.t, hn::Set(F(), t)));
    found_ = pick(exits, packet, at, static_cast<std::size_t>(lane), ray_);
    distance_ = t;
    flight_.distance = hn::Set(F(), t);
  }

  const Packets& packets_;
  const GridRay& ray_;
  Flight<VF> flight_;
  float distance_;
  GridExit found_{GridExit::Kind::none, 0, 0, 0, {}, {}, 0};
};

GridExit find(const Packets& packets, const SurfaceCells& grid, const GridRay& ray) {
  ExitSearch search(packets, ray);
  CellWalk walk(grid, ray);
  if (!in_grid(grid, walk.cell)) return {};
  for (int i = 0; i < kMostCells; ++i) {
    for (const SurfaceCells::List* list = list_of(grid, walk.cell); list != nullptr;) {
      search.look_into(*list);
      const bool more = list->packets[3] >= SurfaceCells::kMore;
      list = more ? grid.lists.data() + (list->packets[3] - SurfaceCells::kMore) : nullptr;
    }
    if (walk.end() >= search.distance()) return search.found();
    walk.advance();
    if (!in_grid(grid, walk.cell)) return search.found();
  }
  return {};
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

HWY_EXPORT(find);

GridExit find_exit(const Packets& packets, const SurfaceCells& cells, const GridRay& ray) noexcept {
  return HWY_DYNAMIC_DISPATCH(find)(packets, cells, ray);
}

}  // namespace meander
#endif
