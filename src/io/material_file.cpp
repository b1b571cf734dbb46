#include "io/material_file.h"

#include <array>

#include "io/medium_file.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 3> kTypes{"translucent", "diffuse", "emissive"};

}  // namespace

Material read_material(TomlTable& table, double millimetres_per_unit) {
  const std::size_t type = table.choice("type", kTypes).value_or(0);
  if (type == 1)
    return {{}, DiffuseMaterial{Rgb(table.triple("color", kUnitInterval, true).value_or(DVec3(0.5)))}};
  if (type == 2)
    return {{}, EmissiveMaterial{Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(1)))}};
  const MediumKeys keys = read_medium(table, millimetres_per_unit);
  if (keys.lambertian) return {{}, DiffuseMaterial{Rgb(keys.color)}};
  TranslucentMaterial material;
  material.medium = make_medium(keys.coefficients);
  material.boundary = keys.surface.boundary;
  material.ior = keys.surface.ior;
  material.roughness = keys.roughness;
  return {{}, material};
}

}  // namespace meander
