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

using Channels = std::array<double, 3>;

// The means and their variances, of a film or of an image that was resolved from one.
struct FilmSource {
  const Film& film;
  [[nodiscard]] int width() const noexcept { return film.width; }
  [[nodiscard]] int height() const noexcept { return film.height; }
  [[nodiscard]] Channels mean(int x, int y) const noexcept { return film.at(x, y).mean; }
  [[nodiscard]] Channels variance(int x, int y) const noexcept { return film.at(x, y).variance_of_mean(); }
};
struct ImageSource {
  const Image& image;
  [[nodiscard]] int width() const noexcept { return image.width; }
  [[nodiscard]] int height() const noexcept { return image.height; }
  [[nodiscard]] Channels mean(int x, int y) const noexcept { return three(image.at(x, y)); }
  [[nodiscard]] Channels variance(int x, int y) const noexcept { return three(image.at(x, y) + 3); }
  static Channels three(const float* p) noexcept { return {double{p[0]}, double{p[1]}, double{p[2]}}; }
};

// The counted pixels of a source.
template <class Source>
struct Counted {
  Source source;
  std::span<const std::uint8_t> mask;  // empty when every pixel counts

  [[nodiscard]] bool at(int x, int y) const noexcept {
    return mask.empty() || mask[static_cast<std::size_t>(y) * source.width() + x] != 0;
  }

  // Row y - 1 to y + 1 of a column.
  [[nodiscard]] MeanSum column(int x, int y) const noexcept {
    MeanSum sum;
    for (int row = std::max(y - 1, 0); row < std::min(y + 2, source.height()); ++row)
      if (at(x, row)) sum += {source.mean(x, row), 1};
    return sum;
  }
};

// What the pixels' relative variances say.
struct Variances {
  double sum = 0;  // with the neighbours' mean
  double own = 0;  // with the pixel's own
  double pixels = 0;
  double squared_differences = 0;  // of neighbours in a row
  double pairs = 0;
};

// v / (m^2 + 1e-4), summed over the channels.
double relative_variance(const Channels& variance, const Channels& mean, double pixels) noexcept {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double m = mean[c] / pixels;
    sum += variance[c] / (m * m + kFloor);
  }
  return sum;
}

template <class Source>
void gather_row(const Counted<Source>& counted, int y, std::vector<MeanSum>& columns, Variances& all) {
  const int width = counted.source.width();
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
    const Channels variance = counted.source.variance(x, y);
    const double value = relative_variance(variance, around.mean, around.pixels);
    all.sum += value;
    all.own += relative_variance(variance, counted.source.mean(x, y), 1);
    ++all.pixels;
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

// An all-zero mask counts every pixel, as none does.
std::span<const std::uint8_t> effective(std::span<const std::uint8_t> mask) noexcept {
  const bool some = std::any_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; });
  return some ? mask : std::span<const std::uint8_t>();
}

template <class Source>
NoiseEstimate estimate(const Source& source, std::span<const std::uint8_t> mask) {
  const Counted<Source> counted{source, mask};
  Variances all;
  std::vector<MeanSum> columns(static_cast<std::size_t>(source.width()));
  for (int y = 0; y < source.height(); ++y) gather_row(counted, y, columns, all);
  if (all.pixels == 0) return {};
  NoiseEstimate result{std::sqrt(all.sum / (3 * all.pixels)), standard_error(all),
                       std::sqrt(all.own / (3 * all.pixels)), NoiseDoubt::none,
                       static_cast<std::size_t>(all.pixels)};
  if (result.noise > kMostNoiseRatio * result.own)
    result.doubt = NoiseDoubt::rare_bright_samples;
  else if (result.standard_error > kMostNoiseError)
    result.doubt = NoiseDoubt::too_few_pixels;
  return result;
}

}  // namespace

NoiseEstimate estimate_noise(const Film& film, std::span<const std::uint8_t> mask) {
  assert(mask.empty() || mask.size() == film.pixels.size());
  const auto counted = effective(mask);
  for (std::size_t i = 0; i < film.pixels.size(); ++i)
    if (film.pixels[i].count < 2 && (counted.empty() || counted[i] != 0))
      return {kInfinity, kInfinity, kInfinity, NoiseDoubt::too_few_samples, 0};
  return estimate(FilmSource{film}, counted);
}

NoiseEstimate estimate_noise(const Image& resolved, std::span<const std::uint8_t> mask) {
  assert(resolved.channels >= 6);
  assert(mask.empty() || mask.size() == static_cast<std::size_t>(resolved.width) * resolved.height);
  return estimate(ImageSource{resolved}, effective(mask));
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
