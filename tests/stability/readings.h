// What an image says: the mean of each of its quarters and of the whole, with standard errors.
#pragma once

#include <array>

#include "film/film.h"

namespace meander {

struct Reading {
  double value = 0;
  double error = 0;
};

/// Four quarters, row by row, and the whole, last; three channels each.
inline constexpr int kRegions = 5;
inline constexpr int kWhole = 4;
using Readings = std::array<std::array<Reading, 3>, kRegions>;

/// The whole as the mean of the quarters.
void fill_whole(Readings& readings);

/// Of a film of even width and height, or of one pixel, whose quarters are all that pixel.
[[nodiscard]] Readings readings_of(const Film& film);

/// scale * (value - offset), and the error with it.
[[nodiscard]] Readings rescaled(Readings readings, double offset, double scale);

/// The largest |z| of the difference over the regions and channels that count: the first channel alone where
/// `grey`, the whole alone where `whole`. Each side is granted the rounding `floor`.
[[nodiscard]] double worst_z(const Readings& a, const Readings& b, bool grey, bool whole, double floor);

}  // namespace meander
