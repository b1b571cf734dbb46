// Pixels in which no ray meets anything are told by bounding spheres; they must never be told wrongly.
#include <doctest/doctest.h>

#include <cstring>

#include "render/small_scene.h"
#include "render/tile_pass.h"

using namespace meander;

namespace {

// The share of the pixels that are told to be empty; every one of them is looked through.
double share_told(const Job& job) {
  const CameraRays camera = camera_of(job);
  const EmptyPixels empty(job, camera);
  const Tile area = area_of(job);
  Random random = stream(9, 0, 0);
  int told = 0;
  for (int y = area.y0; y < area.y1; ++y) {
    for (int x = area.x0; x < area.x1; ++x) {
      if (!empty.contains(x, y)) continue;
      ++told;
      for (int i = 0; i < 24; ++i) {
        // Corners first.
        const double u = i < 4 ? Real(i % 2) : random.next();
        const double v = i < 4 ? Real(i / 2) : random.next();
        REQUIRE_FALSE(job.geometry->closest_hit(film_ray(job, camera, x + u, y + v)));
      }
    }
  }
  return double(told) / (double(area.x1 - area.x0) * (area.y1 - area.y0));
}

// The mixed scene without its ground, which is everywhere, and with a box.
Scene floating_scene() {
  Scene scene = mixed_scene();
  scene.objects.pop_back();
  scene.objects.push_back({"box", BoxShape{}, 1, {{0.3, 1.5, -1}, {20, 30, 40}, DVec3(0.5, 0.1, 0.3)}});
  return scene;
}

}  // namespace

TEST_CASE("nothing is met in a pixel that is told to be empty") {
  Scene scene = floating_scene();
  CHECK(share_told(make_job(scene, 2)) > 0.3);
  Job coarse = make_job(scene, 2);
  coarse.scale = 3;
  CHECK(share_told(coarse) > 0.1);
  scene.camera.orthographic_height = 5;
  CHECK(share_told(make_job(scene, 2)) > 0.3);
  scene.camera = {{1e4, 3e3, 6e4}, {0, 0, 0}, {0, 1, 0}, 0.005, {}};  // far away, through a long lens
  CHECK(share_told(make_job(scene, 2)) > 0.1);
  scene.camera = {{0, 0, 2}, {0, 0.3, 0}, {0, 1, 0}, 170, {}};  // among them, with pixels of many degrees
  scene.film = {9, 7};
  share_told(make_job(scene, 2));
  for (Object& object : scene.objects) object.transform.translate += DVec3(1e5, -2e5, 3e5);
  scene.camera = {DVec3(1e5, -2e5, 3e5) + DVec3(0, 0, 6), DVec3(1e5, -2e5, 3e5), {0, 1, 0}, 60, {}};
  scene.film = {60, 40};
  CHECK(share_told(make_job(scene, 2)) > 0.3);
}

TEST_CASE("nothing is told to be empty before an endless slab or from within an object's sphere") {
  CHECK(share_told(make_job(mixed_scene(), 2)) == 0);
  Scene scene = floating_scene();
  scene.camera.look_from = DVec3(-1, 0.1, 0.1);  // in the hole of the knot
  CHECK(share_told(make_job(scene, 2)) == 0);
}

TEST_CASE("an empty pixel finds what its rays would") {
  Scene scene = floating_scene();
  Image sky(8, 4, 3);
  for (std::size_t i = 0; i < sky.values.size(); ++i) sky.values[i] = 0.1f * static_cast<float>(i % 17);
  for (const bool image : {false, true}) {
    for (const bool visible : {false, true}) {
      if (image) scene.environment.image = std::make_shared<const EnvironmentImage>(sky);
      scene.lights[0].visible = visible;
      std::get<RectangleLight>(scene.lights[0].shape).center = DVec3(2, 1.5, 0);
      std::get<RectangleLight>(scene.lights[0].shape).look_at = scene.camera.look_from;
      const Job job = make_job(scene, 2);
      const std::atomic<bool> stop{false};
      REQUIRE(prepare_walks(job, stop));
      const CameraRays camera = camera_of(job);
      const EmptyPixels empty(job, camera);
      const Film film = render_spp(job, 4).film;
      PathTracer<Geometry> tracer(*job.scene, *job.geometry, path_options(job, stop));
      int told = 0;
      for (int y = 0; y < film.height; ++y) {
        for (int x = 0; x < film.width; ++x) {
          if (!empty.contains(x, y)) continue;
          ++told;
          Pixel pixel;
          for (std::uint64_t k = 0; k < 4; ++k) {
            Random random = sample_stream(job, x, y, k);
            const double u = random.next();
            const double v = random.next();
            RadianceSink sink;
            const int hero = sample_hero(job, x, y, k);
            REQUIRE(tracer.trace(film_ray(job, camera, x + u, y + v), random, sink, hero));
            pixel.add(sink.radiance, hero);
          }
          CHECK(std::memcmp(&pixel.mean, &film.at(x, y).mean, sizeof(pixel.mean)) == 0);
          CHECK(std::memcmp(&pixel.m2, &film.at(x, y).m2, sizeof(pixel.m2)) == 0);
        }
      }
      CHECK(told > 300);
    }
  }
}
