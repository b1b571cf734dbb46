#include "trace/empty_balls.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace meander {
namespace {

constexpr int kBlock = 16;              // cells along the side of what one task fills
constexpr int kShrinkings = 12;         // of a ball, at most
constexpr Real kSettled = Real(0.996);  // a ball that touches so nearly is not shrunk again
constexpr Real kReach = 4;              // radius of a touching ball, at most, in sides of its cube
constexpr float kMargin = 0x1p-13f;     // of the body's scale: what the radius is short of the distance

constexpr Real kPlaneMargin = 0x1p-18f;  // of the scale: how much deeper than touching a ball lies
// Of a ball's radius, what must be left for one that faces all of its cell, and what is as good as all.
constexpr Real kLeastFacing = Real(0.5);
constexpr Real kNearlyAll = Real(0.996);

// Packets looked into for one block, about, before it is given up: several times what the dearest block of a
// smooth mesh takes, 312 000 with 100 000 triangles and 873 000 with 1 280 000.
std::uint64_t dearest_block(const MeshBody& body) { return 1'000'000 + 16 * body.packet_count(); }

// A cube of cells, and the balls of the cubes that it is a part of.
struct Cube {
  glm::ivec3 corner{0};
  int side = 1;
  std::array<EmptyBall, 12> outer{};
  int outers = 0;
};

struct Fill {
  glm::ivec3 corner;
  int side;
  EmptyBall ball;
  EmptyBall facing;  // where the ball is followed
};

struct Filling {
  std::vector<Fill> fills;
  std::vector<Cube> left;    // cubes of kBlock that have not been looked into
  std::uint64_t looked = 0;  // packets, for the nearest points
};

class Filler {
 public:
  Filler(const MeshBody& body, const EmptyBalls& grid, const std::atomic<bool>& stop)
      : body_(body),
        low_(grid.low),
        cell_(1 / Real(grid.cells_per_unit)),
        dearest_(dearest_block(body)),
        stop_(stop) {}

  // Looks into a cube down to cubes of `stop` cells, which are left, or to single cells.
  void divide(const Cube& cube, int stop, Filling& filling) const {
    if (filling.looked > dearest_ || stop_.load(std::memory_order_relaxed)) return;
    for (int i = 0; i < cube.outers; ++i)
      if (covers(cube.outer[static_cast<std::size_t>(i)], cube))
        return filling.fills.push_back({cube.corner, cube.side, cube.outer[static_cast<std::size_t>(i)], {}});
    if (cube.side == stop) return filling.left.push_back(cube);
    const Real side = cell_ * Real(cube.side);
    const Found found = find(middle_of(cube), side, filling.looked);
    if (found.outside) return;
    if (found.ball.radius2 > 0 && covers(found.ball, cube))
      return filling.fills.push_back({cube.corner, cube.side, found.ball, {}});
    if (cube.side == 1) {
      if (found.ball.radius2 > 0) filling.fills.push_back(face(cube, found.ball));
      return;
    }
    const int half = cube.side / 2;
    for (int i = 0; i < 8; ++i) {
      Cube part = cube;
      part.corner += half * glm::ivec3(i & 1, (i >> 1) & 1, i >> 2);
      part.side = half;
      if (found.ball.radius2 > 0) part.outer[static_cast<std::size_t>(part.outers++)] = found.ball;
      divide(part, stop, filling);
    }
  }

 private:
  // A ball inside, near the middle of a cube; `outside` where the whole cube is.
  struct Found {
    EmptyBall ball;
    bool outside = false;
  };

  [[nodiscard]] Vec3 middle_of(const Cube& cube) const {
    return low_ + cell_ * (Vec3(cube.corner) + Real(0.5) * Real(cube.side));
  }
  [[nodiscard]] bool covers(const EmptyBall& ball, const Cube& cube) const {
    const Vec3 farthest = glm::abs(middle_of(cube) - Vec3(ball.center)) + cell_ * Real(cube.side) / 2;
    return glm::dot(farthest, farthest) <= Real(ball.radius2);
  }

  [[nodiscard]] Found find(const Vec3& place, Real side, std::uint64_t& looked) const {
    const auto nearest = body_.nearest(place, std::numeric_limits<Real>::infinity(), looked);
    if (!nearest) return {{}, true};
    Vec3 inward = place - nearest->point;
    const bool inside = glm::dot(inward, nearest->normal) < 0;
    const Real length = glm::length(inward);
    if (!inside && length > side * std::sqrt(Real(3)) / 2) return {{}, true};
    if (inside && length > kReach * side) return {make_ball(place, nearest->distance)};
    inward = inside && length > body_.scale() * kMargin ? inward / length : -nearest->normal;
    return {touching_ball(nearest->point, inward, kReach * side, looked)};
  }

  // The largest ball up to a radius, about, that touches the surface at `contact` (Ma, Bae, Choi 2012).
  [[nodiscard]] EmptyBall touching_ball(const Vec3& contact, const Vec3& inward, Real radius,
                                        std::uint64_t& looked) const {
    for (int i = 0; i < kShrinkings; ++i) {
      const Vec3 center = contact + radius * inward;
      const auto nearest = body_.nearest(center, kSettled * radius, looked);
      if (!nearest) return make_ball(center, kSettled * radius);
      const Vec3 chord = nearest->point - contact;
      const Real along = glm::dot(chord, inward);
      const Real next = along > 0 ? glm::dot(chord, chord) / (2 * along) : 0;
      if (!(next > 0 && next < radius)) return make_ball(center, nearest->distance);
      radius = next;
    }
    return {};
  }

  // The ball of a cell that reaches out of it, and the part of it that all steps into are safe.
  [[nodiscard]] Fill face(const Cube& cell, const EmptyBall& ball) const {
    const Real radius = std::sqrt(Real(ball.radius2));
    const Real rounding = body_.scale() * kPlaneMargin;
    const Real spread = cell_ * std::sqrt(Real(3)) / 2 * (1 + kPlaneMargin) + rounding;
    const Real depth = body_.depth_from(middle_of(cell), spread, Vec3(ball.center), radius + rounding);
    const Real less = std::min(radius, depth - rounding);
    if (less < kLeastFacing * radius) return {cell.corner, cell.side, ball, {}};
    const EmptyBall facing(ball.center, static_cast<float>(less), EmptyBall::facing);
    if (less >= kNearlyAll * radius) return {cell.corner, cell.side, facing, {}};
    return {cell.corner, cell.side, EmptyBall(ball.center, static_cast<float>(radius), EmptyBall::followed),
            facing};
  }

  [[nodiscard]] EmptyBall make_ball(const Vec3& center, Real distance) const {
    const Vec3 room = body_.half_size() - glm::abs(center);
    const Real safe = std::min({distance, room.x, room.y, room.z}) - body_.scale() * kMargin;
    if (!(safe > 0)) return {};
    return EmptyBall(glm::vec3(center), static_cast<float>(safe), EmptyBall::plain);
  }

  const MeshBody& body_;
  Vec3 low_;
  Real cell_;
  std::uint64_t dearest_;
  const std::atomic<bool>& stop_;
};

void put(const Fill& fill, EmptyBalls& grid) {
  const auto number = static_cast<std::uint32_t>(grid.balls.size());
  grid.balls.push_back(fill.ball);
  if (fill.ball.promise() == EmptyBall::followed) grid.balls.push_back(fill.facing);
  const glm::ivec3 end = glm::min(fill.corner + fill.side, grid.size);
  for (int z = fill.corner.z; z < end.z; ++z)
    for (int y = fill.corner.y; y < end.y; ++y)
      for (int x = fill.corner.x; x < end.x; ++x)
        grid.cells[static_cast<std::size_t>((z * grid.size.y + y) * grid.size.x + x)] = number;
}

}  // namespace

std::optional<EmptyBalls> make_empty_balls(const MeshBody& body, int threads, int cells,
                                           const std::atomic<bool>& stop) {
  EmptyBalls grid;
  const glm::vec3 half(body.half_size());
  grid.cells_per_unit = static_cast<float>(cells) / (2 * static_cast<float>(largest(body.half_size())));
  grid.size = glm::max(glm::ivec3(glm::ceil(2.0f * half * grid.cells_per_unit)), glm::ivec3(1));
  grid.low = glm::vec3(grid.size) * (-0.5f / grid.cells_per_unit);
  grid.cells.assign(static_cast<std::size_t>(grid.size.x) * grid.size.y * grid.size.z, 0);

  const Filler filler(body, grid, stop);
  Filling coarse;
  Cube whole;
  whole.side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(cells, kBlock))));
  filler.divide(whole, kBlock, coarse);
  std::vector<Filling> fine(coarse.left.size());
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t(0), fine.size(),
                      [&](std::size_t i) { filler.divide(coarse.left[i], 0, fine[i]); });
  });
  if (stop) return std::nullopt;
  for (const Fill& fill : coarse.fills) put(fill, grid);
  for (const Filling& filling : fine)
    for (const Fill& fill : filling.fills) put(fill, grid);
  return grid;
}

EmptyBalls make_empty_balls(const MeshBody& body, int threads, int cells) {
  const std::atomic<bool> never{false};
  return *make_empty_balls(body, threads, cells, never);
}

}  // namespace meander
