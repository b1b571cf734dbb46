// The way from a slider's place to its value and back.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "medium/color_map.h"

namespace meander {

/// color: the value is a single-scattering albedo and the place is the colour that it delivers.
enum class Spacing : std::uint8_t { linear, logarithmic, color };

/// Places go from 0 (value `low`) to 1 (value `high`); low < high, and 0 < low where logarithmic. `color`
/// needs `map`, which must outlive it, and goes from 0 to 1.
struct SliderMap {
  Spacing spacing = Spacing::linear;
  double low = 0;
  double high = 1;
  const ColorMap* map = nullptr;
};

/// Clamped to [0, 1]; rises with the value.
[[nodiscard]] double place_of(const SliderMap& map, double value);
/// Of a place in [0, 1], the ends exactly; its inverse.
[[nodiscard]] double value_at(const SliderMap& map, double place);

/// A value marked on the track, where the slider catches; without a name it is only a notch.
struct Tick {
  double value = 0;
  const char* name = "";
};

/// The value at a place, caught by a tick nearer than `reach` (in places), else rounded to the decimal digits
/// that a tenth of a `step` (in places) can tell apart.
[[nodiscard]] double settled(const SliderMap& map, std::span<const Tick> ticks, double place,
                             const std::array<double, 2>& reach_and_step);

/// The number that was typed, clamped to the limits; nothing when it is none. A comma is a point.
[[nodiscard]] std::optional<double> typed_number(const std::string& text, double low, double high);

}  // namespace meander
