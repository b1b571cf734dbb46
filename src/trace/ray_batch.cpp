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

using R = hn::ScalableTag<float>;  // a lane a ray
using RU = hn::ScalableTag<std::uint32_t>;
using VR = hn::Vec<R>;
using MR = hn::Mask<R>;

HWY_INLINE VR rays_of(float value) { return hn::Set(R(), value); }

// Rays side by side: each part of the search is done for all of them before the next part, in a loop without
// branches, so that the processor has many rays' loads under way and guesses nothing. What goes on after a
// part is appended to a list whether it is wanted or not, and the list's end moves if it is.
class ExitBatch {
 public:
  HWY_INLINE ExitBatch(const Packets& packets, const SurfaceCells& grid, const GridRays& rays,
                       std::size_t count)
      : packets_(packets), grid_(grid), rays_(rays), count_(count) {}

  HWY_INLINE void run(std::span<GridExit> exits) {
    begin();
    for (int i = 0; i < kMostCells && active_count_ > 0; ++i) {
      find_lists();
      while (list_count_ > 0) {
        ask_planes();
        find_due();
        meet_due();
      }
      advance();
    }
    finish(exits);
  }

 private:
  using Row = float[kRayBatch];

  struct Pair {
    std::uint32_t ray;
    std::uint32_t number;  // of a packet, or of a list
  };

  // Of a ray: under way, seen to its end, or not for the grid.
  static constexpr std::uint32_t kActive = 0;
  static constexpr std::uint32_t kKnown = 1;
  static constexpr std::uint32_t kUnknown = 2;

  static constexpr std::uint32_t kNone = 0xffffffff;
  static constexpr std::uint32_t kWidth = kPacket;
  static constexpr std::size_t kWidest = 16;  // what a vector writes beyond the end of a list

  // As CellWalk, whose numbers these are.
  HWY_INLINE void begin() {
    for (std::size_t at = 0; at < count_; at += hn::Lanes(R())) {
      const VR distance = hn::Load(R(), rays_.distance + at);
      hn::StoreInterleaved4(hn::Load(R(), rays_.origin[0] + at), hn::Load(R(), rays_.origin[1] + at),
                            hn::Load(R(), rays_.origin[2] + at), distance, R(), from_ + 4 * at);
      hn::StoreInterleaved4(hn::Load(R(), rays_.direction[0] + at), hn::Load(R(), rays_.direction[1] + at),
                            hn::Load(R(), rays_.direction[2] + at), distance, R(), along_ + 4 * at);
      for (int axis = 0; axis < 3; ++axis) {
        const VR origin = hn::Load(R(), rays_.origin[axis] + at);
        const VR place = hn::Mul(hn::Sub(origin, rays_of(grid_.low[axis])), rays_of(grid_.cells_per_unit));
        const VR floor = hn::Floor(place);
        const VR d = hn::Mul(hn::Load(R(), rays_.direction[axis] + at), rays_of(grid_.cells_per_unit));
        const MR forward = hn::Gt(d, hn::Zero(R()));
        const VR way =
            hn::IfThenElse(forward, hn::Sub(hn::Add(floor, rays_of(1)), place), hn::Sub(place, floor));
        const MR moves = hn::Gt(hn::Abs(d), rays_of(1e-12f));
        const VR inverse = hn::Div(rays_of(1), hn::Abs(d));
        hn::Store(floor, R(), cell_[axis] + at);
        hn::Store(hn::IfThenElse(forward, rays_of(1), rays_of(-1)), R(), step_[axis] + at);
        hn::Store(hn::IfThenElse(moves, inverse, hn::Inf(R())), R(), between_[axis] + at);
        hn::Store(hn::IfThenElse(moves, hn::Mul(way, inverse), hn::Inf(R())), R(), next_[axis] + at);
      }
      const auto number = hn::Add(hn::Iota(RU(), 0), hn::Set(RU(), static_cast<std::uint32_t>(at)));
      const auto real = hn::Lt(number, hn::Set(RU(), static_cast<std::uint32_t>(count_)));
      // The next number after the distance.
      const auto beyond = hn::Add(hn::BitCast(RU(), distance), hn::Set(RU(), 1));
      hn::Store(hn::BitCast(R(), beyond), R(), limit_ + at);
      hn::Store(hn::Set(RU(), kNone), RU(), best_ + at);
      const MR active = keep_active(at, hn::RebindMask(R(), real));
      hn::Store(states(active, kActive, kUnknown), RU(), state_ + at);
    }
  }

  [[nodiscard]] static HWY_INLINE hn::Vec<RU> states(MR mask, std::uint32_t yes, std::uint32_t no) {
    return hn::IfThenElse(hn::RebindMask(RU(), mask), hn::Set(RU(), yes), hn::Set(RU(), no));
  }

  // Lists those of some rays that are in the grid, and asks for their bricks.
  HWY_INLINE MR keep_active(std::size_t at, MR wanted) {
    MR inside = wanted;
    for (int axis = 0; axis < 3; ++axis) {
      const VR cell = hn::Load(R(), cell_[axis] + at);
      const VR end = rays_of(static_cast<float>(grid_.size[axis]));
      inside = hn::And(inside, hn::And(hn::Ge(cell, hn::Zero(R())), hn::Lt(cell, end)));
    }
    const auto whole = [&](int axis) {
      const VR cell = hn::IfThenElseZero(inside, hn::Load(R(), cell_[axis] + at));
      return hn::BitCast(RU(), hn::ConvertTo(hn::RebindToSigned<R>(), cell));
    };
    const auto x = whole(0);
    const auto y = whole(1);
    const auto z = whole(2);
    const auto sizes = [](int size) { return hn::Set(RU(), static_cast<std::uint32_t>(size)); };
    auto brick = hn::Mul(hn::ShiftRight<2>(z), sizes(grid_.bricks_size.y));
    brick = hn::Mul(hn::Add(brick, hn::ShiftRight<2>(y)), sizes(grid_.bricks_size.x));
    hn::Store(hn::Add(brick, hn::ShiftRight<2>(x)), RU(), brick_ + at);
    const auto three = hn::Set(RU(), 3);
    const auto row = hn::Or(hn::ShiftLeft<2>(hn::And(z, three)), hn::And(y, three));
    hn::Store(hn::Or(hn::ShiftLeft<2>(row), hn::And(x, three)), RU(), bit_ + at);
    const auto number = hn::Add(hn::Iota(RU(), 0), hn::Set(RU(), static_cast<std::uint32_t>(at)));
    hn::StoreU(hn::Compress(number, hn::RebindMask(RU(), inside)), RU(), active_ + active_count_);
    active_count_ += hn::CountTrue(R(), inside);
    return inside;
  }

  HWY_INLINE void find_lists() {
    for (std::size_t i = 0; i < active_count_; ++i) hwy::Prefetch(&grid_.bricks[brick_[active_[i]]]);
    for (std::size_t i = 0; i < active_count_; ++i) {
      const std::uint32_t ray = active_[i];
      const SurfaceCells::Brick& brick = grid_.bricks[brick_[ray]];
      const std::uint32_t bit = bit_[ray];
      const std::uint64_t before = brick.cells & ((std::uint64_t{1} << bit) - 1);
      const std::uint32_t list = brick.first + static_cast<std::uint32_t>(std::popcount(before));
      lists_[list_count_] = {ray, list};
      list_count_ += (brick.cells >> bit) & 1;
      hwy::Prefetch(grid_.lists.data() + list);
    }
  }

  // Asks for the planes of the lists' packets.
  HWY_INLINE void ask_planes() const {
    for (std::size_t i = 0; i < list_count_; ++i)
      for (const std::uint32_t packet : grid_.lists[lists_[i].number].packets) {
        const auto* line = reinterpret_cast<const char*>(&packets_.planes[existing(packet)]);
        hwy::Prefetch(line);
        hwy::Prefetch(line + 64);
      }
  }

  [[nodiscard]] HWY_INLINE std::uint32_t existing(std::uint32_t packet) const {
    return std::min(packet, packets_.nothing());
  }

  // The packets of the lists that the rays may leave by, and the lists that go on.
  HWY_INLINE void find_due() {
    due_count_ = 0;
    std::size_t more_count = 0;
    for (std::size_t i = 0; i < list_count_; ++i) {
      const Pair at = lists_[i];
      const SurfaceCells::List& list = grid_.lists[at.number];
      const std::uint32_t packets[4] = {list.packets[0], existing(list.packets[1]), existing(list.packets[2]),
                                        existing(list.packets[3])};
      unsigned due[4];
      find_due(at.ray, packets, due);
      for (int j = 0; j < 4; ++j) {
        due_[due_count_] = {at.ray, packets[j]};
        due_count_ += due[j];
      }
      lists_[more_count] = {at.ray, list.packets[3] & ~SurfaceCells::kMore};
      more_count += list.packets[3] >= SurfaceCells::kMore;
    }
    list_count_ = more_count;
    due_[due_count_] = due_[due_count_ > 0 ? due_count_ - 1 : 0];  // an even number for meet_due
    for (std::size_t i = 0; i < due_count_; ++i) {
      const auto* lines = reinterpret_cast<const char*>(&packets_.packets[due_[i].number]);
      for (std::size_t at = 0; at < sizeof(Packet); at += 64) hwy::Prefetch(lines + at);
    }
  }

  [[nodiscard]] HWY_INLINE Flight<VF> flight(std::uint32_t ray, float distance) const {
    const float* from = from_ + 4 * ray;
    const float* along = along_ + 4 * ray;
    return {{hn::Set(F(), from[0]), hn::Set(F(), from[1]), hn::Set(F(), from[2])},
            {hn::Set(F(), along[0]), hn::Set(F(), along[1]), hn::Set(F(), along[2])},
            hn::Set(F(), distance)};
  }

  HWY_INLINE void keep(const Pair& pair, std::uint32_t slot, float t) {
    // Chosen by bits: the compiler would make it a branch.
    const std::uint32_t nearer = -static_cast<std::uint32_t>(t < limit_[pair.ray]);
    const auto choose = [nearer](std::uint32_t yes, std::uint32_t no) {
      return (yes & nearer) | (no & ~nearer);
    };
    limit_[pair.ray] = std::bit_cast<float>(
        choose(std::bit_cast<std::uint32_t>(t), std::bit_cast<std::uint32_t>(limit_[pair.ray])));
    best_[pair.ray] = choose(pair.number * kWidth + slot, best_[pair.ray]);
  }

#if HWY_TARGET <= HWY_AVX3
  // Two packets fill a vector.
  using W = hn::CappedTag<float, 2 * kPacket>;
  using VW = hn::Vec<W>;
  using V3W = Vec3Of<VW>;

  static HWY_INLINE VW both(const float* low, const float* high) {
    return hn::Combine(W(), hn::Load(F(), high), hn::Load(F(), low));
  }
  static HWY_INLINE V3W both(const float (&low)[3][kPacket], const float (&high)[3][kPacket]) {
    return {both(low[0], high[0]), both(low[1], high[1]), both(low[2], high[2])};
  }
  // The four floats of two rays, each throughout its half.
  static HWY_INLINE V3W both(const float* rows, std::uint32_t low, std::uint32_t high, VW& fourth) {
    const VW all =
        hn::Combine(W(), hn::LoadDup128(F(), rows + 4 * high), hn::LoadDup128(F(), rows + 4 * low));
    fourth = hn::Broadcast<3>(all);
    return {hn::Broadcast<0>(all), hn::Broadcast<1>(all), hn::Broadcast<2>(all)};
  }
  [[nodiscard]] HWY_INLINE Flight<VW> flight(std::uint32_t low, std::uint32_t high) const {
    Flight<VW> flight;
    VW unused;
    flight.origin = both(from_, low, high, flight.distance);
    flight.direction = both(along_, low, high, unused);
    return flight;
  }

  HWY_INLINE void find_due(std::uint32_t ray, const std::uint32_t (&packets)[4], unsigned (&due)[4]) const {
    Flight<VW> of_both = flight(ray, ray);
    of_both.distance = hn::Set(W(), limit_[ray]);
    for (int j = 0; j < 4; j += 2) {
      const PacketPlanes& low = packets_.planes[packets[j]];
      const PacketPlanes& high = packets_.planes[packets[j + 1]];
      std::uint8_t bits[8];
      hn::StoreMaskBits(
          W(), passes(W(), of_both, both(low.normal, high.normal), both(low.offset, high.offset)), bits);
      due[j] = bits[0] != 0;
      due[j + 1] = bits[1] != 0;
    }
  }

  HWY_INLINE void meet_due() {
    for (std::size_t i = 0; i < due_count_; i += 2) {
      const Pair low = due_[i];
      const Pair high = due_[i + 1];
      const Flight<VW> of_both = flight(low.ray, high.ray);
      const auto corner = [&](int k) HWY_ATTR {
        return both(packets_.packets[low.number].corner[k], packets_.packets[high.number].corner[k]) -
               of_both.origin;
      };
      const Exits<VW> exits = exits_by(W(), of_both, corner(0), corner(1), corner(2));
      VW least = hn::Min(exits.t, hn::SwapAdjacentBlocks(exits.t));
      least = hn::Min(least, hn::Shuffle1032(least));
      least = hn::Min(least, hn::Shuffle2301(least));
      std::uint8_t bits[8];
      hn::StoreMaskBits(W(), hn::Eq(exits.t, least), bits);
      keep(low, static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(bits[0]))),
           hn::GetLane(least));
      keep(high, static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(bits[1]))),
           hn::GetLane(hn::UpperHalf(F(), least)));
    }
  }
#else
  HWY_INLINE void find_due(std::uint32_t ray, const std::uint32_t (&packets)[4], unsigned (&due)[4]) const {
    const Flight<VF> all = flight(ray, limit_[ray]);
    for (int j = 0; j < 4; ++j) due[j] = may_leave(packets_.planes[packets[j]], all);
  }

  HWY_INLINE void meet_due() {
    for (std::size_t i = 0; i < due_count_; ++i) {
      const Pair pair = due_[i];
      const Flight<VF> all = flight(pair.ray, rays_.distance[pair.ray]);
      for (std::uint32_t at = 0; at < kPacket; at += static_cast<std::uint32_t>(hn::Lanes(F()))) {
        const VF t = exits_by(packets_.packets[pair.number], at, all).t;
        const VF least = hn::MinOfLanes(F(), t);
        const auto lane = static_cast<std::uint32_t>(hn::FindFirstTrue(F(), hn::Eq(t, least)));
        keep(pair, at + lane, hn::GetLane(least));
      }
    }
  }
#endif

  HWY_INLINE void advance() {
    active_count_ = 0;
    for (std::size_t at = 0; at < count_; at += hn::Lanes(R())) {
      const auto state = hn::Load(RU(), state_ + at);
      const MR active = hn::RebindMask(R(), hn::Eq(state, hn::Set(RU(), kActive)));
      const VR x = hn::Load(R(), next_[0] + at);
      const VR y = hn::Load(R(), next_[1] + at);
      const VR z = hn::Load(R(), next_[2] + at);
      const VR least = hn::Min(x, hn::Min(y, z));
      const VR end = hn::Min(hn::Load(R(), rays_.distance + at), hn::Load(R(), limit_ + at));
      const MR goes_on = hn::AndNot(hn::Ge(least, end), active);
      const MR along_x = hn::Eq(x, least);
      const MR along_y = hn::AndNot(along_x, hn::Eq(y, least));
      move(at, 0, along_x);
      move(at, 1, along_y);
      move(at, 2, hn::Not(hn::Or(along_x, along_y)));
      const MR stays = keep_active(at, goes_on);
      const auto now = states(stays, kActive, kKnown);
      hn::Store(hn::IfThenElse(hn::RebindMask(RU(), active), now, state), RU(), state_ + at);
    }
  }

  HWY_INLINE void move(std::size_t at, int axis, MR moves) {
    const VR cell = hn::Load(R(), cell_[axis] + at);
    const VR next = hn::Load(R(), next_[axis] + at);
    const VR step = hn::IfThenElseZero(moves, hn::Load(R(), step_[axis] + at));
    const VR between = hn::Load(R(), between_[axis] + at);
    hn::Store(hn::Add(cell, step), R(), cell_[axis] + at);
    hn::Store(hn::IfThenElse(moves, hn::Add(next, between), next), R(), next_[axis] + at);
  }

  HWY_INLINE void finish(std::span<GridExit> exits) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      exits[i].kind = state_[i] == kKnown ? GridExit::Kind::none : GridExit::Kind::unknown;
      if (state_[i] != kKnown || best_[i] == kNone) continue;
      const std::uint32_t packet = best_[i] / kWidth;
      const std::size_t slot = best_[i] % kWidth;
      const std::size_t at = slot / hn::Lanes(F()) * hn::Lanes(F());
      const Packet& left_by = packets_.packets[packet];
      const GridRay ray{{from_[4 * i], from_[4 * i + 1], from_[4 * i + 2]},
                        {along_[4 * i], along_[4 * i + 1], along_[4 * i + 2]},
                        rays_.distance[i]};
      exits[i] = pick(exits_by(left_by, at, flight(i, ray.distance)), left_by, at, slot - at, ray);
    }
  }

  const Packets& packets_;
  const SurfaceCells& grid_;
  const GridRays& rays_;
  std::size_t count_;
  // Of each ray, the cells as CellWalk has them, and where that of the moment is.
  alignas(64) Row cell_[3];
  Row step_[3];
  Row next_[3];
  Row between_[3];
  alignas(64) float from_[4 * kRayBatch];   // origins and distances, ray by ray
  alignas(64) float along_[4 * kRayBatch];  // directions
  Row limit_;                               // just beyond what is wanted, or where the nearest exit so far is
  std::uint32_t best_[kRayBatch];           // the triangle there, by packet and slot, or kNone
  std::uint32_t state_[kRayBatch];
  std::uint32_t brick_[kRayBatch];
  std::uint32_t bit_[kRayBatch];
  std::uint32_t active_[kRayBatch + kWidest];
  Pair lists_[kRayBatch + 1];
  Pair due_[4 * kRayBatch + 1];
  std::size_t active_count_ = 0;
  std::size_t list_count_ = 0;
  std::size_t due_count_ = 0;
};

void find_all(const Packets& packets, const SurfaceCells& grid, const GridRays& rays,
              std::span<GridExit> exits) {
  ExitBatch(packets, grid, rays, exits.size()).run(exits);
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

HWY_EXPORT(find_all);

void find_exits(const Packets& packets, const SurfaceCells& cells, const GridRays& rays,
                std::span<GridExit> exits) noexcept {
  if (cells.bricks.empty())
    std::fill(exits.begin(), exits.end(), GridExit{});
  else
    HWY_DYNAMIC_DISPATCH(find_all)(packets, cells, rays, exits);
}

}  // namespace meander
#endif
