// Whole scenes: seconds to 2 % noise over the object's pixels, with scalar walks and with lanes. What takes
// longer than the limit is extrapolated, noise falling as 1 / sqrt(seconds).
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/timer.h"
#include "io/scene_file.h"
#include "render/progressive.h"

using namespace meander;

namespace {

constexpr double kNoise = 0.02;
constexpr double kLongest = 8;  // seconds

void to_noise(benchmark::State& state, const char* file, WalkCode walk) {
  Job job;
  job.threads = static_cast<int>(state.range(0));
  job.walk = walk;
  job.instruction_set = instruction_sets()[std::min<std::size_t>(static_cast<std::size_t>(state.range(1)),
                                                                 instruction_sets().size() - 1)];
  job.scene = std::make_shared<const Scene>(
      load_scene(MEANDER_SOURCE_DIR "/tests/bench/scenes/" + std::string(file), {}).scene);
  const std::atomic<bool> stop{false};
  Rendering done;
  double start_up = 0;
  for (auto _ : state) {
    const Timer timer;
    job.geometry = std::make_shared<const Geometry>(*job.scene, job.threads);
    (void)prepare_walks(job, stop);
    start_up = timer.seconds();
    ++job.seed;
    done = render(job, {{}, kLongest, kNoise}, stop, [](const Rendering&) {});
    const double reached = done.noise.noise / kNoise;
    state.SetIterationTime(done.seconds * reached * reached);
  }
  using benchmark::Counter;
  state.counters["start_up_s"] = start_up;
  state.counters["seconds"] = done.seconds;
  state.counters["noise"] = done.noise.noise;
  state.counters["spp"] = static_cast<double>(done.spp);
  state.counters["steps/s"] = static_cast<double>(done.counters.steps) / done.seconds;
  state.counters["walks/s"] = static_cast<double>(done.counters.walks) / done.seconds;
  state.counters["rays/s"] = static_cast<double>(done.counters.rays) / done.seconds;
}

void compare_walks(const char* file) {
  for (const WalkCode walk : {WalkCode::scalar, WalkCode::batch}) {
    const std::string name =
        std::string("to_2_percent/") + file + (walk == WalkCode::scalar ? "/scalar" : "/batch");
    auto* entry = benchmark::RegisterBenchmark(name.c_str(), to_noise, file, walk);
    entry->ArgNames({"threads", "isa"})->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);
    entry->Args({2, 3});
    if (walk == WalkCode::scalar) continue;
    entry->Args({1, 3})->Args({2, 2})->Args({2, 0});
  }
}

const bool kRegistered = [] {
  for (const char* file : {"sphere.toml", "white_sphere.toml", "lit_knot.toml"}) compare_walks(file);
  return true;
}();

}  // namespace
