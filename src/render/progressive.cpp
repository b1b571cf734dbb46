#include "render/progressive.h"

#include <cmath>

#include "core/timer.h"
#include "math/color.h"
#include "render/first_hits.h"

namespace meander {
namespace {

// How many pixels of the job `count` pixels of the film touch.
int scaled(int count, int scale) noexcept { return (count + scale - 1) / scale; }

std::uint32_t pixel_index(const Job& job, int x, int y) noexcept {
  const int stride = scaled(job.scene->film.width, job.scale);
  return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(stride) + static_cast<std::uint32_t>(x);
}

bool is_chromatic(const Scene& scene) {
  for (const Material& material : scene.materials)
    if (const auto* translucent = std::get_if<TranslucentMaterial>(&material.kind))
      if (!is_grey(translucent->medium.sigma_t)) return true;
  return false;
}

// Small images in small tiles, so that no thread is left waiting for another's last one.
int tile_size(const Tile& area) noexcept {
  const auto pixels = std::int64_t{area.x1 - area.x0} * (area.y1 - area.y0);
  int size = kTileSize;
  while (size > 4 && pixels < std::int64_t{64} * size * size) size /= 2;
  return size;
}

// What one sample of a pixel finds: its radiance, and what paths the light took.
struct SampleSink {
  Rgb radiance{0};
  PathSums paths;

  void add(const Contribution& contribution) noexcept {
    const Rgb value = contribution.value();
    radiance += value;
    const double weight = luminance(value);
    paths += {weight, weight * contribution.order, weight * double{contribution.length}};
  }
};

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
  std::uint64_t samples;
  const Rendering& before;  // its film counts for nothing while it has no samples
  Film& after;

  [[nodiscard]] TileResult render_tile(const Tile& tile) const {
    TileResult result;
    PathTracer<Geometry> tracer(*job.scene, *job.geometry, options);
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        Pixel pixel = before.spp > 0 ? before.film.at(x, y) : Pixel{};
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
    const int image_x = area.x0 + x;
    const int image_y = area.y0 + y;
    if (options.stop->load(std::memory_order_relaxed)) return false;
    for (std::uint64_t k = 0; k < samples; ++k) {
      Random random = sample_stream(job, image_x, image_y, before.spp + k);
      const double u = random.next();
      const double v = random.next();
      const int hero = sample_hero(job, image_x, image_y, before.spp + k);
      SampleSink sink;
      if (!tracer.trace(film_ray(job, camera, image_x + u, image_y + v), random, sink, hero)) return false;
      const bool finite = std::isfinite(sink.radiance.x + sink.radiance.y + sink.radiance.z);
      const Rgb value = finite ? sink.radiance : Rgb(0);
      if (options.chromatic)
        pixel.add(value, hero);
      else
        pixel.add(value);
      if (finite)
        pixel.paths += sink.paths;
      else
        ++result.non_finite;
    }
    return true;
  }
};

}  // namespace

Tile area_of(const Job& job) noexcept {
  const Tile film = job.crop.value_or(Tile{0, 0, job.scene->film.width, job.scene->film.height});
  return {film.x0 / job.scale, film.y0 / job.scale, scaled(film.x1, job.scale), scaled(film.y1, job.scale)};
}

CameraRays camera_of(const Job& job) noexcept {
  return make_camera_rays(job.scene->camera, job.scene->film.width, job.scene->film.height);
}

Ray film_ray(const Job& job, const CameraRays& camera, double x, double y) noexcept {
  const FilmSize& film = job.scene->film;
  return camera.at(x * job.scale / film.width, y * job.scale / film.height);
}

Random sample_stream(const Job& job, int x, int y, std::uint64_t k) noexcept {
  return stream(job.seed, pixel_index(job, x, y), job.first_sample + static_cast<std::uint32_t>(k));
}

int sample_hero(const Job& job, int x, int y, std::uint64_t k) noexcept {
  const auto first = static_cast<std::uint64_t>(stream(~job.seed, pixel_index(job, x, y), 0).next() * 3);
  return static_cast<int>((first + job.first_sample + k) % 3);
}

PathOptions path_options(const Job& job, const std::atomic<bool>& stop) {
  return {job.estimator, is_chromatic(*job.scene), &stop};
}

std::uint64_t film_bytes(const Job& job) {
  const Tile area = area_of(job);
  return 2 * sizeof(Pixel) * static_cast<std::uint64_t>(area.x1 - area.x0) *
         static_cast<std::uint64_t>(area.y1 - area.y0);
}

Passes::Passes(const Job& job, const std::atomic<bool>& stop)
    : job_(job),
      stop_(stop),
      camera_(camera_of(job)),
      area_(area_of(job)),
      tiles_(make_tiles(area_.x1 - area_.x0, area_.y1 - area_.y0, {}, tile_size(area_))) {}

bool Passes::advance(const Rendering& before, std::uint64_t samples, Rendering& after) const {
  const int width = area_.x1 - area_.x0;
  const int height = area_.y1 - area_.y0;
  if (after.film.width != width || after.film.height != height) after.film = Film(width, height);
  const PathOptions options = path_options(job_, stop_);
  const Pass pass{job_, camera_, area_, options, samples, before, after.film};
  std::vector<TileResult> results(tiles_.size());
  parallel_for(
      job_.threads, tiles_.size(), [&](std::size_t i) { results[i] = pass.render_tile(tiles_[i]); },
      job_.priority);
  after.spp = before.spp + samples;
  after.counters = before.counters;
  after.non_finite = before.non_finite;
  for (const TileResult& result : results) {
    if (!result.complete) return false;
    after.counters += result.counters;
    after.non_finite += result.non_finite;
  }
  return true;
}

Rendering render(const Job& job, const Budget& budget, const std::atomic<bool>& stop,
                 const std::function<void(const Rendering&)>& published) {
  const Passes passes(job, stop);
  const std::vector<std::uint8_t> mask = first_hits(job, stop).mask;
  const Tile area = area_of(job);
  Rendering done;
  done.film = Film(area.x1 - area.x0, area.y1 - area.y0);
  Rendering next = done;
  const Timer timer;
  for (;;) {
    const std::uint64_t samples = next_pass(progress_of(done), budget);
    if (samples == 0 || stop || !passes.advance(done, samples, next)) return done;
    std::swap(done, next);
    done.seconds = timer.seconds();
    done.noise = estimate_noise(done.film, mask);
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
