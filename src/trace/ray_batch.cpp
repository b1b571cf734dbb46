#include "trace/ray_batch.h"

#include <algorithm>

#include <hwy/cache_control.h>

// The instruction sets this file is compiled for, once each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/ray_batch.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "trace/packet_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// Rays side by side: each part of the search is done for all of them before the next part, in a loop without
// branches, so that the processor has many rays' loads under way and guesses nothing. What goes on after a
// part is appended to a list whether it is wanted or not, and the list's end moves if it is.
class ExitBatch {
 public:
  HWY_INLINE ExitBatch(const Packets& packets, const SurfaceCells& grid, std::span<const ShortRay> rays)
      : packets_(packets), grid_(grid), rays_(rays) {}

  HWY_INLINE void run(std::span<ShortExit> exits) {
    begin();
    for (int i = 0; i < kMostCells && active_count_ > 0; ++i) {
      find_lists();
      while (list_count_ > 0) {
        find_pairs();
        find_due();
        meet_due();
      }
      advance();
    }
    finish(exits);
  }

 private:
  // A ray's way so far. `limit`: beyond what is wanted, or where the nearest exit is.
  struct Way {
    CellWalk walk;
    float limit;
    std::uint32_t known;  // 1 when all of the ray has been seen
    std::uint32_t packet;
    std::uint32_t slot;  // of the packet, or kNone
  };
  static constexpr std::uint32_t kNone = kPacket;

  struct Pair {
    std::uint32_t ray;
    std::uint32_t number;  // of a packet, or of a list
  };

  HWY_INLINE void begin() {
    for (std::uint32_t i = 0; i < rays_.size(); ++i) {
      const ShortRay& ray = rays_[i];
      Way& way = ways_[i];
      way.walk = CellWalk(grid_, ray);
      way.limit = std::nextafter(ray.distance, std::numeric_limits<float>::infinity());
      way.known = 0;
      way.packet = 0;
      way.slot = kNone;
      const bool inside = in_grid(grid_, way.walk.cell);
      active_[active_count_] = i;
      active_count_ += inside & (ray.distance * grid_.cells_per_unit < kLongest);
      hwy::Prefetch(&grid_.bricks[inside ? brick_of(grid_, way.walk.cell) : 0]);
    }
  }

  HWY_INLINE void find_lists() {
    for (std::size_t i = 0; i < active_count_; ++i) {
      const std::uint32_t ray = active_[i];
      const glm::ivec3& cell = ways_[ray].walk.cell;
      const SurfaceCells::Brick& brick = grid_.bricks[brick_of(grid_, cell)];
      const int bit = ((cell.z & 3) * 4 + (cell.y & 3)) * 4 + (cell.x & 3);
      const std::uint64_t before = brick.cells & ((std::uint64_t{1} << bit) - 1);
      const std::uint32_t list = brick.first + static_cast<std::uint32_t>(std::popcount(before));
      lists_[list_count_] = {ray, list};
      list_count_ += (brick.cells >> bit) & 1;
      hwy::Prefetch(grid_.lists.data() + list);
    }
  }

  HWY_INLINE void find_pairs() {
    pair_count_ = 0;
    std::size_t more_count = 0;
    for (std::size_t i = 0; i < list_count_; ++i) {
      const Pair at = lists_[i];
      const SurfaceCells::List& list = grid_.lists[at.number];
      for (const std::uint32_t packet : list.packets) {
        pairs_[pair_count_] = {at.ray, packet};
        pair_count_ += packet < packets_.nothing();
        const auto* line =
            reinterpret_cast<const char*>(&packets_.planes[std::min(packet, packets_.nothing())]);
        hwy::Prefetch(line);
        hwy::Prefetch(line + 64);
      }
      lists_[more_count] = {at.ray, list.packets[3] & ~SurfaceCells::kMore};
      more_count += list.packets[3] >= SurfaceCells::kMore;
    }
    list_count_ = more_count;
  }

  HWY_INLINE void find_due() {
    due_count_ = 0;
    for (std::size_t i = 0; i < pair_count_; ++i) {
      const Pair pair = pairs_[i];
      const ShortRay& ray = rays_[pair.ray];
      pairs_[due_count_] = pair;
      due_count_ += may_leave(packets_.planes[pair.number], set(ray.origin), set(ray.direction),
                              std::min(ray.distance, ways_[pair.ray].limit));
    }
    for (std::size_t i = 0; i < due_count_; ++i) {
      const auto* lines = reinterpret_cast<const char*>(&packets_.packets[pairs_[i].number]);
      for (std::size_t at = 0; at < sizeof(Packet); at += 64) hwy::Prefetch(lines + at);
    }
  }

  HWY_INLINE void meet_due() {
    for (std::size_t i = 0; i < due_count_; ++i) {
      const Pair pair = pairs_[i];
      const ShortRay& ray = rays_[pair.ray];
      Way& way = ways_[pair.ray];
      for (std::size_t at = 0; at < kPacket; at += hn::Lanes(F())) {
        const Exits exits = find_exits_of(packets_.packets[pair.number], at, set(ray.origin),
                                          set(ray.direction), ray.distance);
        const VF least = hn::MinOfLanes(F(), exits.t);
        const float t = hn::GetLane(least);
        const auto lane = static_cast<std::uint32_t>(hn::FindFirstTrue(F(), hn::Eq(exits.t, least)));
        const bool nearer = t < way.limit;
        way.limit = nearer ? t : way.limit;
        way.packet = nearer ? pair.number : way.packet;
        way.slot = nearer ? static_cast<std::uint32_t>(at) + lane : way.slot;
      }
    }
  }

  HWY_INLINE void advance() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < active_count_; ++i) {
      const std::uint32_t ray = active_[i];
      Way& way = ways_[ray];
      const bool goes_on = !(way.walk.end() >= std::min(rays_[ray].distance, way.limit));
      way.walk.advance();
      const bool stays = goes_on & in_grid(grid_, way.walk.cell);
      way.known = !stays;
      active_[count] = ray;
      count += stays;
      hwy::Prefetch(&grid_.bricks[stays ? brick_of(grid_, way.walk.cell) : 0]);
    }
    active_count_ = count;
  }

  HWY_INLINE void finish(std::span<ShortExit> exits) {
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Way& way = ways_[i];
      exits[i].kind = way.known ? ShortExit::Kind::none : ShortExit::Kind::unknown;
      if (!way.known | (way.slot == kNone)) continue;
      const std::size_t at = way.slot / hn::Lanes(F()) * hn::Lanes(F());
      const Packet& packet = packets_.packets[way.packet];
      const ShortRay& ray = rays_[i];
      exits[i] = pick(find_exits_of(packet, at, set(ray.origin), set(ray.direction), ray.distance), packet,
                      at, way.slot - at);
    }
  }

  const Packets& packets_;
  const SurfaceCells& grid_;
  std::span<const ShortRay> rays_;
  Way ways_[kRayBatch];
  std::uint32_t active_[kRayBatch];
  Pair lists_[kRayBatch];
  Pair pairs_[4 * kRayBatch + 1];
  std::size_t active_count_ = 0;
  std::size_t list_count_ = 0;
  std::size_t pair_count_ = 0;
  std::size_t due_count_ = 0;
};

void find_all(const Packets& packets, const SurfaceCells& grid, std::span<const ShortRay> rays,
              std::span<ShortExit> exits) {
  ExitBatch(packets, grid, rays).run(exits);
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

HWY_EXPORT(find_all);

void find_exits(const Packets& packets, const SurfaceCells& cells, std::span<const ShortRay> rays,
                std::span<ShortExit> exits) noexcept {
  if (cells.bricks.empty()) {
    std::fill(exits.begin(), exits.end(), ShortExit{});
    return;
  }
  HWY_DYNAMIC_DISPATCH(find_all)(packets, cells, rays, exits);
}

}  // namespace meander
#endif
