// The relative noise of a film, and how far that estimate can be trusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "film/film.h"

namespace meander {

/// Why an estimate of the noise is not reliable.
enum class NoiseDoubt { none, too_few_samples, rare_bright_samples, too_few_pixels };

struct NoiseEstimate {
  double noise = 0;
  double standard_error = 0;  // of `noise`, relative to it
  double own = 0;             // the noise with every pixel divided by its own mean alone
  NoiseDoubt doubt = NoiseDoubt::none;
  std::size_t pixels = 0;  // that it is of; 0 where it is infinite
  [[nodiscard]] bool reliable() const noexcept { return doubt == NoiseDoubt::none; }
};

/// The noise over the own noise above which rare bright samples are taken to carry it, and the standard error
/// above which the pixels are too few to be within 10 % in 95 of 100 cases. tests/calibration has the
/// measurements: from 64 samples a pixel on, ten ordinary scenes stay below 1.15, scenes prone to fireflies
/// above 1.29.
inline constexpr double kMostNoiseRatio = 1.25;
inline constexpr double kMostNoiseError = 0.05;

/// The noise is sqrt(mean over channels and masked pixels of v / (m^2 + 1e-4)), v the variance of the pixel's
/// mean, m the true mean, for which the average of the masked pixels among its 3 x 3 stands. `mask` has one
/// entry a pixel, non-zero where it counts; an empty or all-zero mask counts every pixel. All infinite while
/// a counted pixel has fewer than two samples; 0 without pixels.
///
/// Not the pixel's own mean: a bright sample raises that together with v, so that v / m^2 is too low where
/// bright samples are rare, and never above 1, the value of one sample that outshines all others. On ten
/// scenes of 32 x 32 at 64 samples a pixel the noise is up to 14 % too low with a pixel's own mean, up to 3 %
/// with its neighbours' (tests/calibration/noise.csv).
///
/// The doubts. A variance that rare samples carry is estimated too low, and nothing in the estimate itself
/// tells (Chatterjee and Diaconis 2018, "The sample size required in importance sampling", section 2); but
/// the difference between both divisions tells how far single samples carry their pixels. The standard error
/// comes from the differences of v / m^2 between neighbours in a row, so that a picture's own gradients are
/// not taken for chance. What no pixel has met yet stays unknown.
[[nodiscard]] NoiseEstimate estimate_noise(const Film& film, std::span<const std::uint8_t> mask);

/// The same of a resolved film (R G B, then the variance of each mean), whose samples are taken to be enough.
[[nodiscard]] NoiseEstimate estimate_noise(const Image& resolved, std::span<const std::uint8_t> mask);

/// The doubt in words, "" without one.
[[nodiscard]] const char* describe(NoiseDoubt doubt) noexcept;

}  // namespace meander
