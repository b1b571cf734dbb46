// How far one image is from another: error metrics, and the z-test that knows the noise of both. `mask` has
// one byte a pixel, non-zero where it counts; an empty or all-zero mask counts every pixel. Images of
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
  std::size_t pixels = 0;    // counted
  std::size_t non_finite = 0;
};

[[nodiscard]] ImageError image_error(const Image& a, const Image& reference,
                                     std::span<const std::uint8_t> mask = {});

/// What a z-test may take for chance.
struct ZTestOptions {
  double alpha = 0.01;             // chance of failing although both images have the same expectation
  double pixels_passing = 0.9975;  // least fraction of the values that must agree one by one
  int block = 8;                   // side of a block, pixels
};

/// Verdict and evidence of a z-test. A threshold is the |z| above which a value, a block or an image mean is
/// no chance; a p-value is corrected for the number of blocks or of channels.
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
  double block_p = 1;
  double image_p = 1;
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
/// samples a pixel or more. Where rare bright samples carry the mean, a sum that missed them has a small
/// variance too; there give both images equally many samples, or the noisier one 64 and more.
[[nodiscard]] ZTest z_test(const Image& a, const Image& b, std::span<const std::uint8_t> mask = {},
                           const ZTestOptions& options = {});

}  // namespace meander
