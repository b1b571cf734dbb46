// The medium of a scene file's material: its parametrisations, presets and surface, read, checked, resolved
// and rewritten.
#pragma once

#include "io/toml_table.h"
#include "medium/color_maps.h"
#include "scene/material_description.h"

namespace meander {

/// The parametrisation that a key belongs to, if it belongs to one.
[[nodiscard]] std::optional<Parametrisation> parametrisation_of(std::string_view key);

/// What reading a medium needs: `millimetres_per_unit` turns coefficients per millimetre into ones per scene
/// unit.
struct MediumTools {
  double millimetres_per_unit = 1;
  ColorMaps& color_maps;
};

/// What the keys of a translucent material say.
struct MediumKeys {
  std::string preset;         // empty when there is none
  Coefficients coefficients;  // per scene unit; zero when lambertian
  Surface surface;
  double roughness = 0;
  GLock g_lock = GLock::look;
  std::optional<Parametrisation> given;  // none when all comes from a preset
  bool lambertian = false;  // radius = 0: nothing gets in but a plain diffuse reflection of `color`
  DVec3 color{0};           // of the colour parametrisation, as is `inversion`
  DVec3 radius{0};          // without radius_scale
  DVec3 radius_scale{1};
  Inversion inversion = Inversion::exact;
};

/// Reads the medium and its surface. Albedo and colour take lengths in scene units.
/// With `preset` the other keys override it: `g` holds its sigma_s' = sigma_s (1 - g) and sigma_a; then one
/// member alone of a parametrisation (color, radius, albedo, mean_free_path, sigma_s, sigma_a) holds the
/// other member. A preset's boundary is dielectric with its own ior, unless said otherwise. Errors: Error
/// with the place.
[[nodiscard]] MediumKeys read_medium(TomlTable& table, const MediumTools& tools);

/// Rewrites a translucent material's table in another parametrisation of the same medium, everything else
/// held. Errors: as read_medium.
void convert_material(toml::table& table, Parametrisation target, const std::string& file,
                      const MediumTools& tools);

/// Prepares a translucent material's table for another g, |g| < 1, which is left to the caller to set:
/// rewrites the members of its parametrisation so that what `g_lock` says is held (similarity.h). Where the
/// material is given by colour, look and sigma_t hold the `color` key as it is, and with it sigma_t' or
/// sigma_t; with the inversions of the literature the colour delivered is then as good as they are. Errors:
/// as read_medium.
void hold_for_g(toml::table& table, double g, const std::string& file, const MediumTools& tools);

/// Forgets the medium, for a preset to take its place: every parametrisation's members and g.
void clear_medium(toml::table& table);

}  // namespace meander
