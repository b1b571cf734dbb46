#include "render/tile_pass.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/color.h"
#include "walk/path_batch.h"

namespace meander {
namespace {

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

// A sample of a pixel: where it is in the image, and which of the job's it is.
struct SamplePlace {
  int x;
  int y;
  std::uint64_t k;
};

PathStart start_of(const TilePass& pass, const SamplePlace& at) noexcept {
  PathStart start;
  start.random = sample_stream(pass.job, at.x, at.y, at.k);
  const double u = start.random.next();
  const double v = start.random.next();
  start.ray = film_ray(pass.job, pass.camera, at.x + u, at.y + v);
  if (pass.options.chromatic) start.hero = sample_hero(pass.job, at.x, at.y, at.k);
  return start;
}

void add_sample(const TilePass& pass, const SamplePlace& at, const SampleSink& sink, Pixel& pixel,
                TileResult& result) noexcept {
  const bool finite = std::isfinite(sink.radiance.x + sink.radiance.y + sink.radiance.z);
  const Rgb value = finite ? sink.radiance : Rgb(0);
  if (pass.options.chromatic)
    pixel.add(value, sample_hero(pass.job, at.x, at.y, at.k));
  else
    pixel.add(value);
  if (finite)
    pixel.paths += sink.paths;
  else
    ++result.non_finite;
}

// Some samples of every pixel of a tile, which a batch ends in any order.
struct TileSamples {
  const TilePass& pass;
  const Tile& tile;
  std::uint64_t first;  // of each pixel's samples in the job
  std::size_t count;    // of them
  std::vector<SampleSink> found;
  std::size_t drawn = 0;

  [[nodiscard]] SamplePlace place(std::size_t sample) const noexcept {
    const auto pixel = static_cast<int>(sample / count);
    return {pass.area.x0 + tile.x0 + pixel % (tile.x1 - tile.x0),
            pass.area.y0 + tile.y0 + pixel / (tile.x1 - tile.x0), first + sample % count};
  }
  [[nodiscard]] bool next(PathStart& start) noexcept {
    if (drawn == found.size()) return false;
    start = start_of(pass, place(drawn));
    start.sample = drawn++;
    return true;
  }
  void done(std::size_t sample, const SampleSink& sink) noexcept { found[sample] = sink; }
};

Pixel pixel_before(const TilePass& pass, int x, int y) noexcept {
  return pass.before.spp > 0 ? pass.before.film.at(x, y) : Pixel{};
}

bool render_scalar(const TilePass& pass, const Tile& tile, PathTracer<Geometry>& tracer, TileResult& result) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      if (tracer.stop()) return false;
      Pixel pixel = pixel_before(pass, x, y);
      for (std::uint64_t k = 0; k < pass.samples; ++k) {
        const SamplePlace at{pass.area.x0 + x, pass.area.y0 + y, pass.before.spp + k};
        PathStart start = start_of(pass, at);
        SampleSink sink;
        if (!tracer.trace(start.ray, start.random, sink, start.hero)) return false;
        add_sample(pass, at, sink, pixel, result);
      }
      pass.after.at(x, y) = pixel;
    }
  }
  return true;
}

// Samples a tile has in hand at one time: what they find is kept until all have ended.
constexpr std::uint64_t kSamplesInHand = 65536;

bool render_lanes(const TilePass& pass, const Tile& tile, PathTracer<Geometry>& tracer, TileResult& result) {
  const int width = tile.x1 - tile.x0;
  const auto pixels = static_cast<std::size_t>(width) * (tile.y1 - tile.y0);
  const std::uint64_t most = std::max<std::uint64_t>(kSamplesInHand / pixels, 1);
  for (std::uint64_t done = 0; done < pass.samples;) {
    const std::uint64_t count = std::min(pass.samples - done, most);
    TileSamples samples{pass, tile, pass.before.spp + done, count, std::vector<SampleSink>(pixels * count)};
    PathBatch<Geometry, SampleSink, TileSamples> batch(*pass.job.scene, *pass.job.geometry, tracer, samples);
    if (!batch.run(pass.job.instruction_set)) return false;
    for (std::size_t i = 0; i < pixels; ++i) {
      const int x = tile.x0 + static_cast<int>(i) % width;
      const int y = tile.y0 + static_cast<int>(i) / width;
      Pixel pixel = done > 0 ? pass.after.at(x, y) : pixel_before(pass, x, y);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t sample = i * count + k;
        add_sample(pass, samples.place(sample), samples.found[sample], pixel, result);
      }
      pass.after.at(x, y) = pixel;
    }
    done += count;
  }
  return true;
}

}  // namespace

TileResult TilePass::render(const Tile& tile) const {
  TileResult result;
  PathTracer<Geometry> tracer(*job.scene, *job.geometry, options);
  result.complete =
      lanes ? render_lanes(*this, tile, tracer, result) : render_scalar(*this, tile, tracer, result);
  result.counters = tracer.counters();
  return result;
}

}  // namespace meander
