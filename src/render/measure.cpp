#include "render/measure.h"

#include <vector>

#include "core/timer.h"
#include "render/measured_walk.h"
#include "render/parallel.h"
#include "walk/lane_walks.h"

namespace meander {
namespace {

constexpr std::uint64_t kBlock = 8192;  // walks a task; fixed, so that sums do not depend on the threads

// Walks of a block, in the order in which they are begun.
struct BlockWalks {
  const MeasureJob& job;
  std::uint64_t next;
  std::uint64_t last;

  [[nodiscard]] bool draw(Random& random) noexcept {
    if (next == last) return false;
    random = stream(job.seed, static_cast<std::uint32_t>(next >> 32), static_cast<std::uint32_t>(next));
    ++next;
    return true;
  }
};

// Walks of a block in lanes. They end in an order that depends on the block alone.
struct BlockLanes {
  BlockWalks& block;
  const std::atomic<bool>& stopped;
  std::vector<MeasuredWalk> walks;  // by lane

  [[nodiscard]] bool start(int lane, Walker& walker, Random& random) {
    MeasuredWalk& walk = walks[static_cast<std::size_t>(lane)];
    while (block.draw(random)) {
      if (walk.begin(random)) {
        walker = walk.walker();
        return true;
      }
      walk.record();
    }
    return false;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& walked, Walker& walker, Random& random) {
    MeasuredWalk& walk = walks[static_cast<std::size_t>(lane)];
    if (walk.end(walked, walker, random)) {
      walker = walk.walker();
      return true;
    }
    walk.record();
    return start(lane, walker, random);
  }
  void collided(int, Real, Walker&, Random&) const noexcept {}
  void tally(int lane, double path, double absorbed) noexcept {
    walks[static_cast<std::size_t>(lane)].tally(path, absorbed);
  }
  [[nodiscard]] bool stop() const noexcept { return stopped.load(std::memory_order_relaxed); }
};

// Per-walk sums over bins are made one walk at a time.
bool in_lanes(const MeasureJob& job) noexcept {
  return job.walk == WalkCode::batch && job.estimator == Estimator::implicit && !job.bins.any();
}

// A shape to measure: its world, the same as a region of space, and where the light enters.
template <World W>
struct Shape {
  W world;
  SafeRegion region;
  Real top = 0;
};

// A block of walks; fewer than asked for when it was interrupted.
template <World W>
Measurement measure_block(const MeasureJob& job, const Shape<W>& shape, BlockWalks block,
                          const std::atomic<bool>& stop) {
  Measurement result;
  result.resolved = ResolvedBins(job.bins);
  MeasuredWalk walk(job, shape.top, result, stop);
  if (in_lanes(job)) {
    const LaneModel model{measured_medium(job), shape.region, false};
    BlockLanes lanes{block, stop, std::vector<MeasuredWalk>(kLanes, walk)};
    (void)LaneWalks(job.instruction_set, shape.world, model, lanes).run();
    return result;
  }
  Random random({1, 0, 0, 0});
  while (!stop.load(std::memory_order_relaxed) && block.draw(random)) {
    if (walk.begin(random) && !walk.travel(shape.world, random)) break;
    walk.record();
  }
  return result;
}

// -thickness <= z <= 0.
SafeRegion layer(float thickness) noexcept {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  SafeRegion region;
  for (int axis = 0; axis < 3; ++axis) {
    region.low[axis] = axis == 2 ? -thickness : -kEndless;
    region.high[axis] = axis == 2 ? 0 : kEndless;
  }
  return region;
}

SafeRegion ball(float radius) noexcept {
  SafeRegion region;
  region.kind = SafeRegion::Kind::ellipsoid;
  for (int axis = 0; axis < 3; ++axis) region.map[axis][axis] = 1 / radius;
  return region;
}

Measurement measure_block(const MeasureJob& job, std::uint64_t first, const std::atomic<bool>& stop) {
  const BlockWalks block{job, first, std::min(first + kBlock, job.walks)};
  if (const auto* slab = std::get_if<MeasuredSlab>(&job.shape)) {
    const auto tau = static_cast<Real>(slab->tau);
    return measure_block(job, Shape<SlabWorld>{{tau}, layer(static_cast<float>(tau))}, block, stop);
  }
  if (const auto* sphere = std::get_if<MeasuredSphere>(&job.shape)) {
    const auto radius = static_cast<Real>(sphere->tau_radius);
    return measure_block(job, Shape<SphereWorld>{{radius}, ball(static_cast<float>(radius)), radius}, block,
                         stop);
  }
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  return measure_block(job, Shape<HalfSpaceWorld>{{}, layer(kEndless)}, block, stop);
}

}  // namespace

void Measurement::merge(const Measurement& other) {
  reflectance.merge(other.reflectance);
  transmittance.merge(other.transmittance);
  unscattered_reflectance.merge(other.unscattered_reflectance);
  unscattered_transmittance.merge(other.unscattered_transmittance);
  specular_reflectance.merge(other.specular_reflectance);
  absorptance.merge(other.absorptance);
  mean_path_length.merge(other.mean_path_length);
  from_below.merge(other.from_below);
  resolved.merge(other.resolved);
  walks += other.walks;
  steps += other.steps;
  leaked_walks += other.leaked_walks;
}

Measurement measure(const MeasureJob& job, const std::atomic<bool>& stop) {
  const Timer timer;
  const std::uint64_t blocks = (job.walks + kBlock - 1) / kBlock;
  // Blocks are run in waves, so that memory does not grow with the number of walks.
  constexpr std::uint64_t kWave = 4096;
  Measurement total;
  for (std::uint64_t wave = 0; wave < blocks; wave += kWave) {
    std::vector<Measurement> results(std::min(kWave, blocks - wave));
    parallel_for(job.threads, results.size(),
                 [&](std::size_t i) { results[i] = measure_block(job, (wave + i) * kBlock, stop); });
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::uint64_t expected = std::min(kBlock, job.walks - (wave + i) * kBlock);
      if (results[i].walks != expected) {
        total.seconds = timer.seconds();
        return total;
      }
      total.merge(results[i]);
    }
  }
  total.seconds = timer.seconds();
  return total;
}

}  // namespace meander
