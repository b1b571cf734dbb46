// Light found by sampling lights against light that rays find by themselves: the expectations must be the
// same.
#include <doctest/doctest.h>

#include "render/parallel.h"
#include "render/small_scene.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/image_error.h"

using namespace meander;

namespace {

// A body on a ground under a ball of light and a rectangle.
Scene lit_scene(const Material& body) {
  Scene scene;
  scene.camera = {{0, 1, 5}, {0, -0.1, 0}, {0, 1, 0}, 35, {}};
  scene.film = {24, 24};
  scene.environment.radiance = Rgb(Real(0.1));
  scene.materials.push_back(body);
  scene.materials.push_back({"ground", DiffuseMaterial{Rgb(Real(0.5), Real(0.4), Real(0.3))}});
  scene.objects.push_back({"body", SphereShape{}, 0, {{0, 0, 0}, {}, {0.9, 0.7, 0.8}}});
  scene.objects.push_back({"ground", SlabShape{}, 1, {{0, -1.8, 0}, {}, DVec3(1)}});
  scene.lights.push_back({"ball", SphereLight{{1.2, 1.6, -0.6}, 0.5, Rgb(6, 5, 4)}, true});
  scene.lights.push_back(
      {"window", RectangleLight{{-2, 1.5, 1}, {0, 0, 0}, {0, 1, 0}, 1.5, 1.5, Rgb(3, 4, 5)}, false});
  return scene;
}

Image trace_image(const Scene& scene, bool sample_lights, std::uint32_t spp, std::uint64_t seed) {
  const Geometry geometry(scene, 2);
  const CameraRays camera = make_camera_rays(scene.camera, scene.film.width, scene.film.height);
  PathOptions options;
  options.chromatic = true;
  options.sample_lights = sample_lights;
  Film film(scene.film.width, scene.film.height);
  parallel_for(2, film.pixels.size(), [&](std::size_t i) {
    PathTracer<Geometry> tracer(scene, geometry, options);
    const auto pixel = static_cast<std::uint32_t>(i);
    const int x = static_cast<int>(i) % film.width;
    const int y = static_cast<int>(i) / film.width;
    for (std::uint32_t k = 0; k < spp; ++k) {
      Random random = stream(seed, pixel, k);
      const double u = random.next();
      const double v = random.next();
      RadianceSink sink;
      if (tracer.trace(camera.at((x + u) / film.width, (y + v) / film.height), random, sink))
        film.pixels[i].add(sink.radiance);
    }
  });
  return resolve(film);
}

void check_same_image(const Material& body) {
  const Scene scene = lit_scene(body);
  const ZTest z = z_test(trace_image(scene, true, 1000, 0), trace_image(scene, false, 4000, 1));
  INFO("worst pixel ", z.worst_pixel_z, ", worst block ", z.worst_block_z, " of ", z.block_threshold,
       ", image ", z.image_z[0], " ", z.image_z[1], " ", z.image_z[2], " of ", z.image_threshold);
  CHECK(z.passed);
}

}  // namespace

TEST_CASE("a lit body looks the same whether its light is sampled or found: opaque") {
  check_same_image({"clay", DiffuseMaterial{Rgb(Real(0.7))}});
}

TEST_CASE("a lit body looks the same whether its light is sampled or found: diffuse boundary") {
  check_same_image(translucent("wax", {Rgb(4), Rgb(Real(0.95)), 0}, Boundary::diffuse));
}

TEST_CASE("a lit body looks the same whether its light is sampled or found: matched, grey") {
  check_same_image(translucent("milk", {Rgb(2), Rgb(Real(0.95)), Real(0.5)}, Boundary::matched));
}

TEST_CASE("a lit body looks the same whether its light is sampled or found: matched, chromatic") {
  check_same_image(translucent("jade", {Rgb(1, 3, 8), Rgb(Real(0.95), Real(0.8), Real(0.99)), Real(-0.3)},
                               Boundary::matched));
}

TEST_CASE("a lit body looks the same whether its light is sampled or found: diffuse under an interface") {
  const TranslucentMaterial wax{
      {Rgb(4, 5, 8), Rgb(Real(0.95), Real(0.9), Real(0.99)), 0}, Boundary::diffuse, 1.5};
  check_same_image({"wax", wax});
}

TEST_CASE("a lit body looks the same whether its light is sampled or found: dielectric") {
  const TranslucentMaterial jelly{{Rgb(2), Rgb(Real(0.95)), Real(0.5)}, Boundary::dielectric, 1.33};
  check_same_image({"jelly", jelly});
}

TEST_CASE("a lit body looks the same whether its light is sampled or found: rough dielectric") {
  for (const double roughness : {0.2, 0.6}) {
    const TranslucentMaterial frosted{{Rgb(2, 3, 5), Rgb(Real(0.95), Real(0.9), Real(0.98)), Real(0.3)},
                                      Boundary::dielectric,
                                      1.5,
                                      roughness};
    check_same_image({"frosted", frosted});
  }
}

TEST_CASE("a point light stands for a small ball of the same power") {
  Scene ball = lit_scene(translucent("milk", {Rgb(2), Rgb(Real(0.9)), 0}, Boundary::matched));
  ball.lights.pop_back();
  Scene point = ball;
  const DVec3 center(1.2, 1.6, -0.6);
  ball.lights[0] = {"ball", SphereLight{center, 0.01, Rgb(10000)}, false};
  // Intensity of a sphere of radiance L and radius r: L pi r^2.
  point.lights[0] = {"point", PointLight{center, Rgb(kPi)}, false};
  Job job = make_job(point, 2);
  job.seed = 1;
  const ZTest z =
      z_test(resolve(render_spp(make_job(ball, 2), 300).film), resolve(render_spp(job, 300).film));
  CHECK(z.passed);
}

TEST_CASE("a white body in a white surround vanishes, whatever its boundary, shape and light") {
  for (const Boundary boundary : {Boundary::matched, Boundary::diffuse}) {
    for (const Rgb& sigma : {Rgb(5), Rgb(1, 4, 20)}) {
      Scene scene = mixed_scene();
      scene.lights.clear();
      scene.environment.radiance = Rgb(1);
      scene.materials[0] = translucent("a", {sigma, Rgb(1), Real(0.6)}, boundary);
      scene.materials[1] = translucent("b", {sigma, Rgb(1), 0}, boundary);
      scene.materials[2] = {"ground", DiffuseMaterial{Rgb(1)}};
      const Rendering r = render_spp(make_job(std::move(scene), 2), 16);
      const bool exact = is_grey(sigma);
      const double threshold = two_sided_threshold(sidak_level(1e-4, 3));
      for (int c = 0; c < 3; ++c) {
        double mean = 0;
        double variance = 0;
        for (const Pixel& pixel : r.film.pixels) {
          if (exact) CHECK(pixel.mean[c] == doctest::Approx(1).epsilon(1e-5));
          mean += pixel.mean[c];
          variance += pixel.variance_of_mean()[c];
        }
        const auto n = static_cast<double>(r.film.pixels.size());
        if (!exact) CHECK(std::abs(z_score(mean / n, 1, std::sqrt(variance) / n)) < threshold);
      }
    }
  }
}

TEST_CASE("light adds up: two lights together are the sum of each alone") {
  Scene both = mixed_scene();
  Scene first = both;
  Scene second = both;
  first.lights.pop_back();
  second.lights.erase(second.lights.begin());
  second.environment.radiance = Rgb(0);
  Image sum = resolve(render_spp(make_job(first, 2), 400).film);
  Job job = make_job(second, 2);
  job.seed = 5;
  const Image other = resolve(render_spp(job, 400).film);
  for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += other.values[i];
  job = make_job(both, 2);
  job.seed = 9;
  CHECK(z_test(resolve(render_spp(job, 400).film), sum).passed);
}
