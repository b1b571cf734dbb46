#include "film/film.h"

#include <algorithm>
#include <cassert>

namespace meander {

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

std::array<double, 3> Pixel::variance_of_mean() const noexcept {
  if (count < 2) return {};
  const double n = static_cast<double>(count);
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
