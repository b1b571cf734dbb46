#include "render/sample_tail.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "math/color.h"

namespace meander {
namespace {

constexpr std::size_t kBands = 128;  // at most so many histograms, each of 16 KiB, are filled side by side

// The samples of one row after another; false when it was interrupted.
struct TailRows {
  const Job& job;
  const Image& reference;
  std::span<const std::uint8_t> mask;  // empty: every pixel
  std::uint64_t spp;
  CameraRays camera;
  Tile area;

  [[nodiscard]] bool trace(int y, PathTracer<Geometry>& tracer, LogHistogram& found) const {
    for (int x = 0; x < reference.width; ++x) {
      if (!mask.empty() && mask[static_cast<std::size_t>(y) * reference.width + x] == 0) continue;
      const float* r = reference.at(x, y);
      const double mean = luminance(Rgb(r[0], r[1], r[2]));
      const double scale = 1 / std::sqrt(mean * mean + 1e-4);
      for (std::uint64_t k = 0; k < spp; ++k) {
        const int image_x = area.x0 + x;
        const int image_y = area.y0 + y;
        Random random = sample_stream(job, image_x, image_y, k);
        const double u = random.next();
        const double v = random.next();
        RadianceSink sink;
        const int hero = sample_hero(job, image_x, image_y, k);
        if (!tracer.trace(film_ray(job, camera, image_x + u, image_y + v), random, sink, hero)) return false;
        const double value = luminance(sink.radiance);
        found.add(std::isfinite(value) ? value * scale : 0);
      }
    }
    return true;
  }
};

}  // namespace

std::optional<LogHistogram> sample_tail(const Job& job, const Image& reference,
                                        std::span<const std::uint8_t> mask, std::uint64_t spp,
                                        const std::atomic<bool>& stop) {
  const Tile area = area_of(job);
  assert(reference.width == area.x1 - area.x0 && reference.height == area.y1 - area.y0);
  const bool every = std::ranges::all_of(mask, [](std::uint8_t m) { return m == 0; });
  const TailRows rows{job, reference,      every ? std::span<const std::uint8_t>{} : mask,
                      spp, camera_of(job), area};
  const std::size_t bands = std::min(kBands, static_cast<std::size_t>(reference.height));
  if (!prepare_walks(job, stop)) return std::nullopt;
  std::vector<LogHistogram> found(bands);
  std::vector<std::uint8_t> complete(bands);
  parallel_for(
      job.threads, bands,
      [&](std::size_t band) {
        PathTracer<Geometry> tracer(*job.scene, *job.geometry, path_options(job, stop));
        for (int y = static_cast<int>(band); y < reference.height; y += static_cast<int>(bands))
          if (stop || !rows.trace(y, tracer, found[band])) return;
        complete[band] = 1;
      },
      job.priority);
  LogHistogram all;
  for (std::size_t band = 0; band < bands; ++band) {
    if (!complete[band]) return std::nullopt;
    all.merge(found[band]);
  }
  return all;
}

}  // namespace meander
