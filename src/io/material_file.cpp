#include "io/material_file.h"

#include <array>
#include <cmath>

namespace meander {
namespace {

constexpr std::array<std::string_view, 3> kTypes{"translucent", "diffuse", "emissive"};

// What is neither translucent nor anything more than a colour: a reflectance, or a radiance.
DVec3 read_plain(TomlTable& table, bool emissive) {
  if (emissive) return table.triple("radiance", kNotNegative, true).value_or(DVec3(1));
  return table.triple("color", kUnitInterval, true).value_or(DVec3(0.5));
}

DVec3 diffusion_length_of(const Coefficients& c) {
  return 1.0 / glm::sqrt(3.0 * c.sigma_a * sigma_t_of(reduced(c)));
}

// Everything that follows from the coefficients.
void describe_medium(const MediumKeys& keys, const MediumTools& tools, MaterialDescription& d) {
  const Coefficients& c = keys.coefficients;
  d.albedo = albedo_of(c);
  d.mean_free_path = 1.0 / sigma_t_of(c);
  d.sigma_s = c.sigma_s / tools.millimetres_per_unit;
  d.sigma_a = c.sigma_a / tools.millimetres_per_unit;
  d.diffusion_length = diffusion_length_of(c);
  d.delivered = color_of(d.albedo, tools.color_maps.of(c.g, keys.surface));
  if (keys.given == Parametrisation::color) return;
  d.color = d.delivered;
  d.radius = d.mean_free_path;
}

}  // namespace

Material read_material(TomlTable& table, const MediumTools& tools) {
  const std::size_t type = table.choice("type", kTypes).value_or(0);
  if (type == 1) return {{}, DiffuseMaterial{Rgb(read_plain(table, false))}};
  if (type == 2) return {{}, EmissiveMaterial{Rgb(read_plain(table, true))}};
  const MediumKeys keys = read_medium(table, tools);
  if (keys.lambertian) return {{}, DiffuseMaterial{Rgb(keys.color)}};
  TranslucentMaterial material;
  material.medium = make_medium(keys.coefficients);
  material.boundary = keys.surface.boundary;
  material.ior = keys.surface.ior;
  material.roughness = keys.roughness;
  return {{}, material};
}

MaterialDescription describe_material(TomlTable& table, const MediumTools& tools) {
  MaterialDescription d;
  d.name = table.text("name").value_or("");
  const std::size_t type = table.choice("type", kTypes).value_or(0);
  d.translucent = type == 0;
  if (!d.translucent) {
    d.color = d.delivered = read_plain(table, type == 2);
    return d;
  }
  const MediumKeys keys = read_medium(table, tools);
  d.lambertian = keys.lambertian;
  d.preset = keys.preset;
  d.given = keys.given;
  d.color = d.delivered = keys.color;
  d.radius = keys.radius;
  d.radius_scale = keys.radius_scale;
  d.g = keys.coefficients.g;
  d.g_lock = keys.g_lock;
  d.inversion = keys.inversion;
  d.surface = keys.surface;
  d.roughness = keys.roughness;
  if (!keys.lambertian) describe_medium(keys, tools, d);
  return d;
}

}  // namespace meander
