#include "render/measure.h"

#include <vector>

#include "core/timer.h"
#include "render/parallel.h"
#include "walk/analytic_worlds.h"

namespace meander {
namespace {

constexpr std::uint64_t kBlock = 8192;  // walks a task; fixed, so that sums do not depend on the threads

// What one walk leaves in the medium and how far it flies, in the first channel: all three are alike.
struct Tally {
  const std::atomic<bool>& stop_flag;
  double absorptance = 0;
  double path = 0;

  void segment(const Walker& walker, Real distance) noexcept {
    path += double{walker.weight.carried().x} * double{distance};
  }
  void absorbed(const Rgb& amount) noexcept { absorptance += double{amount.x}; }
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return stop_flag.load(std::memory_order_relaxed); }
};

Vec3 entry_direction(const MeasureJob& job, Random& random) noexcept {
  if (job.incidence.diffuse || job.boundary == Boundary::diffuse) {
    const Real u1 = random.next();
    const Real u2 = random.next();
    return -sample_cosine_hemisphere({u1, u2});
  }
  const double mu = job.incidence.cosine;
  return Vec3(std::sqrt((1 - mu) * (1 + mu)), 0, -mu);
}

// One walk from the surface at z = `top`; false when it was interrupted.
template <World W>
bool measure_walk(const MeasureJob& job, const W& world, Real top, Random& random, Tally tally,
                  Measurement& result) noexcept {
  const WalkModel model{{Rgb(1), Rgb(static_cast<Real>(job.albedo)), static_cast<Real>(job.g)},
                        job.estimator};
  Walker walker;
  walker.position = {0, 0, top};
  walker.direction = entry_direction(job, random);
  const WalkResult walk = random_walk(world, model, walker, random, tally);
  if (walk.end == WalkEnd::interrupted) return false;
  const double weight = walk.end == WalkEnd::exited ? double{walker.weight.carried().x} : 0;
  const bool back = std::holds_alternative<MeasuredSphere>(job.shape) || walk.crossing.normal.z > 0;
  const bool unscattered = walker.weight.order == 0;
  result.reflectance.add(back ? weight : 0);
  result.transmittance.add(back ? 0 : weight);
  result.unscattered_reflectance.add(0);
  result.unscattered_transmittance.add(unscattered ? weight : 0);
  result.specular_reflectance.add(0);
  result.absorptance.add(tally.absorptance);
  result.mean_path_length.add(tally.path);
  result.walks += 1;
  result.steps += walker.steps;
  result.leaked_walks += walk.end == WalkEnd::leaked;
  return true;
}

// A block of walks; fewer than asked for when it was interrupted.
template <World W>
Measurement measure_block(const MeasureJob& job, const W& world, Real top, std::uint64_t first,
                          const std::atomic<bool>& stop) noexcept {
  Measurement result;
  const std::uint64_t last = std::min(first + kBlock, job.walks);
  for (std::uint64_t walk = first; walk < last; ++walk) {
    if (stop.load(std::memory_order_relaxed)) break;
    Random random =
        stream(job.seed, static_cast<std::uint32_t>(walk >> 32), static_cast<std::uint32_t>(walk));
    Tally tally{stop};
    if (!measure_walk(job, world, top, random, tally, result)) break;
  }
  return result;
}

Measurement measure_block(const MeasureJob& job, std::uint64_t first,
                          const std::atomic<bool>& stop) noexcept {
  if (const auto* slab = std::get_if<MeasuredSlab>(&job.shape))
    return measure_block(job, SlabWorld{static_cast<Real>(slab->tau)}, 0, first, stop);
  if (const auto* sphere = std::get_if<MeasuredSphere>(&job.shape)) {
    const Real radius = static_cast<Real>(sphere->tau_radius);
    return measure_block(job, SphereWorld{radius}, radius, first, stop);
  }
  return measure_block(job, HalfSpaceWorld{}, 0, first, stop);
}

}  // namespace

void Measurement::merge(const Measurement& other) noexcept {
  reflectance.merge(other.reflectance);
  transmittance.merge(other.transmittance);
  unscattered_reflectance.merge(other.unscattered_reflectance);
  unscattered_transmittance.merge(other.unscattered_transmittance);
  specular_reflectance.merge(other.specular_reflectance);
  absorptance.merge(other.absorptance);
  mean_path_length.merge(other.mean_path_length);
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
