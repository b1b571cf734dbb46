#include "film/film.h"

#include <algorithm>
#include <cassert>

namespace meander {
namespace {

// Variance of the mean of a channel over three strata that take turns, the first to have one more drawn at
// random (Cochran 1977, "Sampling Techniques", section 5): what the samples scatter within them, and what the
// strata of an unfinished last round differ by.
double stratified_variance(const Pixel& pixel, std::size_t c) noexcept {
  const double n = static_cast<double>(pixel.count);
  double between = 0;  // sum of squares over the samples
  double middle = 0;
  for (const Stratum& stratum : pixel.strata) {
    const double d = double{stratum.mean[c]} - pixel.mean[c];
    between += stratum.count * d * d;
    middle += double{stratum.mean[c]} / 3;
  }
  double apart = 0;  // variance of the strata's means
  for (const Stratum& stratum : pixel.strata)
    apart += (stratum.mean[c] - middle) * (stratum.mean[c] - middle) / 2;
  const double within = std::max(pixel.m2[c] - between, 0.0) / (n - 3);
  const double left = static_cast<double>(pixel.count % 3);
  return (n * within + left * (1 - left / 3) * apart) / (n * n);
}

}  // namespace

void Pixel::add(const Rgb& value) noexcept {
  ++count;
  const double share = 1 / static_cast<double>(count);
  for (int c = 0; c < 3; ++c) {
    const double x = static_cast<double>(value[c]);
    const double before = x - mean[c];
    mean[c] += before * share;
    m2[c] += before * (x - mean[c]);
  }
}

void Pixel::add(const Rgb& value, int stratum) noexcept {
  add(value);
  Stratum& own = strata[static_cast<std::size_t>(stratum)];
  ++own.count;
  for (int c = 0; c < 3; ++c)
    own.mean[static_cast<std::size_t>(c)] +=
        (static_cast<float>(value[c]) - own.mean[static_cast<std::size_t>(c)]) /
        static_cast<float>(own.count);
}

std::array<double, 3> Pixel::variance_of_mean() const noexcept {
  if (count < 2) return {};
  const double n = static_cast<double>(count);
  if (strata[0].count > 0 && count >= kFewestStratified)
    return {stratified_variance(*this, 0), stratified_variance(*this, 1), stratified_variance(*this, 2)};
  return {m2[0] / (n - 1) / n, m2[1] / (n - 1) / n, m2[2] / (n - 1) / n};
}

Image resolve(const Film& film) {
  Image image(film.width, film.height, 6);
  float* out = image.values.data();
  for (const Pixel& pixel : film.pixels) {
    const std::array<double, 3> variance = pixel.variance_of_mean();
    for (const double m : pixel.mean) *out++ = static_cast<float>(m);
    for (const double v : variance) *out++ = static_cast<float>(v);
  }
  return image;
}

void resolve_row(const Film& film, const Image* normals, int y, FilmPlanes& planes) noexcept {
  assert(!normals || (normals->width == film.width && normals->height == film.height));
  float* radiance = planes.radiance.at(0, y);
  float* error = planes.error.at(0, y);
  float* features = planes.features.at(0, y);
  for (int x = 0; x < film.width; ++x, radiance += 4, error += 4, features += 4) {
    const Pixel& pixel = film.at(x, y);
    const std::array<double, 3> variance = pixel.variance_of_mean();
    for (int c = 0; c < 3; ++c) {
      radiance[c] = static_cast<float>(pixel.mean[c]);
      error[c] = static_cast<float>(variance[c]);
      features[1 + c] = normals ? normals->at(x, y)[c] : 0.0f;
    }
    const PathSums& paths = pixel.paths;
    const bool lit = paths.luminance > 0;
    radiance[3] = static_cast<float>(pixel.count);
    error[3] = lit ? static_cast<float>(paths.order / paths.luminance) : 0.0f;
    features[0] = lit ? static_cast<float>(paths.length / paths.luminance) : 0.0f;
  }
}

FilmPlanes resolve_planes(const Film& film, const Image* normals) {
  FilmPlanes planes{{film.width, film.height, 4}, {film.width, film.height, 4}, {film.width, film.height, 4}};
  for (int y = 0; y < film.height; ++y) resolve_row(film, normals, y, planes);
  return planes;
}

std::array<double, 3> mean_of(const Film& film) {
  std::array<double, 3> sum{};
  for (const Pixel& pixel : film.pixels) {
    for (int c = 0; c < 3; ++c) sum[c] += pixel.mean[c];
  }
  const double n = std::max(1.0, static_cast<double>(film.pixels.size()));
  return {sum[0] / n, sum[1] / n, sum[2] / n};
}

}  // namespace meander
