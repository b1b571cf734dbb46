#include "io/camera_file.h"

namespace meander {
namespace {

constexpr Range kFieldOfView{0, 180, true, true, "greater than 0 and less than 180 degrees"};

}  // namespace

Camera read_camera(TomlTable table) {
  Camera camera;
  camera.look_from = table.triple("look_from", kAnyNumber, false).value_or(camera.look_from);
  camera.look_at = table.triple("look_at", kAnyNumber, false).value_or(camera.look_at);
  camera.up = table.triple("up", kAnyNumber, false).value_or(camera.up);
  if (table.has("vertical_fov") && table.has("orthographic_height"))
    throw Error(table.place("orthographic_height"),
                "a camera has vertical_fov or orthographic_height, not both");
  camera.vertical_fov = table.number("vertical_fov", kFieldOfView).value_or(camera.vertical_fov);
  camera.orthographic_height = table.number("orthographic_height", kPositive);
  table.finish();
  const DVec3 view = camera.look_at - camera.look_from;
  if (!(glm::length(view) > 0)) throw Error(table.place("look_at"), "'look_at' must differ from 'look_from'");
  if (!(glm::length(glm::cross(glm::normalize(view), camera.up)) > 1e-9 * glm::length(camera.up)))
    throw Error(table.place("up"), "'up' must not be zero or parallel to the view");
  return camera;
}

toml::table camera_table(const Camera& camera) {
  toml::table table;
  set_triple(table, "look_from", camera.look_from);
  set_triple(table, "look_at", camera.look_at);
  if (camera.up != Camera{}.up) set_triple(table, "up", camera.up);
  if (camera.orthographic_height)
    table.insert("orthographic_height", *camera.orthographic_height);
  else
    table.insert("vertical_fov", camera.vertical_fov);
  return table;
}

}  // namespace meander
