// How far one image is from another: error metrics, and the z-test that knows the noise of both. An image has
// the channels R G B and, from the fourth on, the variance of the mean of each where it knows them. `mask`
// has one byte a pixel, non-zero where it counts; an empty or all-zero mask counts every pixel. Images of
// different sizes, with too few channels, or a mask of another size throw Error (input).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/image.h"

namespace meander {

/// Means run over the first three channels of the counted pixels, d = a - b, b the reference. A value that is
/// not finite in either image is left out of everything and counted in `non_finite`; NaN when none is left.
struct ImageError {
  double mse = 0;            // mean d^2
  double rmse = 0;           // sqrt(mse)
  double relative_rmse = 0;  // rmse / mean |b|
  double relmse = 0;         // mean d^2 / (b^2 + 1e-4)
  double mae = 0;            // mean |d|
  double psnr = 0;           // -10 log10(mse), decibels at peak 1; +infinity when equal
  double mean_signed = 0;    // mean d
  double max_abs = 0;        // largest |d|
  int max_x = -1;            // its pixel and channel, the first in reading order; -1 where all d are 0
  int max_y = -1;
  int max_channel = -1;
  std::size_t pixels = 0;  // counted
  std::size_t non_finite = 0;
};

[[nodiscard]] ImageError image_error(const Image& a, const Image& reference,
                                     std::span<const std::uint8_t> mask = {});

/// Where the standard error of a mean difference comes from.
enum class ErrorSource : std::uint8_t { both_variances, variance_of_a, variance_of_b, spread };

/// The mean of d = a - b over everything and per channel, each with its standard error.
struct MeanDifference {
  double mean = 0;
  double standard_error = 0;
  std::array<double, 3> channel_mean{};
  std::array<double, 3> channel_standard_error{};
  ErrorSource source = ErrorSource::spread;
};

/// Values that are not finite are left out, as from ImageError. Pixels count as independent.
/// - Where images carry variances: a channel's standard error is sqrt(sum of v_a + v_b) / n. The three
///   channels of a pixel share their walks, so the error over all of them takes them as fully correlated: an
///   upper bound. An image without variances counts as free of noise. A variance that is negative or not
///   finite makes the error NaN.
/// - Where neither does: the standard error of the mean of the pixels' differences, taken as a sample. It
///   holds how the difference varies over the picture besides the noise. NaN below two pixels.
[[nodiscard]] MeanDifference mean_difference(const Image& a, const Image& reference,
                                             std::span<const std::uint8_t> mask = {});

/// How many counted pixels have a channel with |d| above `threshold`, or one that is not finite.
[[nodiscard]] std::size_t pixels_beyond(const Image& a, const Image& reference, double threshold,
                                        std::span<const std::uint8_t> mask = {});

/// What a z-test may take for chance.
struct ZTestOptions {
  double alpha = 0.01;             // chance of failing although both images have the same expectation
  double pixels_passing = 0.9975;  // least fraction of the values that must agree one by one
  int block = 8;                   // side of a block, pixels
};

/// Verdict and evidence of a z-test. A threshold is the |z| above which a value, a block or an image mean is
/// no chance; a p-value is corrected for the number of values, blocks or channels: the least alpha at which
/// that part, for `p` the whole test, fails. With a value that is not finite `p` is 0.
struct ZTest {
  bool passed = false;
  bool pixels_passed = false;
  bool blocks_passed = false;
  bool image_passed = false;
  std::size_t values = 0;  // tested: counted pixels times three
  std::size_t non_finite = 0;
  double failed_fraction = 0;  // of the values
  double worst_pixel_z = 0;    // signed, as are all z: positive where a is brighter
  double worst_block_z = 0;
  std::array<double, 3> image_z{};
  double pixel_threshold = 0;
  double block_threshold = 0;
  double image_threshold = 0;
  double pixels_p = 1;
  double block_p = 1;
  double image_p = 1;
  double p = 1;
};

/// Do two renders, each with the channels R G B and the variance of the mean of each, have the same
/// expectation? Three families of two-sided tests, all of which must pass:
/// - every value alone at the Sidak level of alpha, of which `pixels_passing` must agree (broken pixels);
///   its variance in either image is at least the mean of its block, unless both are 0;
/// - every block of pixels, per channel: sum of differences over its standard error (a broken region);
///   blocks less than half full are pooled;
/// - the whole image, per channel (a bias no pixel shows). The last two share alpha.
/// Rounding is granted a standard error of 1e-6 (|a| + |b|) a value, fully correlated within a sum: values
/// without variance, as in a furnace, must agree within about 1e-5 relative. A non-finite value or variance
/// fails the test. The thresholds are the normal's while the variances are estimates: give each image 8
/// samples a pixel or more.
///
/// The variance of a block is in either image at least what the other's says, scaled by the channel's median
/// ratio: where rare bright samples carry the mean, a block that missed them has a small variance too, and
/// would fail on its own. As in the pooled and the score test of two samples (Rao 1948), the hypothesis lends
/// it the variance of the image that knows it better. A firefly in one image widens its own block in both.
[[nodiscard]] ZTest z_test(const Image& a, const Image& b, std::span<const std::uint8_t> mask = {},
                           const ZTestOptions& options = {});

/// The z that z_test judges one by one, three channels each, signed as there.
struct ZScores {
  Image values;  // as large as the images; 0 where a value is not counted or not finite
  Image blocks;  // a pixel a block; 0 where nothing is counted; small blocks are not pooled
};

/// For a picture of where z_test finds what it finds. The same errors.
[[nodiscard]] ZScores z_scores(const Image& a, const Image& b, std::span<const std::uint8_t> mask = {},
                               const ZTestOptions& options = {});

}  // namespace meander
