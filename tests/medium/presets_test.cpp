#include "medium/presets.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "medium/similarity.h"

namespace meander {

TEST_CASE("there are thirty presets of different names, each found by its own, with a source") {
  std::set<std::string_view> names;
  for (const Preset& preset : presets()) {
    names.insert(preset.name);
    REQUIRE(find_preset(preset.name) != nullptr);
    CHECK(find_preset(preset.name)->sigma_s == preset.sigma_s);
    CHECK(preset.source.find("20") != std::string_view::npos);
    CHECK((preset.ior == 1.3 || preset.ior == 1.33 || (preset.ior == 1.5 && preset.name == "marble")));
  }
  CHECK(names.size() == 30);
  CHECK(find_preset("marbel") == nullptr);
}

TEST_CASE("the reduced albedos and mean free paths of Jensen et al. come out as they are tabulated") {
  struct Row {
    std::string_view name;
    DVec3 albedo;
    DVec3 mean_free_path;  // mm
  };
  // alpha' and 1 / sigma_t' as rendering packages print them beside the coefficients.
  const Row rows[] = {
      {"apple", {0.9987, 0.9986, 0.9772}, {0.436, 0.418, 0.496}},
      {"chicken1", {0.909, 0.732, 0.667}, {6.061, 3.484, 1.754}},
      {"chicken2", {0.913, 0.740, 0.615}, {4.808, 2.959, 1.923}},
      {"cream", {1.0000, 0.9995, 0.9949}, {0.135, 0.183, 0.316}},
      {"ketchup", {0.747, 0.067, 0.020}, {4.149, 0.962, 0.676}},
      {"marble", {0.9990, 0.9984, 0.9976}, {0.456, 0.381, 0.333}},
      {"potato", {0.9965, 0.9873, 0.8209}, {1.465, 1.410, 1.493}},
      {"skim_milk", {0.9980, 0.9980, 0.9926}, {1.426, 0.818, 0.522}},
      {"skin1", {0.9585, 0.8381, 0.6779}, {1.295, 0.952, 0.671}},
      {"skin2", {0.9882, 0.9578, 0.9251}, {0.907, 0.602, 0.517}},
      {"whole_milk", {0.9996, 0.9993, 0.9963}, {0.392, 0.311, 0.264}},
      {"spectralon", {1, 1, 1}, {0.086, 0.049, 0.067}},
  };
  for (const Row& row : rows) {
    CAPTURE(row.name);
    const Preset* preset = find_preset(row.name);
    REQUIRE(preset != nullptr);
    const Coefficients medium = preset_coefficients(*preset, mean_g(*preset));
    CHECK(medium.g == 0);
    for (int c = 0; c < 3; ++c) {
      CAPTURE(c);
      const double digits = row.albedo[c] * 1e3 == std::round(row.albedo[c] * 1e3) ? 1e-3 : 1e-4;
      CHECK(std::abs(albedo_of(medium)[c] - row.albedo[c]) <= 0.5001 * digits);
      CHECK(std::abs(1 / sigma_t_of(medium)[c] - row.mean_free_path[c]) <= 0.5001e-3);
    }
  }
}

TEST_CASE("the presets of Narasimhan et al. reduce to the sigma_s' that are in circulation") {
  struct Row {
    std::string_view name;
    DVec3 sigma_s_reduced;
    DVec3 sigma_a;
  };
  // The undiluted reduced values that pbrt-v4 lists, an independent derivation from the diluted ones.
  const Row rows[] = {
      {"low_fat_milk", {0.89187, 1.5136, 2.532}, {0.002875, 0.00575, 0.0115}},
      {"reduced_milk", {2.4858, 3.1669, 4.5214}, {0.0025556, 0.0051111, 0.012778}},
      {"regular_milk", {4.5513, 5.8294, 7.136}, {0.0015333, 0.0046, 0.019933}},
      {"espresso", {0.72378, 0.84557, 1.0247}, {4.7984, 6.5751, 8.8493}},
      {"mint_mocha", {0.31602, 0.38538, 0.48131}, {3.772, 5.8228, 7.82}},
      {"low_fat_soy_milk", {0.30576, 0.34233, 0.61664}, {0.0014375, 0.0071875, 0.035937}},
      {"regular_soy_milk", {0.59223, 0.73866, 1.4693}, {0.0019167, 0.0095833, 0.065167}},
      {"low_fat_chocolate_milk", {0.64925, 0.83916, 1.1057}, {0.0115, 0.0368, 0.1564}},
      {"regular_chocolate_milk", {1.4585, 2.1289, 2.9527}, {0.010063, 0.043125, 0.14375}},
      {"gatorade", {0.0024574, 0.003007, 0.0037325}, {0.024794, 0.019289, 0.008878}},
      {"clorox", {0.0024035, 0.0031373, 0.003991}, {0.0033542, 0.014892, 0.026297}},
      {"apple_juice", {0.00013612, 0.00015836, 0.000227}, {0.012957, 0.023741, 0.052184}},
      {"ruby_grapefruit_juice", {0.011002, 0.010927, 0.011036}, {0.085867, 0.18314, 0.25262}},
      {"white_grapefruit_juice", {0.22826, 0.23998, 0.32748}, {0.0138, 0.018831, 0.056781}},
      {"head_and_shoulders", {0.023805, 0.028804, 0.034306}, {0.084621, 0.15688, 0.20365}},
      {"cappuccino_powder", {1.8436, 2.5851, 2.1662}, {35.844, 49.547, 61.084}},
      {"salt_powder", {0.027333, 0.032451, 0.031979}, {0.28415, 0.3257, 0.34148}},
      {"suisse_mocha_powder", {2.7979, 3.5452, 4.3365}, {17.502, 27.004, 35.433}},
  };
  for (const Row& row : rows) {
    CAPTURE(row.name);
    const Preset* preset = find_preset(row.name);
    REQUIRE(preset != nullptr);
    const Coefficients medium = reduced(preset_coefficients(*preset, mean_g(*preset)));
    for (int c = 0; c < 3; ++c) {
      CAPTURE(c);
      // Half a unit of the fifth decimal of sigma_s, and rounding of the listed value.
      const double step = 0.5e-5 * (1 - preset->g[c]) + 1e-4 * row.sigma_s_reduced[c];
      CHECK(std::abs(medium.sigma_s[c] - row.sigma_s_reduced[c]) < step);
      CHECK(std::abs(medium.sigma_a[c] - row.sigma_a[c]) < 0.6e-5 + 2e-5 * row.sigma_a[c]);
    }
  }
}

TEST_CASE("a preset takes any g and holds sigma_a and sigma_s' of each channel") {
  for (const Preset& preset : presets()) {
    CHECK(mean_g(preset) == doctest::Approx((preset.g.x + preset.g.y + preset.g.z) / 3));
    for (const double g : {-0.5, 0.0, 0.9}) {
      const Coefficients medium = preset_coefficients(preset, g);
      CHECK(medium.g == g);
      CHECK(medium.sigma_a == preset.sigma_a);
      for (int c = 0; c < 3; ++c)
        CHECK(medium.sigma_s[c] * (1 - g) == doctest::Approx(preset.sigma_s[c] * (1 - preset.g[c])));
    }
  }
}

}  // namespace meander
