// Paths in lanes against scalar paths. Both draw the same random numbers for the same sample, so the images
// agree but for rounding, and for the few samples that rounding sends another way.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <thread>

#include "render/measure.h"
#include "render/small_scene.h"
#include "render/tile_pass.h"
#include "stats/image_error.h"
#include "walk/path_batch.h"

using namespace meander;

namespace {

// Two matched chromatic bodies that touch, before and beside others, so that paths go from body to body.
Scene crowded_scene() {
  Scene scene = mixed_scene();
  Material skin = translucent("skin", {Rgb(2, 4, 3), Rgb(Real(0.97), Real(0.9), Real(0.8)), Real(-0.3)},
                              Boundary::dielectric);
  std::get<TranslucentMaterial>(skin.kind).ior = 1.4;
  Material rough = skin;
  rough.name = "rough";
  std::get<TranslucentMaterial>(rough.kind).roughness = 0.4;
  scene.materials.push_back(skin);
  scene.materials.push_back(rough);
  scene.objects.push_back({"box", BoxShape{}, 0, {{-1, 0, 2}, {0, 30, 0}, DVec3(0.5, 0.4, 0.1)}});
  scene.objects.push_back({"egg", SphereShape{}, 3, {{0.4, 0.8, 0.5}, {}, DVec3(0.4, 0.5, 0.3)}});
  scene.objects.push_back({"die", BoxShape{}, 4, {{0.2, -0.6, 1.6}, {20, 40, 0}, DVec3(0.3)}});
  return scene;
}

// Share of the values in which two films differ by more than rounding.
double differing(const Film& a, const Film& b) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      differ += std::abs(a.pixels[i].mean[c] - b.pixels[i].mean[c]) > 1e-3 * (a.pixels[i].mean[c] + 1e-3);
  return static_cast<double>(differ) / (3.0 * static_cast<double>(a.pixels.size()));
}

Job scalar(Job job) {
  job.walk = WalkCode::scalar;
  return job;
}

// Scalar paths with all that paths in lanes know.
Rendering oracle_of(const Job& job, std::uint64_t spp) {
  const std::atomic<bool> stop{false};
  REQUIRE(prepare_walks(job, stop));
  const Tile area = area_of(job);
  Rendering oracle;
  oracle.film = Film(area.x1 - area.x0, area.y1 - area.y0);
  const CameraRays camera = camera_of(job);
  const EmptyPixels empty(job, camera);
  const TilePass pass{job, camera, empty, area, path_options(job, stop), spp, {}, oracle.film, false};
  const TileResult result = pass.render({0, 0, oracle.film.width, oracle.film.height});
  REQUIRE(result.complete);
  oracle.counters = result.counters;
  return oracle;
}

// Samples all over a film, of which some later one cannot be had.
struct FailingSource {
  const CameraRays& camera;
  const Geometry& geometry;
  int left = 3000;
  BatchSample sample = {};
  [[nodiscard]] const BatchSample* next() {
    if (left == 0) throw std::bad_alloc();
    sample.random = stream(1, 0, static_cast<std::uint32_t>(left--));
    sample.start.ray = camera.at(sample.random.next(), sample.random.next());
    sample.start.hit = geometry.closest_hit(sample.start.ray);
    return &sample;
  }
  static void done(std::size_t, const RadianceSink&) {}
};

bool same_bytes(const Film& a, const Film& b) {
  return std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Pixel)) == 0;
}

}  // namespace

TEST_CASE("memory that runs out among lanes is an exception, not the end of the process") {
  const Job job = make_job(mixed_scene(), 1);
  const std::atomic<bool> stop{false};
  REQUIRE(prepare_walks(job, stop));
  PathTracer<Geometry> tracer(*job.scene, *job.geometry, path_options(job, stop));
  const CameraRays camera = camera_of(job);
  FailingSource source{camera, *job.geometry};
  PathBatch<Geometry, RadianceSink, FailingSource> batch(*job.scene, *job.geometry, tracer, source);
  CHECK_THROWS_AS((void)batch.run(job.instruction_set), std::bad_alloc);
  CHECK(tracer.counters().walks > 128);
}

TEST_CASE("lanes render what scalar paths render, sample by sample, on every instruction set") {
  for (const bool crowded : {false, true}) {
    Job job = make_job(crowded ? crowded_scene() : mixed_scene(), 2);
    const Rendering oracle = oracle_of(job, 16);
    for (const InstructionSet set : instruction_sets()) {
      CAPTURE(name_of(set));
      job.instruction_set = set;
      const Rendering lanes = render_spp(job, 16);
      CHECK(differing(oracle.film, lanes.film) < 0.05);
      const ZTest test = z_test(resolve(oracle.film), resolve(lanes.film), {}, {});
      CHECK(test.passed);
      CHECK(lanes.non_finite == 0);
      CHECK(lanes.counters.leaked_walks == oracle.counters.leaked_walks);
      const auto ratio = [](std::uint64_t a, std::uint64_t b) { return double(a) / double(b); };
      CHECK(ratio(lanes.counters.walks, oracle.counters.walks) == doctest::Approx(1).epsilon(0.003));
      CHECK(ratio(lanes.counters.steps, oracle.counters.steps) == doctest::Approx(1).epsilon(0.01));
      CHECK(lanes.counters.rays < oracle.counters.rays);
    }
  }
}

TEST_CASE("paths in lanes give the same bytes whatever the threads, the tiles and the passes") {
  Job job = make_job(crowded_scene(), 1);
  const Rendering one = render_spp(job, 6);
  job.threads = 2;
  CHECK(same_bytes(one.film, render_spp(job, 6).film));
  // One pass over all: larger tiles than the passes of 1, 1, 2 and 2 samples have.
  const std::atomic<bool> stop{false};
  Rendering whole;
  REQUIRE(Passes(job, stop).advance({}, 6, whole));
  CHECK(same_bytes(one.film, whole.film));
  CHECK_FALSE(same_bytes(one.film, render_spp(scalar(job), 6).film));
}

TEST_CASE("a pass in lanes is interrupted in the middle of its walks") {
  Scene scene = mixed_scene();
  scene.materials[0] = translucent("dense", {Rgb(100000), Rgb(1), 0}, Boundary::matched);
  scene.camera.look_from = DVec3(-1, 0, 0) + DVec3(3.0 / 3.62, 0, 0);  // in the middle of the tube
  const Job job = make_job(std::move(scene), 2);
  std::atomic<bool> stop{false};
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop = true;
  });
  Rendering after;
  CHECK_FALSE(Passes(job, stop).advance({}, 1, after));
  stopper.join();
}

TEST_CASE("where lanes cannot walk, scalar code does: analog walks, and bodies that hold lights") {
  Scene scene = mixed_scene();
  Job job = make_job(scene, 2);
  job.estimator = Estimator::analog;
  CHECK_FALSE(uses_lanes(job));
  CHECK(same_bytes(render_spp(job, 2).film, render_spp(scalar(job), 2).film));
  scene.lights.push_back({"inside", SphereLight{{-1, 0, 0}, 0.1, Rgb(5)}, false});
  const Job lit = make_job(scene, 2);
  CHECK(uses_lanes(lit));
  CHECK_FALSE(lit.geometry->walks_in_lanes(0));
  CHECK(lit.geometry->walks_in_lanes(1));
}

TEST_CASE("lanes measure what scalar walks measure, whatever the threads") {
  MeasureJob job;
  job.albedo = 0.95;
  job.walks = 20000;
  job.threads = 2;
  const std::atomic<bool> stop{false};
  const auto check = [&](const auto& shape, Boundary boundary, double g) {
    job.shape = shape;
    job.boundary = boundary;
    job.ior = boundary == Boundary::matched ? 1 : 1.4;
    job.g = g;
    job.walk = WalkCode::scalar;
    const Measurement oracle = measure(job, stop);
    job.walk = WalkCode::batch;
    const Measurement lanes = measure(job, stop);
    const auto agree = [](const Moments& a, const Moments& b) {
      CHECK(a.count == b.count);
      CHECK(std::abs(a.mean - b.mean) <= 0.3 * a.standard_error() + 1e-12);
    };
    agree(oracle.reflectance, lanes.reflectance);
    agree(oracle.transmittance, lanes.transmittance);
    agree(oracle.absorptance, lanes.absorptance);
    agree(oracle.mean_path_length, lanes.mean_path_length);
    agree(oracle.unscattered_transmittance, lanes.unscattered_transmittance);
    MeasureJob single = job;
    single.threads = 1;
    const Measurement alone = measure(single, stop);
    CHECK(alone.mean_path_length.mean == lanes.mean_path_length.mean);
    CHECK(alone.absorptance.mean == lanes.absorptance.mean);
  };
  check(MeasuredSlab{3}, Boundary::matched, 0);
  check(MeasuredSlab{3}, Boundary::dielectric, 0.8);
  check(MeasuredSphere{5}, Boundary::diffuse, 0);
  check(MeasuredSphere{5}, Boundary::matched, -0.4);
  check(MeasuredHalfSpace{}, Boundary::dielectric, 0);
}
