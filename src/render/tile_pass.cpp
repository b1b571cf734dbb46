#include "render/tile_pass.h"

#include <algorithm>
#include <array>
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

// A sample of a pixel, but for its ray and what that meets; returns the place on the film that it goes
// through.
glm::dvec2 begin_sample(const TilePass& pass, const SamplePlace& at, BatchSample& sample) noexcept {
  sample.random = sample_stream(pass.job, at.x, at.y, at.k);
  const double u = sample.random.next();
  const double v = sample.random.next();
  if (pass.options.chromatic) sample.start.hero = sample_hero(pass.job, at.x, at.y, at.k);
  return {at.x + u, at.y + v};
}

// A sample of a pixel, but for what its ray meets.
BatchSample sample_at(const TilePass& pass, const SamplePlace& at) noexcept {
  BatchSample sample;
  const glm::dvec2 on_film = begin_sample(pass, at, sample);
  sample.start.ray = film_ray(pass.job, pass.camera, on_film.x, on_film.y);
  return sample;
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

// Where a pixel of the film is in it.
struct FilmPlace {
  int x;
  int y;
};

// Some samples of some pixels, which a batch ends in any order.
struct TileSamples {
  const TilePass& pass;
  const std::vector<FilmPlace>& pixels;
  std::uint64_t first;  // of each pixel's samples in the job
  std::size_t count;    // of them
  std::vector<SampleSink> found;
  std::size_t drawn = 0;
  static constexpr std::size_t kTogether = 16;
  std::array<BatchSample, kTogether> ahead = {};

  [[nodiscard]] SamplePlace place(std::size_t sample) const noexcept {
    const FilmPlace& at = pixels[sample / count];
    return {pass.area.x0 + at.x, pass.area.y0 + at.y, first + sample % count};
  }
  [[nodiscard]] const BatchSample* next() noexcept {
    if (drawn == found.size()) return nullptr;
    const std::size_t in_row = drawn % kTogether;
    if (in_row == 0) draw_together();
    ahead[in_row].number = drawn++;
    return &ahead[in_row];
  }
  // Some at a time and step by step, so that the divisions and roots of one do not wait for those of another.
  void draw_together() noexcept {
    const std::size_t count_ahead = std::min(kTogether, found.size() - drawn);
    std::array<glm::dvec2, kTogether> on_film;
    for (std::size_t i = 0; i < count_ahead; ++i) {
      const SamplePlace at = place(drawn + i);
      on_film[i] = begin_sample(pass, at, ahead[i]);
    }
    for (std::size_t i = 0; i < count_ahead; ++i)
      ahead[i].start.ray = film_ray(pass.job, pass.camera, on_film[i].x, on_film[i].y);
    for (std::size_t i = 0; i < count_ahead; ++i)
      ahead[i].start.hit = pass.job.geometry->closest_hit(ahead[i].start.ray);
  }
  void done(std::size_t sample, const SampleSink& sink) noexcept { found[sample] = sink; }
};

Pixel pixel_before(const TilePass& pass, int x, int y) noexcept {
  return pass.before.spp > 0 ? pass.before.film.at(x, y) : Pixel{};
}

// Whether camera rays that meet no surface all find the same.
bool uniform_behind(const Scene& scene) noexcept {
  return !scene.environment.image && std::ranges::none_of(scene.lights, &Light::visible);
}

// The samples of a pixel in which no ray meets a surface.
Pixel render_empty(const TilePass& pass, const FilmPlace& at, const PathTracer<Geometry>& tracer,
                   TileResult& result) {
  const bool uniform = uniform_behind(*pass.job.scene);
  Pixel pixel = pixel_before(pass, at.x, at.y);
  SampleSink sink;
  for (std::uint64_t k = 0; k < pass.samples; ++k) {
    const SamplePlace place{pass.area.x0 + at.x, pass.area.y0 + at.y, pass.before.spp + k};
    if (k == 0 || !uniform) {
      sink = {};
      tracer.escape(sample_at(pass, place).start.ray, sink);
    }
    add_sample(pass, place, sink, pixel, result);
  }
  return pixel;
}

bool render_scalar(const TilePass& pass, const FilmPlace& at, PathTracer<Geometry>& tracer,
                   TileResult& result) {
  Pixel pixel = pixel_before(pass, at.x, at.y);
  for (std::uint64_t k = 0; k < pass.samples; ++k) {
    const SamplePlace place{pass.area.x0 + at.x, pass.area.y0 + at.y, pass.before.spp + k};
    BatchSample sample = sample_at(pass, place);
    SampleSink sink;
    if (!tracer.trace(sample.start.ray, sample.random, sink, sample.start.hero)) return false;
    add_sample(pass, place, sink, pixel, result);
  }
  pass.after.at(at.x, at.y) = pixel;
  return true;
}

// Samples a tile has in hand at one time: what they find is kept until all have ended.
constexpr std::uint64_t kSamplesInHand = 65536;

bool render_lanes(const TilePass& pass, const std::vector<FilmPlace>& pixels, PathTracer<Geometry>& tracer,
                  TileResult& result) {
  if (pixels.empty()) return true;
  const std::uint64_t most = std::max<std::uint64_t>(kSamplesInHand / pixels.size(), 1);
  for (std::uint64_t done = 0; done < pass.samples;) {
    const std::uint64_t count = std::min(pass.samples - done, most);
    TileSamples samples{pass, pixels, pass.before.spp + done, count,
                        std::vector<SampleSink>(pixels.size() * count)};
    PathBatch<Geometry, SampleSink, TileSamples> batch(*pass.job.scene, *pass.job.geometry, tracer, samples);
    if (!batch.run(pass.job.instruction_set)) return false;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const FilmPlace& at = pixels[i];
      Pixel pixel = done > 0 ? pass.after.at(at.x, at.y) : pixel_before(pass, at.x, at.y);
      for (std::size_t sample = i * count; sample < (i + 1) * count; ++sample)
        add_sample(pass, samples.place(sample), samples.found[sample], pixel, result);
      pass.after.at(at.x, at.y) = pixel;
    }
    done += count;
  }
  return true;
}

}  // namespace

TileResult TilePass::render(const Tile& tile) const {
  TileResult result;
  PathTracer<Geometry> tracer(*job.scene, *job.geometry, options);
  std::vector<FilmPlace> pixels;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      if (tracer.stop()) return result;
      if (empty.contains(area.x0 + x, area.y0 + y))
        after.at(x, y) = render_empty(*this, {x, y}, tracer, result);
      else
        pixels.push_back({x, y});
    }
  }
  result.complete = lanes ? render_lanes(*this, pixels, tracer, result)
                          : std::ranges::all_of(pixels, [&](const FilmPlace& at) {
                              return !tracer.stop() && render_scalar(*this, at, tracer, result);
                            });
  result.counters = tracer.counters();
  return result;
}

}  // namespace meander
