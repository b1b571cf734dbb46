#include "walk/lanes.h"

#include <cstring>

namespace meander {
namespace {

void put(Lanes::Row (&rows)[3], int lane, const Vec3& v) noexcept {
  for (int i = 0; i < 3; ++i) rows[i][lane] = static_cast<float>(v[i]);
}

Vec3 get(const Lanes::Row (&rows)[3], int lane) noexcept {
  return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

}  // namespace

void put_walker(Lanes& lanes, int lane, const Walker& walker, const Random& random, Real sigma) noexcept {
  put(lanes.position, lane, walker.position);
  put(lanes.direction, lane, walker.direction);
  put(lanes.throughput, lane, walker.weight.throughput);
  put(lanes.albedo, lane, walker.weight.albedo);
  const Rgb ratio = walker.weight.ratio * walker.weight.since;
  put(lanes.ratio, lane, ratio / largest(ratio));
  lanes.ball_radius2[lane] = -1;
  lanes.lift[lane] = 1;
  lanes.length[lane] = 0;
  lanes.sigma[lane] = static_cast<float>(sigma);
  lanes.one_minus_mu[lane] = static_cast<float>(walker.last.one_minus_mu);
  lanes.one_plus_mu[lane] = static_cast<float>(walker.last.one_plus_mu);
  for (int i = 0; i < 4; ++i) lanes.random[i][lane] = random.state()[static_cast<std::size_t>(i)];
  lanes.order[lane] = walker.weight.order;
  lanes.steps[lane] = static_cast<std::uint32_t>(walker.steps);
  lanes.due[lane] = static_cast<std::uint32_t>(LaneDue::flight);
  lanes.state[lane] = static_cast<std::uint32_t>(LaneState::running);
}

void move_walk(Lanes& lanes, int from, int to) noexcept {
  constexpr std::size_t kRow = sizeof(Lanes::Row);
  constexpr std::size_t kCell = kRow / kLanes;
  static_assert(sizeof(Lanes) % kRow == 0 && sizeof(lanes.state) == kRow);
  char* rows = reinterpret_cast<char*>(&lanes);
  for (char* row = rows; row != rows + sizeof(Lanes); row += kRow)
    std::memcpy(row + kCell * static_cast<std::size_t>(to), row + kCell * static_cast<std::size_t>(from),
                kCell);
  lanes.state[from] = static_cast<std::uint32_t>(LaneState::empty);
}

void land(Lanes& lanes, int lane, const Vec3& point, Real distance) noexcept {
  put(lanes.position, lane, point);
  lanes.distance[lane] = static_cast<float>(distance);
  lanes.ball_radius2[lane] = -1;
  lanes.due[lane] = static_cast<std::uint32_t>(LaneDue::collision);
  lanes.state[lane] = static_cast<std::uint32_t>(LaneState::running);
}

Walker walker_of(const Lanes& lanes, int lane) noexcept {
  Walker walker;
  walker.position = get(lanes.position, lane);
  walker.direction = get(lanes.direction, lane);
  walker.weight.throughput = get(lanes.throughput, lane) * Real(lanes.lift[lane]);
  walker.weight.albedo = get(lanes.albedo, lane);
  walker.weight.ratio = get(lanes.ratio, lane);
  walker.weight.length = lanes.length[lane];
  walker.weight.order = lanes.order[lane];
  walker.last.one_minus_mu = lanes.one_minus_mu[lane];
  walker.last.one_plus_mu = lanes.one_plus_mu[lane];
  walker.steps = lanes.steps[lane];
  return walker;
}

Random random_of(const Lanes& lanes, int lane) noexcept {
  return Random({lanes.random[0][lane], lanes.random[1][lane], lanes.random[2][lane], lanes.random[3][lane]});
}

}  // namespace meander
