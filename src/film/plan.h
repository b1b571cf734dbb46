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
  std::optional<double> error;  // relative noise, see noise.h
};

/// What has been done: samples a pixel, the seconds they took, the relative noise they left, and whether that
/// estimate is reliable, see noise.h.
struct Progress {
  std::uint64_t spp = 0;
  double seconds = 0;
  double noise = 0;
  bool reliable = true;
};

/// Which part of a budget ends an image.
enum class Ending { none, spp, seconds, error };

inline constexpr double kLongestPass = 0.5;  // seconds: how long a viewer may have to wait

/// Samples a pixel in the next pass, 0 when the image is done. Passes double the total (1, 1, 2, 4, …), but
/// none past the first is predicted to take over `longest` seconds or a twentieth of `seconds` (though 0.05 s
/// and one sample are allowed), to pass `spp`, or to pass the samples at which the noise, falling as
/// 1/sqrt(spp), reaches `error`. Noise is believed from 16 samples on, where it is on average up to 9 % too
/// low (tests/calibration), and less later. One that is unreliable is believed when it is half of `error`: it
/// falls short, and does so less and less, so that four times the samples give it the chance to show; a scene
/// that stays unreliable ends all the same. The time left is filled with the nearest whole number of
/// predicted samples, so the end is off by half a sample's time at most when the prediction holds. An image
/// of no samples takes its first whatever the time, unless `spp` is 0.
[[nodiscard]] std::uint64_t next_pass(const Progress& progress, const Budget& budget,
                                      double longest = kLongestPass) noexcept;

/// What ended the image: the budget that `progress` has met, `error` before `spp` before `seconds` where it
/// met several; none while next_pass goes on.
[[nodiscard]] Ending ended_by(const Progress& progress, const Budget& budget) noexcept;

/// Which part of the budget will end the image, in how many seconds, and the noise that it will then have,
/// if samples go on to cost what they did and the noise falls as 1/sqrt(spp).
struct Forecast {
  Ending ending = Ending::none;  // none when nothing is known yet, or the image goes on for ever
  double seconds = 0;            // from now
  double noise = 0;              // at the end
};
[[nodiscard]] Forecast forecast(const Progress& progress, const Budget& budget) noexcept;

/// Seconds from now until the noise is `error`, falling as 1/sqrt(spp); 0 when it is. Nothing when the noise
/// or its cost is not known yet, or `error` is not above 0.
[[nodiscard]] std::optional<double> seconds_to_error(const Progress& progress, double error) noexcept;

/// The longest pass of a live image: a tenth of a second at first, so that single samples show and a stop
/// costs little, later a quarter of the time that it has taken, up to kLongestPass.
[[nodiscard]] double longest_live_pass(double seconds) noexcept;

}  // namespace meander
