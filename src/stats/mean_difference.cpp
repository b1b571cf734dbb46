#include <cmath>
#include <limits>

#include "stats/counted_pixels.h"
#include "stats/image_error.h"
#include "stats/moments.h"

namespace meander {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Sums over the counted pixels.
struct Sums {
  std::array<Moments, 3> channels;  // of the differences
  Moments pixels;                   // of each pixel's mean difference
  std::array<double, 3> variance{};
  double pixel_variance = 0;  // of each pixel's sum over the channels, if they were fully correlated
};

double variance_at(const Image& image, std::size_t pixel, int channel) {
  if (image.channels < 6) return 0;
  const double variance = image.values[pixel * image.channels + channel + 3];
  return variance >= 0 ? variance : kNan;
}

void add_pixel(const Image& a, const Image& b, std::size_t pixel, Sums& sums) {
  double sum = 0;
  double deviation = 0;
  int finite = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const double d = double{a.values[pixel * a.channels + channel]} - b.values[pixel * b.channels + channel];
    if (!std::isfinite(d)) continue;
    const double variance = variance_at(a, pixel, channel) + variance_at(b, pixel, channel);
    sums.channels[channel].add(d);
    sums.variance[channel] += variance;
    deviation += std::sqrt(variance);
    sum += d;
    ++finite;
  }
  if (finite > 0) sums.pixels.add(sum / finite);
  sums.pixel_variance += deviation * deviation;
}

ErrorSource source_of(const Image& a, const Image& b) {
  if (a.channels >= 6) return b.channels >= 6 ? ErrorSource::both_variances : ErrorSource::variance_of_a;
  return b.channels >= 6 ? ErrorSource::variance_of_b : ErrorSource::spread;
}

double spread_error(const Moments& moments) { return moments.count < 2 ? kNan : moments.standard_error(); }

// The standard error of the mean of `count` differences whose sum has this variance.
double sum_error(double variance, double count) {
  const double error = std::sqrt(variance) / count;
  return std::isfinite(error) ? error : kNan;
}

}  // namespace

MeanDifference mean_difference(const Image& a, const Image& reference, std::span<const std::uint8_t> mask) {
  const CountedPixels counted(a, reference, mask, 3);
  Sums sums;
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(a.width) * a.height; ++pixel)
    if (counted.counts(pixel)) add_pixel(a, reference, pixel, sums);

  MeanDifference result;
  result.source = source_of(a, reference);
  const bool spread = result.source == ErrorSource::spread;
  Moments all;
  for (int channel = 0; channel < 3; ++channel) {
    const Moments& moments = sums.channels[channel];
    all.merge(moments);
    result.channel_mean[channel] = moments.count == 0 ? kNan : moments.mean;
    result.channel_standard_error[channel] =
        spread ? spread_error(moments)
               : sum_error(sums.variance[channel], static_cast<double>(moments.count));
  }
  result.mean = all.count == 0 ? kNan : all.mean;
  result.standard_error =
      spread ? spread_error(sums.pixels) : sum_error(sums.pixel_variance, static_cast<double>(all.count));
  return result;
}

}  // namespace meander
