#include "render/progressive.h"

#include <cmath>

#include "core/timer.h"
#include "render/parallel.h"

namespace meander {
namespace {

bool is_chromatic(const Scene& scene) {
  for (const Material& material : scene.materials)
    if (const auto* translucent = std::get_if<TranslucentMaterial>(&material.kind))
      if (!is_grey(translucent->medium.sigma_t)) return true;
  return false;
}

// What one tile adds to the statistics of a pass.
struct TileResult {
  PathCounters counters;
  std::uint64_t non_finite = 0;
  bool complete = false;
};

// One pass over the image: reads one film, writes another.
struct Pass {
  const Job& job;
  const CameraRays& camera;
  Tile area;
  PathOptions options;
  std::uint64_t first;  // samples that every pixel has already
  std::uint64_t samples;
  const Film& before;
  Film& after;

  [[nodiscard]] TileResult render_tile(const Tile& tile) const {
    TileResult result;
    PathTracer<Geometry> tracer(*job.scene, *job.geometry, options);
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        Pixel pixel = before.at(x, y);
        if (!render_pixel(x, y, tracer, pixel, result)) return result;
        after.at(x, y) = pixel;
      }
    }
    result.counters = tracer.counters();
    result.complete = true;
    return result;
  }

  [[nodiscard]] bool render_pixel(int x, int y, PathTracer<Geometry>& tracer, Pixel& pixel,
                                  TileResult& result) const {
    const FilmSize size = job.scene->film;
    const int image_x = area.x0 + x;
    const int image_y = area.y0 + y;
    const auto index = static_cast<std::uint32_t>(image_y) * static_cast<std::uint32_t>(size.width) +
                       static_cast<std::uint32_t>(image_x);
    if (options.stop->load(std::memory_order_relaxed)) return false;
    for (std::uint64_t k = 0; k < samples; ++k) {
      Random random = stream(job.seed, index, job.first_sample + static_cast<std::uint32_t>(first + k));
      const double u = random.next();
      const double v = random.next();
      RadianceSink sink;
      const Ray ray = camera.at((image_x + u) / size.width, (image_y + v) / size.height);
      if (!tracer.trace(ray, random, sink)) return false;
      Rgb radiance = sink.radiance;
      if (!std::isfinite(radiance.x + radiance.y + radiance.z)) {
        ++result.non_finite;
        radiance = Rgb(0);
      }
      pixel.add(radiance);
    }
    return true;
  }
};

}  // namespace

Tile area_of(const Job& job) {
  return job.crop.value_or(Tile{0, 0, job.scene->film.width, job.scene->film.height});
}

std::uint64_t film_bytes(const Job& job) {
  const Tile area = area_of(job);
  return 2 * sizeof(Pixel) * static_cast<std::uint64_t>(area.x1 - area.x0) *
         static_cast<std::uint64_t>(area.y1 - area.y0);
}

std::vector<std::uint8_t> object_mask(const Job& job, const std::atomic<bool>& stop) {
  const Scene& scene = *job.scene;
  const CameraRays camera = make_camera_rays(scene.camera, scene.film.width, scene.film.height);
  const Tile area = area_of(job);
  const auto shows_object = [&](double x, double y) -> std::uint8_t {
    const auto hit = job.geometry->closest_hit(
        camera.at((area.x0 + x) / scene.film.width, (area.y0 + y) / scene.film.height));
    return hit && std::holds_alternative<TranslucentMaterial>(
                      scene.materials[scene.objects[hit->object].material].kind);
  };
  const auto width = static_cast<std::size_t>(area.x1 - area.x0);
  const auto height = static_cast<std::size_t>(area.y1 - area.y0);
  const std::size_t stride = width + 1;
  std::vector<std::uint8_t> corners(stride * (height + 1));
  parallel_for(job.threads, height + 1, [&](std::size_t y) {
    for (std::size_t x = 0; x <= width && !stop; ++x)
      corners[y * stride + x] = shows_object(static_cast<double>(x), static_cast<double>(y));
  });
  std::vector<std::uint8_t> mask(width * height);
  parallel_for(job.threads, height, [&](std::size_t y) {
    for (std::size_t x = 0; x < width && !stop; ++x) {
      const std::uint8_t* corner = &corners[y * stride + x];
      const bool whole = corner[0] && corner[1] && corner[stride] && corner[stride + 1];
      mask[y * width + x] = whole && shows_object(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
    }
  });
  return mask;
}

Rendering render(const Job& job, const Budget& budget, const std::atomic<bool>& stop,
                 const std::function<void(const Rendering&)>& published) {
  const Scene& scene = *job.scene;
  const Tile area = area_of(job);
  const int width = area.x1 - area.x0;
  const int height = area.y1 - area.y0;
  const CameraRays camera = make_camera_rays(scene.camera, scene.film.width, scene.film.height);
  const std::vector<Tile> tiles = make_tiles(width, height);
  const std::vector<std::uint8_t> mask = object_mask(job, stop);
  Rendering done;
  done.film = Film(width, height);
  Film next(width, height);
  const Timer timer;
  for (;;) {
    const std::uint64_t samples = next_pass({done.spp, done.seconds, done.noise}, budget);
    if (samples == 0 || stop) return done;
    const Pass pass{job,      camera,  area,      {job.estimator, is_chromatic(scene), &stop},
                    done.spp, samples, done.film, next};
    std::vector<TileResult> results(tiles.size());
    parallel_for(job.threads, tiles.size(), [&](std::size_t i) { results[i] = pass.render_tile(tiles[i]); });
    PathCounters counters = done.counters;
    std::uint64_t non_finite = done.non_finite;
    for (const TileResult& result : results) {
      if (!result.complete) return done;
      counters += result.counters;
      non_finite += result.non_finite;
    }
    std::swap(done.film, next);
    done.spp += samples;
    done.seconds = timer.seconds();
    done.noise = relative_noise(done.film, mask);
    done.counters = counters;
    done.non_finite = non_finite;
    published(done);
  }
}

std::string describe_model(const Scene& scene) {
  bool anisotropic = false;
  bool matched = false;
  bool diffuse = false;
  bool dielectric = false;
  for (const Object& object : scene.objects) {
    const auto* translucent = std::get_if<TranslucentMaterial>(&scene.materials[object.material].kind);
    if (!translucent) continue;
    anisotropic |= translucent->medium.g != 0;
    matched |= translucent->boundary == Boundary::matched;
    diffuse |= translucent->boundary == Boundary::diffuse;
    dielectric |= translucent->boundary == Boundary::dielectric;
  }
  if (!matched && !diffuse && !dielectric) return "no translucent object";
  std::string text = is_chromatic(scene) ? "chromatic" : "grey";
  text += anisotropic ? " anisotropic" : " isotropic";
  if (matched) text += " matched";
  if (diffuse) text += " diffuse";
  if (dielectric) text += " dielectric";
  return "scalar " + text;
}

}  // namespace meander
