// Accumulators: each pixel a running mean, a second moment and a weight, so that every image has an error
// bar.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "film/film_planes.h"
#include "math/image.h"
#include "math/types.h"

namespace meander {

/// Sums over contributions of light: of its luminance, and of that times the number of scatterings and times
/// the length inside media (scene units).
struct PathSums {
  double luminance = 0;
  double order = 0;
  double length = 0;

  void operator+=(const PathSums& other) noexcept {
    luminance += other.luminance;
    order += other.order;
    length += other.length;
  }
};

/// The samples of one stratum of a pixel's: how many, and their mean.
struct Stratum {
  std::array<float, 3> mean{};
  std::uint32_t count = 0;
};

/// From that many samples on the variance of a stratified mean is known as such.
inline constexpr std::uint64_t kFewestStratified = 16;

/// Welford's (1962) running mean and sum of squared deviations of the samples of one pixel, per channel; and
/// what paths its light took. Samples are independent, or independent within three strata that take turns.
struct Pixel {
  std::array<double, 3> mean{};
  std::array<double, 3> m2{};
  std::uint64_t count = 0;
  PathSums paths;
  std::array<Stratum, 3> strata;  // empty where samples are independent

  void add(const Rgb& value) noexcept;
  void add(const Rgb& value, int stratum) noexcept;
  /// Variance of the mean, per channel; 0 below two samples. Of a stratified one below kFewestStratified
  /// samples that of independent ones, which is larger.
  [[nodiscard]] std::array<double, 3> variance_of_mean() const noexcept;
};

struct Film {
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  Film() = default;
  Film(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h) {}
  [[nodiscard]] Pixel& at(int x, int y) noexcept { return pixels[static_cast<std::size_t>(y) * width + x]; }
  [[nodiscard]] const Pixel& at(int x, int y) const noexcept {
    return pixels[static_cast<std::size_t>(y) * width + x];
  }
};

/// Six channels: R G B, then the variance of each mean.
[[nodiscard]] Image resolve(const Film& film);

/// What a display shows of a film. `normals` has the film's size and three channels; without it they are 0.
[[nodiscard]] FilmPlanes resolve_planes(const Film& film, const Image* normals);

/// Row y of resolve_planes, into planes of the film's size. Rows may be resolved at the same time.
void resolve_row(const Film& film, const Image* normals, int y, FilmPlanes& planes) noexcept;

/// Mean over all pixels, per channel.
[[nodiscard]] std::array<double, 3> mean_of(const Film& film);

}  // namespace meander
