// How many samples the next pass of a progressive image takes: the plan as a pure function of what has been
// done.
#pragma once

#include <cstdint>
#include <optional>

namespace meander {

/// What ends an image; the first that is met does. With none set it goes on for ever.
struct Budget {
  std::optional<std::uint64_t> spp;  // samples a pixel
  std::optional<double> seconds;
  std::optional<double> error;  // relative noise, see film.h
};

/// What has been done: samples a pixel, the seconds they took, and the relative noise they left.
struct Progress {
  std::uint64_t spp = 0;
  double seconds = 0;
  double noise = 0;
};

inline constexpr double kLongestPass = 0.5;  // seconds: how long a viewer may have to wait

/// Samples a pixel in the next pass, 0 when the image is done. Passes double the total (1, 1, 2, 4, …), but
/// none past the first is predicted to take over `longest` seconds (or one sample), to pass `spp`, or to pass
/// the samples at which the noise, falling as 1/sqrt(spp), reaches `error`. Noise is believed from 8 samples
/// on. The time left is filled with the nearest whole number of predicted samples, so the end is off by half
/// a sample's time at most when the prediction holds. An image of no samples takes its first whatever the
/// time, unless `spp` is 0.
[[nodiscard]] std::uint64_t next_pass(const Progress& progress, const Budget& budget,
                                      double longest = kLongestPass) noexcept;

/// The longest pass of a live image: a tenth of a second at first, so that single samples show and a stop
/// costs little, later a quarter of the time that it has taken, up to kLongestPass.
[[nodiscard]] double longest_live_pass(double seconds) noexcept;

}  // namespace meander
