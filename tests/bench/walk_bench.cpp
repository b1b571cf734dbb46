// The scalar walk's speed on one core: steps and walks a second in the exact sphere, and in a sphere and a
// torus knot of 100k triangles, at three mean free paths. Never a test: timings are for reading.
#include <benchmark/benchmark.h>

#include <cmath>

#include "bench/entries.h"
#include "trace/mesh_body.h"
#include "walk/analytic_worlds.h"
#include "walk/random_walk.h"

using namespace meander;

namespace {

struct SilentEvents {
  void segment(const Walker&, Real) const noexcept {}
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

// Walks that enter diffusely at points which `start` sets; albedo 0.99, implicit.
template <World W, class Start>
void run_walks(benchmark::State& state, const W& world, Real g, const Start& start) {
  const Real mean_free_path = static_cast<Real>(state.range(0)) / 1000;
  const WalkModel model{{Rgb(1 / mean_free_path), Rgb(Real(0.99)), g}, Estimator::implicit};
  std::uint32_t walk = 0;
  std::uint64_t steps = 0;
  double sum = 0;
  double squares = 0;
  SilentEvents events;
  for (auto _ : state) {
    foresee(start, 0, walk);
    Random random = stream(0, 0, walk++);
    Walker walker;
    start(walker, random);
    const WalkResult result = random_walk(world, model, walker, random, events);
    const double weight = result.end == WalkEnd::exited ? double{walker.weight.carried().x} : 0;
    sum += weight;
    squares += weight * weight;
    steps += walker.steps;
  }
  const double mean = sum / walk;
  state.counters["steps/s"] = benchmark::Counter(static_cast<double>(steps), benchmark::Counter::kIsRate);
  state.counters["walks/s"] = benchmark::Counter(walk, benchmark::Counter::kIsRate);
  state.counters["steps/walk"] = static_cast<double>(steps) / walk;
  state.counters["escaped"] = mean;
  state.counters["standard_error"] = std::sqrt((squares / walk - mean * mean) / walk);
}

void sphere(benchmark::State& state, Real g) { run_walks(state, SphereWorld{1}, g, enter_sphere); }

// One ray in the tree a step.
struct TreeWorld {
  const MeshBody& body;
  [[nodiscard]] Crossing first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
    return body.first_crossing_in_tree(p, d, distance);
  }
};

void mesh(benchmark::State& state, const Mesh& mesh, Real g) {
  const Device device = make_device(1);
  DVec3 center;
  const MeshBody body(device.get(), mesh, DMat3(1), center);
  if (state.range(1) != 0)
    run_walks(state, TreeWorld{body}, g, MeshEntry{mesh, center});
  else
    run_walks(state, body, g, MeshEntry{mesh, center});
}

void mesh_sphere(benchmark::State& state, Real g) {
  mesh(state, make_sphere_mesh(71), g);
}  // 100 820 triangles
void torus_knot(benchmark::State& state, Real g) { mesh(state, make_torus_knot(), g); }  // 100 000 triangles

const std::vector<std::string> kMeshArgs{"mfp_thousandths", "tree"};

}  // namespace

BENCHMARK_CAPTURE(sphere, isotropic, Real(0))->ArgName("mfp_thousandths")->Arg(100)->Arg(30)->Arg(10);
BENCHMARK_CAPTURE(sphere, g08, Real(0.8))->ArgName("mfp_thousandths")->Arg(100)->Arg(30)->Arg(10);
BENCHMARK_CAPTURE(mesh_sphere, isotropic, Real(0))->ArgNames(kMeshArgs)->ArgsProduct({{100, 30, 10}, {1, 0}});
BENCHMARK_CAPTURE(torus_knot, isotropic, Real(0))->ArgNames(kMeshArgs)->ArgsProduct({{100, 30, 10}, {1, 0}});
BENCHMARK_CAPTURE(torus_knot, g08, Real(0.8))->ArgNames(kMeshArgs)->ArgsProduct({{100, 30, 10}, {1, 0}});

BENCHMARK_MAIN();
