// The walk in lanes on one core, in the cases of walk_bench.cpp. Never a test: timings are for reading.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "bench/entries.h"
#include "trace/empty_balls.h"
#include "walk/analytic_worlds.h"
#include "walk/lane_walks.h"

using namespace meander;

namespace {

// Walks without end, counted as they leave.
template <class Start>
struct Endless {
  const Start& launch;
  std::uint64_t seed = 0;
  std::uint64_t walks = 0;
  std::uint64_t steps = 0;
  double sum = 0;
  double squares = 0;
  std::uint64_t left = 0;
  std::uint32_t next = 0;

  [[nodiscard]] bool start(int, Walker& walker, Random& random) noexcept {
    if (left == 0) return false;
    --left;
    foresee(launch, seed, next);
    random = stream(seed, 0, next++);
    walker = Walker{};
    launch(walker, random);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& result, Walker& walker, Random& random) noexcept {
    const double weight = result.end == WalkEnd::exited ? double{walker.weight.carried().x} : 0;
    ++walks;
    sum += weight;
    squares += weight * weight;
    steps += walker.steps;
    return start(lane, walker, random);
  }
  void collided(int, Real, Walker&, Random&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

template <class W, class Start>
void run_lanes(benchmark::State& state, const W& world, const LaneModel& model, const Start& start) {
  const InstructionSet set = instruction_sets()[std::min<std::size_t>(
      static_cast<std::size_t>(state.range(1)), instruction_sets().size() - 1)];
  Endless<Start> client{start, static_cast<std::uint64_t>(state.thread_index())};
  std::uint64_t rays = 0;
  for (auto _ : state) {
    client.left = 100000;
    LaneWalks walks(set, world, model, client);
    (void)walks.run();
    rays += walks.counters().rays;
  }
  const auto walks = static_cast<double>(client.walks);
  const double mean = client.sum / walks;
  using benchmark::Counter;
  state.counters["steps/s"] = Counter(static_cast<double>(client.steps), Counter::kIsRate);
  state.counters["walks/s"] = Counter(walks, Counter::kIsRate);
  state.counters["rays/s"] = Counter(static_cast<double>(rays), Counter::kIsRate);
  const auto of_a_thread = [&](const char* name, double value) {
    state.counters[name] = Counter(value, Counter::kAvgThreads);
  };
  of_a_thread("steps/walk", static_cast<double>(client.steps) / walks);
  of_a_thread("rays/walk", static_cast<double>(rays) / walks);
  of_a_thread("escaped", mean);
  of_a_thread("standard_error", std::sqrt((client.squares / walks - mean * mean) / walks));
}

LaneModel model_of(benchmark::State& state, Real g) {
  const Real mean_free_path = static_cast<Real>(state.range(0)) / 1000;
  LaneModel model;
  model.medium = {Rgb(1 / mean_free_path), Rgb(Real(0.99)), g};
  return model;
}

void lanes_sphere(benchmark::State& state, Real g) {
  LaneModel model = model_of(state, g);
  model.region.kind = SafeRegion::Kind::ellipsoid;
  run_lanes(state, SphereWorld{1}, model, enter_sphere);
}

void lanes_mesh(benchmark::State& state, const Mesh& mesh, Real g) {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  const auto begin = std::chrono::steady_clock::now();
  const EmptyBalls balls = make_empty_balls(body, 2, static_cast<int>(state.range(2)));
  const double build = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  LaneModel model = model_of(state, g);
  model.region.kind = SafeRegion::Kind::balls;
  model.region.balls = &balls;
  run_lanes(state, body, model, MeshEntry{mesh, center});
  state.counters["build_s"] = {build, benchmark::Counter::kAvgThreads};
  state.counters["field_MB"] = {static_cast<double>(balls.bytes()) / 1e6, benchmark::Counter::kAvgThreads};
}

void lanes_mesh_sphere(benchmark::State& state, Real g) { lanes_mesh(state, make_sphere_mesh(71), g); }
void lanes_torus_knot(benchmark::State& state, Real g) { lanes_mesh(state, make_torus_knot(), g); }

// What a kernel's flags cost: the same grey isotropic walk by kernels that could do more.
void lanes_flags(benchmark::State& state, bool chromatic, bool anisotropic) {
  LaneModel model = model_of(state, anisotropic ? Real(1e-30) : Real(0));
  if (chromatic) model.medium.sigma_t.y *= 1 + Real(0x1p-20);
  model.region.kind = SafeRegion::Kind::ellipsoid;
  run_lanes(state, SphereWorld{1}, model, enter_sphere);
}

const std::vector<std::string> kArgs{"mfp_thousandths", "isa"};
const std::vector<std::string> kMeshArgs{"mfp_thousandths", "isa", "cells"};

}  // namespace

BENCHMARK_CAPTURE(lanes_sphere, isotropic, Real(0))
    ->ArgNames(kArgs)
    ->Args({10, 0})
    ->Args({10, 1})
    ->Args({10, 2})
    ->Args({10, 3})
    ->Args({100, 3});
BENCHMARK_CAPTURE(lanes_sphere, g08, Real(0.8))->ArgNames(kArgs)->Args({10, 3});
BENCHMARK_CAPTURE(lanes_flags, none, false, false)->ArgNames(kArgs)->Args({10, 3})->Args({10, 2});
BENCHMARK_CAPTURE(lanes_flags, anisotropic, false, true)->ArgNames(kArgs)->Args({10, 3})->Args({10, 2});
BENCHMARK_CAPTURE(lanes_flags, chromatic, true, false)->ArgNames(kArgs)->Args({10, 3})->Args({10, 2});
BENCHMARK_CAPTURE(lanes_flags, both, true, true)->ArgNames(kArgs)->Args({10, 3})->Args({10, 2});
BENCHMARK_CAPTURE(lanes_mesh_sphere, isotropic, Real(0))
    ->ArgNames(kMeshArgs)
    ->Args({10, 3, 128})
    ->Args({10, 3, 64})
    ->Args({10, 3, 96})
    ->Args({100, 3, 64})
    ->Args({1000, 3, 64});
BENCHMARK_CAPTURE(lanes_torus_knot, isotropic, Real(0))
    ->ArgNames(kMeshArgs)
    ->Args({10, 3, 128})
    ->Args({10, 3, 64})
    ->Args({100, 3, 128})
    ->Args({100, 3, 64})
    ->Args({100, 3, 32})
    ->Args({300, 3, 64})
    ->Args({300, 3, 32})
    ->Args({300, 3, 16})
    ->Args({3000, 3, 64})
    ->Args({3000, 3, 32})
    ->Args({3000, 3, 16});

// By the number of threads, each with a body of its own.
BENCHMARK_CAPTURE(lanes_sphere, by_threads, Real(0))
    ->ArgNames(kArgs)
    ->Args({10, 3})
    ->ThreadRange(1, 2)
    ->UseRealTime();
BENCHMARK_CAPTURE(lanes_mesh_sphere, by_threads, Real(0))
    ->ArgNames(kMeshArgs)
    ->Args({10, 3, 64})
    ->ThreadRange(1, 2)
    ->UseRealTime();
BENCHMARK_CAPTURE(lanes_torus_knot, by_threads, Real(0))
    ->ArgNames(kMeshArgs)
    ->Args({10, 3, 64})
    ->Args({100, 3, 64})
    ->ThreadRange(1, 2)
    ->UseRealTime();
