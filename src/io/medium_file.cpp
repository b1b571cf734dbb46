#include "io/medium_file.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "medium/presets.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 3> kTypes{"translucent", "diffuse", "emissive"};
constexpr std::array<std::string_view, 3> kBoundaries{"matched", "diffuse", "dielectric"};
constexpr std::array<std::string_view, 3> kInversions{"exact", "chiang", "van_de_hulst"};
constexpr std::array<std::string_view, 3> kLocks{"look", "sigma_t", "sigma_s_reduced"};
// Closer to 1, single precision could not tell the two apart.
constexpr Range kMeanCosine{-0.9999999, 0.9999999, false, false,
                            "greater than -1 and less than 1, by 1e-7 at least"};
constexpr Range kIndex{1, 4, false, false, "in [1, 4]"};

struct Member {
  std::string_view key;
  Parametrisation parametrisation;
};
constexpr std::array<Member, 8> kMembers{{{"color", Parametrisation::color},
                                          {"radius", Parametrisation::color},
                                          {"radius_scale", Parametrisation::color},
                                          {"inversion", Parametrisation::color},
                                          {"albedo", Parametrisation::albedo},
                                          {"mean_free_path", Parametrisation::albedo},
                                          {"sigma_s", Parametrisation::sigma},
                                          {"sigma_a", Parametrisation::sigma}}};

// Which parametrisation the table uses, if any; a mixture is an error.
std::optional<Parametrisation> find_parametrisation(const TomlTable& table) {
  const Member* first = nullptr;
  for (const Member& member : kMembers) {
    if (!table.has(member.key)) continue;
    if (!first) first = &member;
    if (member.parametrisation != first->parametrisation)
      throw Error(table.place(member.key), "'" + std::string(member.key) + "' and '" +
                                               std::string(first->key) +
                                               "' describe the medium twice; use color + radius, or albedo + "
                                               "mean_free_path, or sigma_s + sigma_a");
  }
  if (!first) return std::nullopt;
  return first->parametrisation;
}

const Preset* read_preset(TomlTable& table) {
  const auto name = table.text("preset");
  if (!name) return nullptr;
  if (const Preset* preset = find_preset(*name)) return preset;
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  const std::string nearest = nearest_name(*name, names);
  throw Error(table.place("preset"),
              "there is no preset '" + *name + "'" +
                  (nearest.empty() ? "; known: " + list_names(names) : "; did you mean '" + nearest + "'?"));
}

void read_surface(TomlTable& table, const Preset* preset, MediumKeys& keys) {
  const Boundary usual = preset ? Boundary::dielectric : Boundary::matched;
  const auto boundary = table.choice("boundary", kBoundaries);
  const auto ior = table.number("ior", kIndex);
  keys.surface.boundary = boundary ? static_cast<Boundary>(*boundary) : usual;
  keys.roughness = table.number("roughness", kUnitInterval).value_or(0);
  const bool dielectric = keys.surface.boundary == Boundary::dielectric;
  if (keys.roughness > 0 && !dielectric)
    throw Error(table.place("roughness"), "'roughness' is for boundary = \"dielectric\" alone");
  if (keys.surface.boundary == Boundary::matched) {
    if (ior.value_or(1) != 1)
      throw Error(table.place("ior"),
                  "a matched boundary has ior 1; use boundary = \"dielectric\" or \"diffuse\" for another");
    return;
  }
  if (dielectric && !ior && !preset)
    throw Error(table.place("boundary"), "a dielectric boundary needs 'ior', such as ior = 1.5");
  keys.surface.ior = ior.value_or(preset ? preset->ior : 1);
  keys.surface.roughness = keys.roughness;
}

// The value of the key; without it that of the preset, and without that an error.
DVec3 member(TomlTable& table, std::string_view key, const Range& range, const std::optional<DVec3>& preset) {
  auto value = table.triple(key, range, true);
  return table.required(value ? value : preset, key);
}

void read_color(TomlTable& table, const std::optional<Coefficients>& base, MediumKeys& keys,
                ColorMaps& maps) {
  keys.radius_scale = table.triple("radius_scale", kPositive, true).value_or(DVec3(1));
  keys.inversion = static_cast<Inversion>(table.choice("inversion", kInversions).value_or(0));
  std::optional<DVec3> color;
  std::optional<DVec3> radius;
  if (base) {
    radius = 1.0 / sigma_t_of(*base);
    if (!table.has("color")) color = color_of(albedo_of(*base), maps.of(base->g, keys.surface));
  }
  keys.color = member(table, "color", kUnitInterval, color);
  keys.radius = member(table, "radius", kNotNegative, radius);
  const int zeros = (keys.radius.x == 0) + (keys.radius.y == 0) + (keys.radius.z == 0);
  if (zeros != 0 && zeros != 3)
    throw Error(table.place("radius"),
                "'radius' must be greater than 0 in every channel, or 0 in all three (plain diffuse)");
  keys.lambertian = zeros == 3;
}

std::optional<Coefficients> base_of(const Preset* preset, double g, double millimetres_per_unit) {
  if (!preset) return std::nullopt;
  Coefficients base = preset_coefficients(*preset, g);
  base.sigma_s *= millimetres_per_unit;
  base.sigma_a *= millimetres_per_unit;
  return base;
}

// As coefficients_from_color, for the inversion and the surface of `keys`.
Coefficients invert_color(const DVec3& color, double g, const MediumKeys& keys, ColorMaps& maps) {
  const DVec3 radius = keys.radius * keys.radius_scale;
  if (keys.inversion == Inversion::exact)
    return coefficients_from_color(color, radius, maps.of(g, keys.surface));
  return coefficients_from_color(color, radius, g, keys.inversion);
}

// The coefficients of the parametrisation in `keys`, over those of the preset.
Coefficients read_coefficients(TomlTable& table, const std::optional<Coefficients>& base, double g,
                               const MediumTools& tools, MediumKeys& keys) {
  const double millimetres_per_unit = tools.millimetres_per_unit;
  if (!keys.given) return *base;
  std::optional<DVec3> first;
  std::optional<DVec3> second;
  switch (*keys.given) {
    case Parametrisation::sigma: {
      if (base) first = base->sigma_s / millimetres_per_unit;
      if (base) second = base->sigma_a / millimetres_per_unit;
      const DVec3 sigma_s = member(table, "sigma_s", kNotNegative, first);
      const DVec3 sigma_a = member(table, "sigma_a", kNotNegative, second);
      return {sigma_s * millimetres_per_unit, sigma_a * millimetres_per_unit, g};
    }
    case Parametrisation::albedo: {
      if (base) first = albedo_of(*base);
      if (base) second = 1.0 / sigma_t_of(*base);
      const DVec3 albedo = member(table, "albedo", kUnitInterval, first);
      return coefficients_from_albedo(albedo, member(table, "mean_free_path", kPositive, second), g);
    }
    case Parametrisation::color:
      break;
  }
  read_color(table, base, keys, tools.color_maps);
  if (keys.lambertian) return {{}, {}, g};
  return invert_color(keys.color, g, keys, tools.color_maps);
}

// Extinctions are floats; what is below a length of 1e-30 would be none.
void check_extinction(const TomlTable& table, const Coefficients& coefficients) {
  const DVec3 sigma_t = sigma_t_of(coefficients);
  const double most = std::max({sigma_t.x, sigma_t.y, sigma_t.z});
  if (most <= kLargest * (1 + 1e-9)) return;
  constexpr std::array<std::string_view, 4> kKeys{"radius", "mean_free_path", "sigma_s", "preset"};
  const auto* const key = std::ranges::find_if(kKeys, [&](std::string_view name) { return table.has(name); });
  char text[120];
  std::snprintf(text, sizeof text,
                "gives an extinction of %.3g per unit of length, but it must be at most 1e30", most);
  const std::string name = key == kKeys.end() ? "the medium" : "'" + std::string(*key) + "'";
  throw Error(key == kKeys.end() ? table.place() : table.place(*key), name + ' ' + text);
}

void set_sigma(toml::table& table, const Coefficients& coefficients, double millimetres_per_unit) {
  set_triple(table, "sigma_s", coefficients.sigma_s / millimetres_per_unit);
  set_triple(table, "sigma_a", coefficients.sigma_a / millimetres_per_unit);
}

// What hold_for_g does where the material is given by colour; every inversion has sigma_t as 1 / radius.
void hold_color(toml::table& table, const MediumKeys& keys, double g, ColorMaps& maps) {
  if (keys.lambertian) return;
  const bool similar = keys.g_lock == GLock::sigma_s_reduced;
  DVec3 color = keys.color;
  if (similar && keys.inversion == Inversion::exact) {
    const Coefficients held = with_g(keys.coefficients, g, keys.g_lock, keys.surface, maps);
    color = color_of(albedo_of(held), maps.of(g, keys.surface));
  }
  const Coefficients now = invert_color(color, g, keys, maps);
  const bool full = keys.g_lock == GLock::sigma_t;
  const DVec3 got = sigma_t_of(full ? now : reduced(now));
  const DVec3 wanted = sigma_t_of(full ? keys.coefficients : reduced(keys.coefficients));
  set_triple(table, "color", color);
  set_triple(table, "radius", keys.radius * got / wanted);
}

}  // namespace

std::optional<Parametrisation> parametrisation_of(std::string_view key) {
  for (const Member& member : kMembers)
    if (member.key == key) return member.parametrisation;
  return std::nullopt;
}

MediumKeys read_medium(TomlTable& table, const MediumTools& tools) {
  MediumKeys keys;
  const Preset* preset = read_preset(table);
  if (preset) keys.preset = preset->name;
  const double g = table.number("g", kMeanCosine).value_or(preset ? mean_g(*preset) : 0);
  keys.g_lock = static_cast<GLock>(table.choice("g_lock", kLocks).value_or(0));
  keys.given = find_parametrisation(table);
  if (!keys.given && !preset)
    throw Error(table.place(), table.where() +
                                   " needs color + radius, or albedo + mean_free_path, or sigma_s + "
                                   "sigma_a, or a preset");
  read_surface(table, preset, keys);
  const auto base = base_of(preset, g, tools.millimetres_per_unit);
  keys.coefficients = read_coefficients(table, base, g, tools, keys);
  check_extinction(table, keys.coefficients);
  return keys;
}

void convert_material(toml::table& table, Parametrisation target, const std::string& file,
                      const MediumTools& tools) {
  TomlTable reader(table, file, "[[material]]");
  if (reader.choice("type", kTypes).value_or(0) != 0) return;
  const auto given = find_parametrisation(reader);
  if (given == target || (!given && reader.has("preset"))) return;
  const MediumKeys keys = read_medium(reader, tools);
  if (keys.lambertian)
    throw Error(reader.place("radius"),
                "a radius of 0 is plain diffuse and has no albedo: set a radius greater than 0 first");
  for (const Member& member : kMembers) table.erase(member.key);
  if (target == Parametrisation::sigma) {
    set_sigma(table, keys.coefficients, tools.millimetres_per_unit);
    return;
  }
  const DVec3 sigma_t = sigma_t_of(keys.coefficients);
  if (!(sigma_t.x > 0 && sigma_t.y > 0 && sigma_t.z > 0))
    throw Error(Place{file, 0, 0},
                "a medium with sigma_t = 0 has no mean free path: set sigma_s and sigma_a instead");
  const DVec3 albedo = albedo_of(keys.coefficients);
  if (target == Parametrisation::albedo) {
    set_triple(table, "albedo", albedo);
    set_triple(table, "mean_free_path", 1.0 / sigma_t);
  } else {
    set_triple(table, "color", color_of(albedo, tools.color_maps.of(keys.coefficients.g, keys.surface)));
    set_triple(table, "radius", 1.0 / sigma_t);
  }
}

void hold_for_g(toml::table& table, double g, const std::string& file, const MediumTools& tools) {
  TomlTable reader(table, file, "[[material]]");
  if (reader.choice("type", kTypes).value_or(0) != 0 || !kMeanCosine.contains(g)) return;
  const MediumKeys keys = read_medium(reader, tools);
  if (g == keys.coefficients.g) return;
  if (keys.given == Parametrisation::color) {
    hold_color(table, keys, g, tools.color_maps);
    return;
  }
  const Coefficients held = with_g(keys.coefficients, g, keys.g_lock, keys.surface, tools.color_maps);
  if (keys.given == Parametrisation::albedo) {
    set_triple(table, "albedo", albedo_of(held));
    set_triple(table, "mean_free_path", 1.0 / sigma_t_of(held));
  } else {
    set_sigma(table, held, tools.millimetres_per_unit);
  }
}

void clear_medium(toml::table& table) {
  for (const Member& member : kMembers) table.erase(member.key);
  table.erase("g");
}

}  // namespace meander
