#include <algorithm>
#include <filesystem>

#include "io/camera_file.h"
#include "io/document_state.h"
#include "io/light_file.h"
#include "io/scene_edit.h"
#include "io/scene_reader.h"
#include "scene/object_measures.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

// Calls `visit(table, key)` for every name of a file in a scene file.
template <class Visit>
void for_each_file(toml::table& document, const Visit& visit) {
  const auto look = [&](toml::node& node, const char* key) {
    toml::table* table = node.as_table();
    if (table && table->get(key) && table->get(key)->is_string()) visit(*table, key);
  };
  if (toml::node* environment = document.get("environment")) look(*environment, "image");
  if (toml::array* objects = document["object"].as_array())
    for (toml::node& object : *objects) look(object, "mesh");
}

// The folder of a file as the system finds it; as well as can be told where it does not exist.
fs::path folder_of(const fs::path& file) {
  std::error_code failed;
  const fs::path folder = fs::absolute(file, failed).parent_path();
  const fs::path canonical = fs::weakly_canonical(folder, failed);
  return failed || canonical.empty() ? folder.lexically_normal() : canonical;
}

// A colour or a length that was one number stays one where all three are equal.
void keep_form(const toml::table& before, toml::table& now) {
  for (auto&& [key, node] : now) {
    const toml::node* old = before.get(key);
    const toml::array* list = node.as_array();
    if (!old || !old->is_number() || !list || list->size() != 3) continue;
    const double first = number_of((*list)[0]);
    if (first == number_of((*list)[1]) && first == number_of((*list)[2])) now.insert_or_assign(key, first);
  }
}

toml::table transform_table(const Transform& transform) {
  toml::table table;
  set_triple(table, "translate", transform.translate);
  if (transform.rotate != DVec3(0)) set_triple(table, "rotate", transform.rotate);
  table.insert("scale", transform.scale.x);
  table.is_inline(true);
  return table;
}

}  // namespace

void write_lights(toml::table& document, const std::vector<Light>& lights) {
  document.erase("light");
  if (lights.empty()) return;
  toml::array list;
  for (const Light& light : lights) list.push_back(light_table(light));
  document.insert("light", std::move(list));
}

void write_light(toml::table& document, const std::string& name, const Light& light, const Place& place) {
  toml::table& old = find_named(document, "light", name, place);
  toml::table now = light_table(light);
  keep_form(old, now);
  old = std::move(now);
}

void write_environment(toml::table& document, std::string_view key, const toml::node& value) {
  if (!document.contains("environment")) document.insert("environment", toml::table{});
  toml::table& table = *document["environment"].as_table();
  const bool same_kind = table.contains(key);
  for (const std::string_view other : {"radiance", "image", "sky"}) table.erase(other);
  if (!same_kind) table.erase("rotation");
  if (!same_kind) table.erase("scale");
  value.visit([&](const auto& node) { table.insert_or_assign(key, node); });
}

bool is_z_up(const toml::table& object) {
  return object["mesh"].is_string() && object["up_axis"].value_or<std::string_view>("y") == "z";
}

void write_object_mesh(toml::table& object, const std::string& path, const Object& old_object,
                       const std::shared_ptr<const Mesh>& mesh) {
  Object fresh{old_object.name, mesh, old_object.material, {}};
  if (object.contains("mesh")) fresh.transform.rotate = old_object.transform.rotate;
  fresh.transform.scale = DVec3(bounding_radius(old_object) / bounding_radius(fresh));
  const Bounds before = world_bounds(old_object);
  const Bounds now = world_bounds(fresh);
  fresh.transform.translate = 0.5 * (before.low + before.high) - 0.5 * (now.low + now.high);
  fresh.transform.translate.y = before.low.y - now.low.y;
  object.erase("shape");
  object.insert_or_assign("mesh", path);
  object.insert_or_assign("transform", transform_table(fresh.transform));
}

void rebase_files(toml::table& document, const std::string& from_path, const std::string& to_path) {
  const fs::path to = folder_of(to_path);
  for_each_file(document, [&](toml::table& table, const char* key) {
    const fs::path name = *table[key].value<std::string>();
    if (name.is_absolute()) return;
    const fs::path file = fs::path(from_path).parent_path() / name;
    const fs::path relative = (folder_of(file) / file.filename()).lexically_relative(to);
    table.insert_or_assign(key, relative.generic_string());
  });
}

std::vector<std::string> files_of(const toml::table& document, const std::string& path) {
  std::vector<std::string> files;
  toml::table copy = document;
  for_each_file(copy, [&](toml::table& table, const char* key) {
    const std::string file = named_file(path, *table[key].value<std::string>());
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  });
  return files;
}

}  // namespace meander
