#include "io/light_file.h"

#include <array>

namespace meander {
namespace {

constexpr std::array<std::string_view, 4> kLightTypes{"rectangle", "sphere", "point", "directional"};

RectangleLight read_rectangle(TomlTable& table) {
  RectangleLight light;
  light.center = table.required(table.triple("center", kAnyNumber, false), "center");
  light.look_at = table.required(table.triple("look_at", kAnyNumber, false), "look_at");
  light.up = table.triple("up", kAnyNumber, false).value_or(light.up);
  light.width = table.number("width", kPositive).value_or(1);
  light.height = table.number("height", kPositive).value_or(1);
  light.radiance = Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(1)));
  const DVec3 view = light.look_at - light.center;
  if (!(glm::length(view) > 0)) throw Error(table.place("look_at"), "'look_at' must differ from 'center'");
  if (glm::length(glm::cross(glm::normalize(view), light.up)) > 1e-9 * glm::length(light.up)) return light;
  // A light that looks straight up or down is common; any horizontal then serves as its up.
  if (table.has("up"))
    throw Error(table.place("up"), "'up' must not be zero or parallel to the light's view");
  light.up = {0, 0, -1};
  return light;
}

void write_shape(toml::table& table, const RectangleLight& light) {
  set_triple(table, "center", light.center);
  set_triple(table, "look_at", light.look_at);
  if (light.up != RectangleLight{}.up) set_triple(table, "up", light.up);
  table.insert("width", light.width);
  table.insert("height", light.height);
  set_color(table, "radiance", light.radiance);
}

void write_shape(toml::table& table, const SphereLight& light) {
  set_triple(table, "center", light.center);
  table.insert("radius", light.radius);
  set_color(table, "radiance", light.radiance);
}

void write_shape(toml::table& table, const PointLight& light) {
  set_triple(table, "position", light.position);
  set_color(table, "intensity", light.intensity);
}

void write_shape(toml::table& table, const DirectionalLight& light) {
  set_triple(table, "direction", light.direction);
  set_color(table, "irradiance", light.irradiance);
}

}  // namespace

Light read_light(TomlTable table, std::size_t index) {
  Light light;
  light.name = table.text("name").value_or("light" + std::to_string(index + 1));
  const std::size_t type = table.required(table.choice("type", kLightTypes), "type");
  light.visible = table.boolean("visible").value_or(false);
  if (type == 0) {
    light.shape = read_rectangle(table);
  } else if (type == 1) {
    SphereLight sphere;
    sphere.center = table.required(table.triple("center", kAnyNumber, false), "center");
    sphere.radius = table.number("radius", kPositive).value_or(1);
    sphere.radiance = Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(1)));
    light.shape = sphere;
  } else if (type == 2) {
    PointLight point;
    point.position = table.required(table.triple("position", kAnyNumber, false), "position");
    point.intensity = Rgb(table.triple("intensity", kNotNegative, true).value_or(DVec3(1)));
    light.shape = point;
  } else {
    DirectionalLight sun;
    sun.direction = table.required(table.triple("direction", kAnyNumber, false), "direction");
    sun.irradiance = Rgb(table.triple("irradiance", kNotNegative, true).value_or(DVec3(1)));
    if (!(glm::length(sun.direction) > 0))
      throw Error(table.place("direction"), "'direction' must not be zero");
    light.shape = sun;
  }
  table.finish();
  return light;
}

toml::table light_table(const Light& light) {
  toml::table table;
  table.insert("name", light.name);
  table.insert("type", kLightTypes[light.shape.index()]);
  std::visit([&](const auto& shape) { write_shape(table, shape); }, light.shape);
  if (light.visible) table.insert("visible", true);
  return table;
}

}  // namespace meander
