// Measured materials by name, as published, per millimetre.
#pragma once

#include <span>
#include <string_view>

#include "medium/coefficients.h"

namespace meander {

/// sigma_s and sigma_a in mm^-1 per channel (linear RGB). sigma_s is the full coefficient that goes with the
/// measured g of each channel; where only the reduced sigma_s' was measured, g is 0 and sigma_s is that. ior
/// is the index of refraction that the source names.
struct Preset {
  std::string_view name;
  DVec3 sigma_s;
  DVec3 sigma_a;
  DVec3 g;
  double ior;
  std::string_view source;
};

/// Jensen et al. 2001 and a choice of Narasimhan et al. 2006; names like "marble", "whole_milk", "espresso".
[[nodiscard]] std::span<const Preset> presets();

/// Null when there is none of this name.
[[nodiscard]] const Preset* find_preset(std::string_view name);

/// The one g that a medium has for a preset: the mean of its three.
[[nodiscard]] double mean_g(const Preset& preset);

/// The preset with one g, |g| < 1, for all channels, per millimetre: each channel holds its measured sigma_a
/// and sigma_s' = sigma_s (1 - g).
[[nodiscard]] Coefficients preset_coefficients(const Preset& preset, double g);

}  // namespace meander
