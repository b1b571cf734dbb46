// What compare finds out about two images, and which of its limits that breaks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/noise.h"
#include "io/image_file.h"
#include "stats/image_error.h"

namespace meander {

/// Limits on single pixels, as idiff's: a pixel differs by its largest |d| over the channels.
struct PixelLimits {
  std::optional<double> each = {};     // a pixel that differs by more is counted; 0 beside `percent` alone
  std::optional<double> percent = {};  // of the pixels that may be counted; 0 beside `each` alone
  std::optional<double> any = {};      // no pixel may differ by more

  [[nodiscard]] bool counts() const noexcept { return each || percent; }
  [[nodiscard]] bool asked() const noexcept { return counts() || any; }
};

/// Absent: not asked. A value equal to its limit is within it.
struct CompareLimits {
  PixelLimits fail = {};
  PixelLimits warn = {};
  std::optional<double> max_rmse = {};
  std::optional<double> max_relative_rmse = {};
  std::optional<double> max_relmse = {};
  std::optional<double> max_mae = {};
  std::optional<double> min_psnr = {};
  bool z_test = false;

  /// Whether anything decides if the images agree; else they must be equal.
  [[nodiscard]] bool decide() const noexcept {
    return fail.asked() || max_rmse || max_relative_rmse || max_relmse || max_mae || min_psnr || z_test;
  }
};

/// Which pixels a noise is of.
enum class NoisePixels : std::uint8_t { all, mask, object };

/// The relative noise of an image that carries variances, see film/noise.h.
struct ImageNoise {
  double relative = 0;
  std::size_t pixels = 0;
  NoisePixels over = NoisePixels::all;
  NoiseDoubt doubt = NoiseDoubt::none;  // of the variances of all compared pixels
};

struct Comparison {
  ImageError error;
  MeanDifference mean;
  std::optional<ImageNoise> noise_a;  // where the image carries variances
  std::optional<ImageNoise> noise_b;
  std::optional<std::size_t> beyond_fail;  // pixels, where it is asked
  std::optional<std::size_t> beyond_warn;
  std::optional<ZTest> z;
  std::vector<std::string> failures;  // one line each: value, limit, option
  std::vector<std::string> warnings;

  [[nodiscard]] bool passed() const noexcept { return failures.empty(); }
};

/// Compares A with the reference B over the mask's pixels. A value that is not finite always fails. Error
/// (input) as image_error and, with limits.z_test, as z_test.
[[nodiscard]] Comparison compare_images(const Image& a, const Image& b, std::span<const std::uint8_t> mask,
                                        const CompareLimits& limits);

/// With the z-test asked for, a warning when both files say that they hold the same samples: the noise of A
/// and B is then not independent, as the test takes it to be.
void warn_of_shared_samples(const ImageAttributes& a, const ImageAttributes& b, Comparison& comparison);

/// The noise over the object's pixels as the render has stored it in its file (run_stats.h), in place of that
/// of all pixels. Leaves the noise of a mask's pixels alone, and whatever a file says nothing of.
void use_stored_noise(const ImageAttributes& attributes, std::optional<ImageNoise>& noise);

/// A line a quantity: name, value, and what belongs to it.
[[nodiscard]] std::string comparison_text(const Comparison& comparison);

/// The same as one JSON object; what is not finite (the PSNR of equal images) or not known is null.
[[nodiscard]] std::string comparison_json(const Comparison& comparison);

}  // namespace meander
