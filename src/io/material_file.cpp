#include "io/material_file.h"

#include <array>

namespace meander {
namespace {

constexpr std::array<std::string_view, 3> kTypes{"translucent", "diffuse", "emissive"};
constexpr std::array<std::string_view, 2> kBoundaries{"matched", "diffuse"};
constexpr std::array<std::string_view, 3> kInversions{"exact", "chiang", "van_de_hulst"};
constexpr Range kMeanCosine{-1, 1, true, true, "greater than -1 and less than 1"};

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

// Which parametrisation the table uses; a mixture and none at all are errors.
Parametrisation find_parametrisation(const TomlTable& table) {
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
  if (!first)
    throw Error(table.place(),
                table.where() + " needs color + radius, or albedo + mean_free_path, or sigma_s + sigma_a");
  return first->parametrisation;
}

Medium read_medium(TomlTable& table, double millimetres_per_unit) {
  const double g = table.number("g", kMeanCosine).value_or(0);
  const Parametrisation parametrisation = find_parametrisation(table);
  if (parametrisation == Parametrisation::sigma) {
    const DVec3 sigma_s = table.required(table.triple("sigma_s", kNotNegative, true), "sigma_s");
    const DVec3 sigma_a = table.required(table.triple("sigma_a", kNotNegative, true), "sigma_a");
    return medium_from_sigma(sigma_s * millimetres_per_unit, sigma_a * millimetres_per_unit, g);
  }
  if (parametrisation == Parametrisation::albedo) {
    const DVec3 albedo = table.required(table.triple("albedo", kUnitInterval, true), "albedo");
    const DVec3 path = table.required(table.triple("mean_free_path", kPositive, true), "mean_free_path");
    return medium_from_albedo(albedo, path, g);
  }
  const DVec3 color = table.required(table.triple("color", kUnitInterval, true), "color");
  const DVec3 radius = table.required(table.triple("radius", kPositive, true), "radius");
  const DVec3 scale = table.triple("radius_scale", kPositive, true).value_or(DVec3(1));
  const auto inversion = static_cast<Inversion>(table.choice("inversion", kInversions).value_or(0));
  return medium_from_color(color, radius * scale, g, inversion);
}

void set_triple(toml::table& table, std::string_view key, const DVec3& value) {
  table.insert_or_assign(key, toml::array{value.x, value.y, value.z});
}

}  // namespace

std::optional<Parametrisation> parametrisation_of(std::string_view key) {
  for (const Member& member : kMembers)
    if (member.key == key) return member.parametrisation;
  return std::nullopt;
}

Material read_material(TomlTable& table, double millimetres_per_unit) {
  const std::size_t type = table.choice("type", kTypes).value_or(0);
  if (type == 1)
    return {{}, DiffuseMaterial{Rgb(table.triple("color", kUnitInterval, true).value_or(DVec3(0.5)))}};
  if (type == 2)
    return {{}, EmissiveMaterial{Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(1)))}};
  TranslucentMaterial material;
  material.medium = read_medium(table, millimetres_per_unit);
  material.boundary = static_cast<Boundary>(table.choice("boundary", kBoundaries).value_or(0));
  return {{}, material};
}

void convert_material(toml::table& table, Parametrisation target, const std::string& file,
                      double millimetres_per_unit) {
  TomlTable reader(table, file, "[[material]]");
  if (reader.choice("type", kTypes).value_or(0) != 0 || find_parametrisation(reader) == target) return;
  const Medium medium = read_medium(reader, millimetres_per_unit);
  for (const Member& member : kMembers) table.erase(member.key);
  const DVec3 sigma_t(medium.sigma_t);
  const DVec3 albedo(medium.albedo);
  if (target == Parametrisation::sigma) {
    set_triple(table, "sigma_s", albedo * sigma_t / millimetres_per_unit);
    set_triple(table, "sigma_a", (1.0 - albedo) * sigma_t / millimetres_per_unit);
    return;
  }
  if (!(sigma_t.x > 0 && sigma_t.y > 0 && sigma_t.z > 0))
    throw Error(Place{file, 0, 0},
                "a medium with sigma_t = 0 has no mean free path: set sigma_s and sigma_a instead");
  if (target == Parametrisation::albedo) {
    set_triple(table, "albedo", albedo);
    set_triple(table, "mean_free_path", 1.0 / sigma_t);
  } else {
    set_triple(table, "color", color_of(albedo, medium.g));
    set_triple(table, "radius", 1.0 / sigma_t);
  }
}

}  // namespace meander
