#include "medium/presets.h"

#include <array>
#include <cassert>
#include <cmath>

namespace meander {

namespace {

// sigma_s here is the reduced one, as measured.
constexpr std::string_view kJensen =
    "Jensen, Marschner, Levoy, Hanrahan 2001, \"A Practical Model for Subsurface Light Transport\", figure 5";
// Undiluted, full sigma_s with the measured g. The powders are concentrations in water.
constexpr std::string_view kNarasimhan =
    "Narasimhan, Gupta, Donner, Ramamoorthi, Nayar, Jensen 2006, \"Acquiring Scattering Properties of "
    "Participating Media by Dilution\"";

constexpr double kWater = 1.33;

constexpr std::array<Preset, 30> kPresets{{
    {"apple", {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, {0, 0, 0}, 1.3, kJensen},
    {"chicken1", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, {0, 0, 0}, 1.3, kJensen},
    {"chicken2", {0.19, 0.25, 0.32}, {0.018, 0.088, 0.20}, {0, 0, 0}, 1.3, kJensen},
    {"cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, {0, 0, 0}, 1.3, kJensen},
    {"ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, {0, 0, 0}, 1.3, kJensen},
    {"marble", {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, {0, 0, 0}, 1.5, kJensen},
    {"potato", {0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, {0, 0, 0}, 1.3, kJensen},
    {"skim_milk", {0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, {0, 0, 0}, 1.3, kJensen},
    {"skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, {0, 0, 0}, 1.3, kJensen},
    {"skin2", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, {0, 0, 0}, 1.3, kJensen},
    {"whole_milk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, {0, 0, 0}, 1.3, kJensen},
    {"spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}, {0, 0, 0}, 1.3, kJensen},
    {"low_fat_milk",
     {13.1157, 15.4445, 17.9572},
     {0.00287, 0.00575, 0.0115},
     {0.932, 0.902, 0.859},
     kWater,
     kNarasimhan},
    {"reduced_milk",
     {13.7335, 15.6003, 17.8007},
     {0.00256, 0.00511, 0.01278},
     {0.819, 0.797, 0.746},
     kWater,
     kNarasimhan},
    {"regular_milk",
     {18.2052, 20.3826, 22.3698},
     {0.00153, 0.0046, 0.01993},
     {0.750, 0.714, 0.681},
     kWater,
     kNarasimhan},
    {"low_fat_soy_milk",
     {2.03838, 2.32875, 3.90281},
     {0.00144, 0.00719, 0.03594},
     {0.850, 0.853, 0.842},
     kWater,
     kNarasimhan},
    {"regular_soy_milk",
     {4.66325, 5.20183, 8.74575},
     {0.00192, 0.00958, 0.06517},
     {0.873, 0.858, 0.832},
     kWater,
     kNarasimhan},
    {"low_fat_chocolate_milk",
     {9.8371, 11.4954, 13.1629},
     {0.0115, 0.0368, 0.1564},
     {0.934, 0.927, 0.916},
     kWater,
     kNarasimhan},
    {"regular_chocolate_milk",
     {10.5685, 13.1416, 15.2202},
     {0.01006, 0.04313, 0.14375},
     {0.862, 0.838, 0.806},
     kWater,
     kNarasimhan},
    {"espresso",
     {7.78262, 8.1305, 8.53875},
     {4.79838, 6.57512, 8.84925},
     {0.907, 0.896, 0.880},
     kWater,
     kNarasimhan},
    {"mint_mocha",
     {3.51133, 4.14383, 5.59667},
     {3.772, 5.82283, 7.82},
     {0.910, 0.907, 0.914},
     kWater,
     kNarasimhan},
    {"suisse_mocha_powder",
     {30.0848, 33.4452, 38.7191},
     {17.502, 27.0044, 35.4334},
     {0.907, 0.894, 0.888},
     kWater,
     kNarasimhan},
    {"cappuccino_powder",
     {12.2094, 16.4659, 29.2727},
     {35.8441, 49.547, 61.0844},
     {0.849, 0.843, 0.926},
     kWater,
     kNarasimhan},
    {"white_grapefruit_juice",
     {0.50499, 0.52742, 0.75282},
     {0.0138, 0.01883, 0.05678},
     {0.548, 0.545, 0.565},
     kWater,
     kNarasimhan},
    {"ruby_grapefruit_juice",
     {0.15496, 0.15391, 0.15995},
     {0.08587, 0.18314, 0.25262},
     {0.929, 0.929, 0.931},
     kWater,
     kNarasimhan},
    {"apple_juice",
     {0.00257, 0.00311, 0.00413},
     {0.01296, 0.02374, 0.05218},
     {0.947, 0.949, 0.945},
     kWater,
     kNarasimhan},
    {"head_and_shoulders",
     {0.26747, 0.27696, 0.29574},
     {0.08462, 0.15688, 0.20365},
     {0.911, 0.896, 0.884},
     kWater,
     kNarasimhan},
    {"gatorade",
     {0.03668, 0.04488, 0.05742},
     {0.02479, 0.01929, 0.00888},
     {0.933, 0.933, 0.935},
     kWater,
     kNarasimhan},
    {"clorox",
     {0.02731, 0.03302, 0.03695},
     {0.00335, 0.01489, 0.0263},
     {0.912, 0.905, 0.892},
     kWater,
     kNarasimhan},
    {"salt_powder",
     {0.13805, 0.15677, 0.17865},
     {0.28415, 0.3257, 0.34148},
     {0.802, 0.793, 0.821},
     kWater,
     kNarasimhan},
}};

}  // namespace

std::span<const Preset> presets() { return kPresets; }

const Preset* find_preset(std::string_view name) {
  for (const Preset& preset : kPresets) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

double mean_g(const Preset& preset) { return (preset.g.x + preset.g.y + preset.g.z) / 3; }

Coefficients preset_coefficients(const Preset& preset, double g) {
  assert(std::abs(g) < 1);
  return {preset.sigma_s * (1.0 - preset.g) / (1 - g), preset.sigma_a, g};
}

}  // namespace meander
