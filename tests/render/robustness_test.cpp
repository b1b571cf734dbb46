// Hard cases of geometry and light, each held to a number that is known exactly.
#include <doctest/doctest.h>

#include <cmath>

#include "render/parallel.h"
#include "render/small_scene.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/image_error.h"

using namespace meander;

namespace {

Scene white_scene(int size) {
  Scene scene;
  scene.camera = {{1, 1.5, 6}, {0, 0.5, 0}, {0, 1, 0}, 35, {}};
  scene.film = {size, size};
  scene.environment.radiance = Rgb(1);
  return scene;
}

Material white(Boundary boundary, const Rgb& sigma = Rgb(3)) {
  return translucent("white", {sigma, Rgb(1), 0}, boundary);
}

// The mean over pixels and its standard error, first channel.
std::pair<double, double> mean_of_image(const Rendering& rendering) {
  double mean = 0;
  double variance = 0;
  for (const Pixel& pixel : rendering.film.pixels) {
    mean += pixel.mean[0];
    variance += pixel.variance_of_mean()[0];
  }
  const auto count = static_cast<double>(rendering.film.pixels.size());
  return {mean / count, std::sqrt(variance) / count};
}

std::shared_ptr<const Mesh> cube_mesh(double scale) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? scale : -scale, i & 2 ? scale : -scale, i & 4 ? scale : -scale});
  const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace

TEST_CASE("a white box that stands on a white ground, touching it, vanishes in white surroundings") {
  for (const Boundary boundary : {Boundary::matched, Boundary::diffuse}) {
    for (const bool mesh : {false, true}) {
      for (const double size : {1.0, 1000.0, 0.123}) {
        Scene scene = white_scene(20);
        scene.materials.push_back(white(boundary));
        scene.materials.push_back({"ground", DiffuseMaterial{Rgb(1)}});
        Object box{"box", BoxShape{}, 0, {{0, 0.5, 0}, {}, DVec3(0.5)}};
        if (mesh) box.shape = cube_mesh(1);
        scene.objects.push_back(box);
        scene.objects.push_back({"ground", SlabShape{}, 1, {{0, -size, 0}, {}, DVec3(size)}});
        const Rendering r = render_spp(make_job(std::move(scene), 2), 32);
        for (const Pixel& pixel : r.film.pixels) CHECK(pixel.mean[0] == doctest::Approx(1).epsilon(2e-5));
        CHECK(r.counters.leaked_walks == 0);
      }
    }
  }
}

TEST_CASE("a box on a grey ground receives the same light with no gap and with a tiny one") {
  double means[2];
  double errors[2];
  for (const int gap : {0, 1}) {
    Scene scene = white_scene(20);
    scene.materials.push_back({"box", DiffuseMaterial{Rgb(Real(0.8))}});
    scene.materials.push_back({"ground", DiffuseMaterial{Rgb(Real(0.8))}});
    scene.objects.push_back({"box", BoxShape{}, 0, {{0, 0.5 + gap * 1e-4, 0}, {}, DVec3(0.5)}});
    scene.objects.push_back({"ground", SlabShape{}, 1, {{0, -1, 0}, {}, DVec3(1)}});
    std::tie(means[gap], errors[gap]) = mean_of_image(render_spp(make_job(std::move(scene), 2), 400));
  }
  CHECK(std::abs(means[0] - means[1]) < 4 * std::hypot(errors[0], errors[1]));
}

TEST_CASE("two matched boxes that touch are one long box") {
  double means[2];
  double errors[2];
  for (const int parts : {1, 2}) {
    Scene scene = white_scene(20);
    scene.materials.push_back(translucent("m", {Rgb(2), Rgb(Real(0.8)), 0}, Boundary::matched));
    if (parts == 1) scene.objects.push_back({"long", BoxShape{}, 0, {{0, 0, 0}, {}, {1, 0.5, 0.5}}});
    if (parts == 2) scene.objects.push_back({"left", BoxShape{}, 0, {{-0.5, 0, 0}, {}, DVec3(0.5)}});
    if (parts == 2) scene.objects.push_back({"right", BoxShape{}, 0, {{0.5, 0, 0}, {}, DVec3(0.5)}});
    std::tie(means[parts - 1], errors[parts - 1]) =
        mean_of_image(render_spp(make_job(std::move(scene), 2), 300));
  }
  CHECK(std::abs(means[0] - means[1]) < 4 * std::hypot(errors[0], errors[1]));
}

TEST_CASE("a half-space's colour is delivered by a box of any small mean free path") {
  // Exact value of b2_halfspace_iso_vs_albedo.csv for albedo 0.9 under diffuse light.
  for (const double path : {1e-2, 1e-4, 1e-5}) {
    Scene scene;
    scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, 0.2};
    scene.film = {12, 12};
    scene.environment.radiance = Rgb(1);
    scene.materials.push_back(
        translucent("m", {Rgb(static_cast<Real>(1 / path)), Rgb(Real(0.9)), 0}, Boundary::diffuse));
    scene.objects.push_back({"box", BoxShape{}, 0, {}});
    const auto [mean, error] = mean_of_image(render_spp(make_job(std::move(scene), 2), 2000));
    CAPTURE(path);
    CHECK(std::abs(z_score(mean, 0.4780244892282, error)) < 4);
  }
}

TEST_CASE("a light inside a matched body is found in full, by sampling and by walking into it") {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30, {}};
  scene.film = {16, 16};
  scene.materials.push_back(
      translucent("milk", {Rgb(2, 3, 4), Rgb(Real(0.9)), Real(0.5)}, Boundary::matched));
  scene.objects.push_back({"ball", SphereShape{}, 0, {}});
  scene.lights.push_back({"lamp", SphereLight{{0.1, 0.2, 0}, 0.1, Rgb(100)}, false});
  Scene point = scene;
  point.lights[0].shape = PointLight{{0.1, 0.2, 0}, Rgb(100 * kPi * Real(0.01))};
  Scene rim = scene;
  rim.lights[0].shape = SphereLight{{0, 1, 0}, 0.3, Rgb(20)};
  Scene speck = scene;
  speck.lights[0].shape = SphereLight{{0.1, 0.2, 0}, 0.002, Rgb(250000)};
  const Image lamp = resolve(render_spp(make_job(speck, 2), 1500).film);
  Job job = make_job(point, 2);
  job.seed = 1;
  CHECK(z_test(lamp, resolve(render_spp(job, 1500).film)).passed);
  for (const Scene& lit : {scene, rim}) {
    const Geometry geometry(lit, 2);
    const CameraRays camera = make_camera_rays(lit.camera, 16, 16);
    Image images[2];
    for (const bool sampled : {false, true}) {
      PathOptions options;
      options.chromatic = true;
      options.sample_lights = sampled;
      Film film(16, 16);
      parallel_for(2, film.pixels.size(), [&](std::size_t i) {
        PathTracer<Geometry> tracer(lit, geometry, options);
        for (std::uint32_t k = 0; k < 4000; ++k) {
          Random random = stream(2 + sampled, static_cast<std::uint32_t>(i), k);
          RadianceSink sink;
          const double x = (static_cast<double>(i % 16) + random.next()) / 16;
          const double y = (static_cast<double>(i / 16) + random.next()) / 16;
          if (tracer.trace(camera.at(x, y), random, sink)) film.pixels[i].add(sink.radiance);
        }
      });
      images[sampled] = resolve(film);
    }
    const ZTest z = z_test(images[1], images[0]);
    INFO("worst block ", z.worst_block_z, " of ", z.block_threshold, ", image ", z.image_z[0], " ",
         z.image_z[1], " ", z.image_z[2]);
    CHECK(z.passed);
  }
}

TEST_CASE("a clear matched body shows the light inside it") {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 2, {}};
  scene.film = {2, 2};
  scene.materials.push_back(translucent("clear", {Rgb(Real(1e-6)), Rgb(0), 0}, Boundary::matched));
  scene.objects.push_back({"ball", SphereShape{}, 0, {}});
  scene.lights.push_back({"lamp", SphereLight{{0, 0, 0}, 0.5, Rgb(7)}, true});
  const Rendering r = render_spp(make_job(std::move(scene), 1), 4);
  for (const Pixel& pixel : r.film.pixels) CHECK(pixel.mean[0] == doctest::Approx(7).epsilon(1e-4));
}

TEST_CASE("a shadow ray through bodies at any distance ends") {
  for (const auto& shape : std::vector<decltype(Object::shape)>{SphereShape{}, BoxShape{}, cube_mesh(1)}) {
    Scene scene;
    scene.materials.push_back(white(Boundary::matched));
    scene.objects.push_back({"near", shape, 0, {}});
    scene.objects.push_back({"far", shape, 0, {{1e11, 0, 0}, {}, DVec3(1)}});
    const Geometry geometry(scene, 1);
    const Rgb through =
        geometry.transmittance({{-5, 0.1, 0.1}, {1, 0, 0}}, std::numeric_limits<double>::infinity());
    CHECK(through.x < 1);
    CHECK(through.x > 0);
  }
}

TEST_CASE("a mesh renders the same at any scale") {
  std::vector<double> means;
  for (const double scale : {1e-10, 1e-3, 1.0, 1e10}) {
    Scene scene;
    scene.camera = {{0, 0, 5 * scale}, {0, 0, 0}, {0, 1, 0}, 30, {}};
    scene.film = {12, 12};
    scene.environment.radiance = Rgb(1);
    const Medium medium = medium_from_albedo(DVec3(0.8), DVec3(0.3 * scale), 0.3);
    scene.materials.push_back(translucent("m", medium, Boundary::matched));
    scene.objects.push_back({"cube", cube_mesh(1), 0, {{}, {10, 20, 30}, DVec3(scale)}});
    const Rendering r = render_spp(make_job(std::move(scene), 2), 64);
    CHECK(r.counters.leaked_walks == 0);
    means.push_back(mean_of_image(r).first);
  }
  for (const double mean : means) CHECK(mean == doctest::Approx(means[2]).epsilon(3e-3));
}

TEST_CASE("a path that meets the rims of fifty thin sheets in a stack passes them all") {
  Mesh stack;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const double z = 0.02 * i;
    for (const DVec3& p : {DVec3(-1, -1, z), DVec3(1, -1, z), DVec3(0, 1, z), DVec3(0, 0, z + 1e-4)})
      stack.positions.push_back(p);
    const std::uint32_t a = 4 * i;
    stack.triangles.insert(stack.triangles.end(),
                           {{a, a + 2, a + 1}, {a, a + 1, a + 3}, {a + 1, a + 2, a + 3}, {a + 2, a, a + 3}});
  }
  Scene scene;
  scene.camera = {{0, 1, 4}, {0, 0, 0}, {0, 1, 0}, 45, {}};
  scene.film = {48, 48};
  scene.environment.radiance = Rgb(1);
  scene.materials.push_back(white(Boundary::matched, Rgb(10)));
  scene.objects.push_back({"stack", std::make_shared<const Mesh>(std::move(stack)), 0, {}});
  Job job = make_job(std::move(scene), 2);
  for (const WalkCode walk : {WalkCode::batch, WalkCode::scalar}) {
    job.walk = walk;
    const Rendering r = render_spp(job, 16);
    CHECK(r.counters.walks > 300000);
    CHECK(r.counters.leaked_walks == 0);
    for (const Pixel& pixel : r.film.pixels) CHECK(pixel.mean[0] == doctest::Approx(1).epsilon(2e-5));
  }
}

TEST_CASE("light lost through a hole of a white chromatic body is neither gained nor lost") {
  Mesh open = *cube_mesh(1);
  open.triangles.resize(10);
  Scene scene = white_scene(16);
  scene.materials.push_back(white(Boundary::matched, Rgb(3, 1, 10)));
  scene.objects.push_back({"cube", std::make_shared<const Mesh>(std::move(open)), 0, {}});
  const Rendering r = render_spp(make_job(std::move(scene), 2), 1500);
  CHECK(r.counters.leaked_walks > 0);
  for (int c = 0; c < 3; ++c) {
    double mean = 0;
    double variance = 0;
    for (const Pixel& pixel : r.film.pixels) {
      mean += pixel.mean[c];
      variance += pixel.variance_of_mean()[c];
    }
    CHECK(std::abs(z_score(mean / 256, 1, std::sqrt(variance) / 256)) < 4);
  }
}
