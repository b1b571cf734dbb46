#include "film/noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace meander {
namespace {

constexpr double kFloor = 1e-4;  // of m^2
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Means of counted pixels, summed.
struct MeanSum {
  std::array<double, 3> mean{};
  double pixels = 0;

  void operator+=(const MeanSum& other) noexcept {
    for (int c = 0; c < 3; ++c) mean[c] += other.mean[c];
    pixels += other.pixels;
  }
};

// The counted pixels of a film.
struct Counted {
  const Film& film;
  const std::vector<std::uint8_t>* mask;  // null when every pixel counts

  [[nodiscard]] bool at(int x, int y) const noexcept {
    return !mask || (*mask)[static_cast<std::size_t>(y) * film.width + x] != 0;
  }

  // Row y - 1 to y + 1 of a column.
  [[nodiscard]] MeanSum column(int x, int y) const noexcept {
    MeanSum sum;
    for (int row = std::max(y - 1, 0); row < std::min(y + 2, film.height); ++row)
      if (at(x, row)) sum += {film.at(x, row).mean, 1};
    return sum;
  }
};

// What the pixels' relative variances say.
struct Variances {
  double sum = 0;  // with the neighbours' mean
  double own = 0;  // with the pixel's own
  double pixels = 0;
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();  // samples of a pixel
  double squared_differences = 0;                                    // of neighbours in a row
  double pairs = 0;
};

// v / (m^2 + 1e-4), summed over the channels.
double relative_variance(const std::array<double, 3>& variance, const std::array<double, 3>& mean,
                         double pixels) noexcept {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double m = mean[c] / pixels;
    sum += variance[c] / (m * m + kFloor);
  }
  return sum;
}

void gather_row(const Counted& counted, int y, std::vector<MeanSum>& columns, Variances& all) {
  const int width = counted.film.width;
  for (int x = 0; x < width; ++x) columns[x] = counted.column(x, y);
  double left = -1;  // the counted pixel's to the left
  for (int x = 0; x < width; ++x) {
    if (!counted.at(x, y)) {
      left = -1;
      continue;
    }
    MeanSum around = columns[x];
    if (x > 0) around += columns[x - 1];
    if (x + 1 < width) around += columns[x + 1];
    const Pixel& pixel = counted.film.at(x, y);
    const std::array<double, 3> variance = pixel.variance_of_mean();
    const double value = relative_variance(variance, around.mean, around.pixels);
    all.sum += value;
    all.own += relative_variance(variance, pixel.mean, 1);
    ++all.pixels;
    all.fewest = std::min(all.fewest, pixel.count);
    if (left >= 0) {
      all.squared_differences += (value - left) * (value - left);
      ++all.pairs;
    }
    left = value;
  }
}

// Of the noise, relative: half that of the mean relative variance.
double standard_error(const Variances& all) noexcept {
  if (all.sum == 0) return 0;
  if (all.pairs == 0) return kInfinity;
  const double deviation = std::sqrt(all.squared_differences / (2 * all.pairs));
  return 0.5 * deviation * std::sqrt(all.pixels) / all.sum;
}

}  // namespace

NoiseEstimate estimate_noise(const Film& film, const std::vector<std::uint8_t>& mask) {
  assert(mask.empty() || mask.size() == film.pixels.size());
  const bool some = std::any_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; });
  const Counted counted{film, some ? &mask : nullptr};
  Variances all;
  std::vector<MeanSum> columns(static_cast<std::size_t>(film.width));
  for (int y = 0; y < film.height; ++y) gather_row(counted, y, columns, all);
  if (all.pixels == 0) return {};
  if (all.fewest < 2) return {kInfinity, kInfinity, kInfinity, NoiseDoubt::too_few_samples};
  NoiseEstimate estimate{std::sqrt(all.sum / (3 * all.pixels)), standard_error(all),
                         std::sqrt(all.own / (3 * all.pixels)), NoiseDoubt::none};
  if (estimate.noise > kMostNoiseRatio * estimate.own)
    estimate.doubt = NoiseDoubt::rare_bright_samples;
  else if (estimate.standard_error > kMostNoiseError)
    estimate.doubt = NoiseDoubt::too_few_pixels;
  return estimate;
}

const char* describe(NoiseDoubt doubt) noexcept {
  switch (doubt) {
    case NoiseDoubt::too_few_samples:
      return "fewer than two samples a pixel";
    case NoiseDoubt::rare_bright_samples:
      return "rare bright samples carry it, so it is likely more";
    case NoiseDoubt::too_few_pixels:
      return "too few pixels to tell it within 10 %";
    case NoiseDoubt::none:
      break;
  }
  return "";
}

}  // namespace meander
