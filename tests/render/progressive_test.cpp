#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "render/first_hits.h"
#include "render/small_scene.h"
#include "stats/moments.h"

using namespace meander;

namespace {

bool same_bytes(const Film& a, const Film& b) {
  if (a.pixels.size() != b.pixels.size()) return false;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (a.pixels[i].mean != b.pixels[i].mean || a.pixels[i].m2 != b.pixels[i].m2 ||
        a.pixels[i].count != b.pixels[i].count)
      return false;
  return true;
}

}  // namespace

TEST_CASE("one thread, two threads and four give the same bytes; another seed does not") {
  const Rendering one = render_spp(make_job(mixed_scene(), 1), 8);
  const Rendering two = render_spp(make_job(mixed_scene(), 2), 8);
  const Rendering four = render_spp(make_job(mixed_scene(), 4), 8);
  CHECK(same_bytes(one.film, two.film));
  CHECK(same_bytes(one.film, four.film));
  CHECK(one.counters.steps == two.counters.steps);
  Job other = make_job(mixed_scene(), 2);
  other.seed = 1;
  CHECK_FALSE(same_bytes(one.film, render_spp(other, 8).film));
}

TEST_CASE("how the samples are cut into passes does not show") {
  const Job job = make_job(mixed_scene(), 2);
  const Rendering whole = render_spp(job, 6);  // passes of 1, 1, 2, 2
  Film film(job.scene->film.width, job.scene->film.height);
  // The same samples one by one, as separate jobs.
  std::vector<Film> singles;
  for (std::uint32_t k = 0; k < 6; ++k) {
    Job single = job;
    single.first_sample = k;
    singles.push_back(render_spp(single, 1).film);
  }
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    for (const Film& single : singles) {
      const auto& mean = single.pixels[i].mean;
      film.pixels[i].add(Rgb(mean[0], mean[1], mean[2]));
    }
  }
  CHECK(same_bytes(whole.film, film));
}

TEST_CASE("a crop renders the very pixels of the whole image") {
  Job job = make_job(mixed_scene(), 2);
  const Rendering whole = render_spp(job, 4);
  job.crop = Tile{7, 3, 29, 20};
  const Rendering part = render_spp(job, 4);
  REQUIRE(part.film.width == 22);
  REQUIRE(part.film.height == 17);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 22; ++x) CHECK(part.film.at(x, y).mean == whole.film.at(x + 7, y + 3).mean);
}

TEST_CASE("every pixel gets the samples that were asked for") {
  const Rendering rendering = render_spp(make_job(mixed_scene(), 2), 11);
  CHECK(rendering.spp == 11);
  for (const Pixel& pixel : rendering.film.pixels) CHECK(pixel.count == 11);
  CHECK(rendering.non_finite == 0);
  CHECK(rendering.counters.leaked_walks == 0);
  CHECK(rendering.counters.walks > 0);
}

TEST_CASE("an interrupted pass is discarded whole") {
  const Job job = make_job(mixed_scene(), 2);
  std::atomic<bool> stop{false};
  int passes = 0;
  const Rendering stopped = render(job, {}, stop, [&](const Rendering&) { stop = ++passes == 3; });
  CHECK(stopped.spp == 4);
  CHECK(same_bytes(stopped.film, render_spp(job, 4).film));
  stop = true;
  CHECK(render(job, {}, stop, [](const Rendering&) {}).spp == 0);
}

TEST_CASE("a walk without end is stopped in the middle") {
  Scene scene = mixed_scene();
  scene.materials[0] = translucent("dense", {Rgb(100000), Rgb(1), 0}, Boundary::matched);
  const Job job = make_job(std::move(scene), 2);
  const std::atomic<bool> stop{true};
  PathTracer<Geometry> tracer(*job.scene, *job.geometry, {Estimator::implicit, false, false, &stop});
  Random random = stream(0, 0, 0);
  RadianceSink sink;
  // From inside the tube, half a million mean free paths from anywhere.
  const DVec3 inside = DVec3(-1, 0, 0) + DVec3(3.0 / 3.62, 0, 0);
  CHECK_FALSE(tracer.trace({inside, {0, 0, 1}}, random, sink));
  CHECK(tracer.counters().steps == kStopInterval);
}

TEST_CASE("rendering stops when the noise asked for is reached") {
  const Job job = make_job(mixed_scene(), 2);
  const std::atomic<bool> stop{false};
  const Rendering rendering = render(job, {{}, {}, 0.2}, stop, [](const Rendering&) {});
  CHECK(rendering.noise.noise <= 0.2);
  CHECK(rendering.noise.noise > 0.17);
}

TEST_CASE("the object mask holds the pixels that lie wholly on a translucent object") {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, 4.0};
  scene.film = {40, 40};
  scene.materials.push_back(translucent("m", {Rgb(1), Rgb(1), 0}, Boundary::matched));
  scene.objects.push_back({"ball", SphereShape{}, 0, {}});
  const std::atomic<bool> stop{false};
  const auto mask = first_hits(make_job(std::move(scene), 2), stop).mask;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      // The corner of the pixel farthest from the middle, in units of the radius.
      const double dx = std::max(std::abs(x - 20), std::abs(x + 1 - 20)) / 10.0;
      const double dy = std::max(std::abs(y - 20), std::abs(y + 1 - 20)) / 10.0;
      const double far = std::hypot(dx, dy);
      if (std::abs(far - 1) > 1e-6) CHECK(mask[y * 40 + x] == (far < 1));
    }
}

TEST_CASE("the model is named after what the scene holds") {
  CHECK(describe_media(mixed_scene()) == "chromatic anisotropic matched diffuse");
  CHECK(describe_media(Scene{}) == "no translucent object");
}

TEST_CASE("hero channels that take turns lower the variance of a chromatic image, and the image says so") {
  Scene scene = mixed_scene();
  scene.film = {16, 16};
  scene.camera = {{-1, 0, 3}, {-1, 0, 0}, {0, 1, 0}, 24, {}};
  scene.objects.resize(1);
  constexpr int kSeeds = 12;
  constexpr std::uint64_t kSamples = 25;
  std::vector<Film> films;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Job job = make_job(scene, 2);
    job.seed = static_cast<std::uint64_t>(seed);
    films.push_back(render_spp(job, kSamples).film);
  }
  double scattered = 0;    // over what is reported
  double independent = 0;  // likewise
  int counted = 0;
  for (std::size_t i = 0; i < films[0].pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      Moments means;
      double reported = 0;
      double plain = 0;
      for (const Film& film : films) {
        const Pixel& pixel = film.pixels[i];
        means.add(pixel.mean[c]);
        reported += pixel.variance_of_mean()[c] / kSeeds;
        plain += pixel.m2[c] / (kSamples - 1) / kSamples / kSeeds;
      }
      if (!(reported > 0)) continue;
      scattered += means.variance() / reported;
      independent += plain / reported;
      ++counted;
    }
  }
  REQUIRE(counted > 300);
  CHECK(scattered / counted == doctest::Approx(1).epsilon(0.08));
  CHECK(independent / counted > 1.15);
}
