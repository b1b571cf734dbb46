#include "render/progressive.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/timer.h"
#include "render/deadline.h"
#include "render/first_hits.h"
#include "render/tile_pass.h"

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

// Tiles for a pass: small images in small ones, so that no thread is left waiting for another's last one;
// larger ones where a tile of the usual size has too few samples to keep the lanes full.
int tile_size(const Tile& area, std::uint64_t samples, bool lanes) noexcept {
  constexpr std::uint64_t kFullLanes = 16384;
  const auto pixels = std::int64_t{area.x1 - area.x0} * (area.y1 - area.y0);
  const auto fits = [&](int size, int tiles) { return pixels >= std::int64_t{tiles} * size * size; };
  int size = kTileSize;
  while (size > 4 && !fits(size, 64)) size /= 2;
  const auto is_full = [&] { return static_cast<std::uint64_t>(size) * size * samples >= kFullLanes; };
  while (lanes && !is_full() && fits(2 * size, 32)) size *= 2;
  return size;
}

// The seconds at which a pass is broken off: what is over the limit by 1 % and has taken twice as long as it
// was predicted to.
double latest_end(const Progress& progress, std::uint64_t samples, double limit) noexcept {
  const double latest = 1.01 * limit;
  if (progress.spp == 0) return latest;
  const double sample = progress.seconds / static_cast<double>(progress.spp);
  return std::max(latest, progress.seconds + 2 * static_cast<double>(samples) * sample);
}

}  // namespace

Tile area_of(const Job& job) noexcept {
  const Tile film = job.crop.value_or(Tile{0, 0, job.scene->film.width, job.scene->film.height});
  return {film.x0 / job.scale, film.y0 / job.scale, scaled(film.x1, job.scale), scaled(film.y1, job.scale)};
}

CameraRays camera_of(const Job& job) noexcept {
  return make_camera_rays(job.scene->camera, job.scene->film.width, job.scene->film.height);
}

Ray film_ray(const Job& job, const CameraRays& camera, double x, double y) noexcept {
  return camera.at(x * job.scale * camera.pixel_width, y * job.scale * camera.pixel_height);
}

Random sample_stream(const Job& job, int x, int y, std::uint64_t k) noexcept {
  return stream(job.seed, pixel_index(job, x, y), job.first_sample + static_cast<std::uint32_t>(k));
}

int sample_hero(const Job& job, int x, int y, std::uint64_t k) noexcept {
  const auto first = static_cast<std::uint64_t>(stream(~job.seed, pixel_index(job, x, y), 0).next() * 3);
  return static_cast<int>((first + job.first_sample + k) % 3);
}

PathOptions path_options(const Job& job, const std::atomic<bool>& stop) {
  return {job.estimator, is_chromatic(*job.scene), uses_lanes(job), &stop};
}

std::uint64_t film_bytes(const Job& job) {
  const Tile area = area_of(job);
  return 2 * sizeof(Pixel) * static_cast<std::uint64_t>(area.x1 - area.x0) *
         static_cast<std::uint64_t>(area.y1 - area.y0);
}

bool uses_lanes(const Job& job) noexcept {
  return job.walk == WalkCode::batch && job.estimator == Estimator::implicit;
}

bool prepare_walks(const Job& job, const std::atomic<bool>& stop) {
  return !uses_lanes(job) || job.geometry->finish(stop);
}

Passes::Passes(const Job& job, const std::atomic<bool>& stop)
    : job_(job), stop_(stop), camera_(camera_of(job)), area_(area_of(job)) {}

bool Passes::advance(const Rendering& before, std::uint64_t samples, Rendering& after) const {
  if (!prepare_walks(job_, stop_)) return false;
  const int width = area_.x1 - area_.x0;
  const int height = area_.y1 - area_.y0;
  if (after.film.width != width || after.film.height != height) after.film = Film(width, height);
  const bool lanes = uses_lanes(job_);
  const EmptyPixels empty(job_, camera_);
  const TilePass pass{job_,    camera_, empty,      area_, path_options(job_, stop_),
                      samples, before,  after.film, lanes};
  const std::vector<Tile> tiles = make_tiles(width, height, {}, tile_size(area_, samples, lanes));
  std::vector<TileResult> results(tiles.size());
  parallel_for(
      job_.threads, tiles.size(), [&](std::size_t i) { results[i] = pass.render(tiles[i]); }, job_.priority);
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
                 const std::function<void(const Rendering&)>& published, Rendering start) {
  std::optional<Deadline> deadline;
  if (budget.seconds) deadline.emplace(stop);
  const Passes passes(job, deadline ? deadline->reached() : stop);
  const std::vector<std::uint8_t> mask = first_hits(job, stop).mask;
  Rendering done = std::move(start);
  if (done.spp == 0) {
    const Tile area = area_of(job);
    done.film = Film(area.x1 - area.x0, area.y1 - area.y0);
  } else {
    done.noise = estimate_noise(done.film, mask);
  }
  Rendering next;  // its film is made in the first pass, and counts as part of it
  if (!prepare_walks(job, stop)) return done;
  const double before = done.seconds;
  const Timer timer;
  for (;;) {
    const std::uint64_t samples = next_pass(progress_of(done), budget);
    if (samples == 0 || stop) return done;
    if (deadline)
      deadline->set(latest_end(progress_of(done), samples, *budget.seconds) - before - timer.seconds());
    if (!passes.advance(done, samples, next)) return done;
    std::swap(done, next);
    done.seconds = before + timer.seconds();
    done.noise = estimate_noise(done.film, mask);
    published(done);
  }
}

std::string describe_media(const Scene& scene) {
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
  return text;
}

std::string describe_model(const Job& job) {
  return (uses_lanes(job) ? "batch " : "scalar ") + describe_media(*job.scene);
}

}  // namespace meander
