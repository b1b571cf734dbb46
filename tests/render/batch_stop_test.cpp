// A batch is stopped between two samples, also where none of them ever walks.
#include <doctest/doctest.h>

#include <atomic>

#include "render/small_scene.h"
#include "walk/path_batch.h"

namespace meander {
namespace {

constexpr std::size_t kSamples = 100000;

// Rays that meet nothing, the first one aside where one is to walk; stop is asked with the sample kAsked.
struct Misses {
  static constexpr std::size_t kAsked = 40;

  const Geometry& geometry;
  std::atomic<bool>& stop;
  bool first_walks;
  std::size_t drawn = 0;
  BatchSample sample = {};

  [[nodiscard]] const BatchSample* next() {
    if (drawn == kSamples) return nullptr;
    sample = {drawn, {}, Random{{1, 0, 0, static_cast<std::uint32_t>(drawn)}}};
    sample.start.ray = {{1.2, -0.2, 6}, {0, 0, first_walks && drawn == 0 ? Real(-1) : Real(1)}};
    sample.start.hit = geometry.closest_hit(sample.start.ray);
    if (++drawn == kAsked) stop = true;
    return &sample;
  }
  void done(std::size_t, const RadianceSink&) {}
};

}  // namespace

TEST_CASE("no sample is drawn once a batch is asked to stop, whether others walk or none does") {
  const Job job = make_job(mixed_scene(), 1);
  for (const bool first_walks : {false, true}) {
    CAPTURE(first_walks);
    std::atomic<bool> stop{false};
    REQUIRE(prepare_walks(job, stop));
    PathTracer<Geometry> tracer(*job.scene, *job.geometry, path_options(job, stop));
    Misses misses{*job.geometry, stop, first_walks};
    PathBatch<Geometry, RadianceSink, Misses> batch(*job.scene, *job.geometry, tracer, misses);
    CHECK_FALSE(batch.run(job.instruction_set));
    CHECK(misses.drawn == Misses::kAsked);
    CHECK((tracer.counters().walks > 0) == first_walks);
  }
}

}  // namespace meander
