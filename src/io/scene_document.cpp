#include "io/scene_document.h"

#include <filesystem>

#include "io/camera_file.h"
#include "io/document_state.h"
#include "io/material_file.h"
#include "io/scene_edit.h"
#include "io/scene_reader.h"
#include "io/scene_writer.h"

namespace meander {
namespace {

// A file that the user names from where the program runs, for a scene file that may go anywhere.
std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

std::string text_of(const DocumentState& state) {
  const std::string text = scene_text(state.table);
  return state.comment.empty() || text.empty() ? state.comment + text : state.comment + '\n' + text;
}

// Of a value of a parsed scene file with its key, as toml++ and the allocator lay them out.
std::size_t bytes_of(const toml::node& node) {
  constexpr std::size_t kNode = 150;
  std::size_t bytes = kNode;
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) bytes += bytes_of(value);
  if (const toml::array* array = node.as_array())
    for (const toml::node& value : *array) bytes += bytes_of(value);
  if (const auto* text = node.as_string()) bytes += text->get().size();
  return bytes;
}

double millimetres_of(const toml::table& document) {
  return document["scene"]["millimetres_per_unit"].value_or(1.0);
}

}  // namespace

SceneDocument::SceneDocument(std::shared_ptr<const DocumentState> state, std::shared_ptr<SceneCache> cache)
    : state_(std::move(state)), cache_(std::move(cache)) {}

SceneDocument SceneDocument::open(const std::string& path, std::span<const std::string> edits) {
  auto cache = std::make_shared<SceneCache>();
  auto state = std::make_shared<DocumentState>(open_document(path, *cache));
  for (const std::string& edit : edits) apply_edit(state->table, edit, path, cache->color_maps());
  (void)read_scene(state->table, path, *cache);
  return {std::move(state), std::move(cache)};
}

SceneDocument SceneDocument::from_text(const std::string& text, const std::string& path) {
  auto cache = std::make_shared<SceneCache>();
  auto state = std::make_shared<DocumentState>(parse_document(text, path));
  (void)read_scene(state->table, path, *cache);
  return {std::move(state), std::move(cache)};
}

SceneDocument SceneDocument::open_another(const std::string& path) const {
  auto state = std::make_shared<DocumentState>(open_document(path, *cache_));
  (void)read_scene(state->table, path, *cache_);
  return {std::move(state), cache_};
}

SceneDocument SceneDocument::reopened() const { return open_another(path()); }

void SceneDocument::adopt(DocumentState&& state) {
  (void)read_scene(state.table, state.path, *cache_);
  state_ = std::make_shared<const DocumentState>(std::move(state));
}

void SceneDocument::apply(const std::string& edit) {
  DocumentState next = *state_;
  apply_edit(next.table, edit, next.path, cache_->color_maps());
  adopt(std::move(next));
}

SceneFile SceneDocument::scene() const { return read_scene(state_->table, state_->path, *cache_); }

std::string SceneDocument::text() const { return text_of(*state_); }

std::string SceneDocument::text_for(const std::string& target_path) const {
  DocumentState moved = *state_;
  rebase_files(moved.table, moved.path, target_path);
  return text_of(moved);
}

void SceneDocument::move_to(const std::string& target_path) {
  DocumentState next = *state_;
  rebase_files(next.table, next.path, target_path);
  next.path = target_path;
  next.stamp = {target_path};
  adopt(std::move(next));
}

const std::string& SceneDocument::path() const { return state_->path; }

std::vector<FileStamp> SceneDocument::watched_files() const { return files_of_state(*state_); }

std::vector<FileStamp> SceneDocument::reopened_files() const {
  try {
    return files_of_state(open_document(path(), *cache_));
  } catch (const Error&) {
    return {};
  }
}

std::vector<FileStamp> SceneDocument::files_of_state(const DocumentState& state) const {
  std::vector<FileStamp> files{state.stamp};
  for (const std::string& file : files_of(state.table, state.path)) {
    if (file == state.path)
      files.front() = cache_->stamp(file);  // a bare mesh
    else
      files.push_back(cache_->stamp(file));
  }
  return files;
}

void SceneDocument::set_camera(const Camera& camera) {
  DocumentState next = *state_;
  next.table.insert_or_assign("camera", camera_table(camera));
  adopt(std::move(next));
}

void SceneDocument::set_lights(const std::vector<Light>& lights) {
  DocumentState next = *state_;
  write_lights(next.table, lights);
  adopt(std::move(next));
}

void SceneDocument::set_light(const std::string& name, const Light& light) {
  DocumentState next = *state_;
  write_light(next.table, name, light, Place{next.path, 0, 0});
  adopt(std::move(next));
}

void SceneDocument::set_environment_image(const std::string& path) {
  DocumentState next = *state_;
  write_environment(next.table, "image", toml::value<std::string>(absolute_path(path)));
  adopt(std::move(next));
}

void SceneDocument::set_environment_sky(const std::string& name) {
  DocumentState next = *state_;
  write_environment(next.table, "sky", toml::value<std::string>(name));
  adopt(std::move(next));
}

void SceneDocument::set_environment_radiance(const DVec3& radiance) {
  DocumentState next = *state_;
  write_environment(next.table, "radiance", toml::array{radiance.x, radiance.y, radiance.z});
  adopt(std::move(next));
}

void SceneDocument::set_object_mesh(const std::string& object, const std::string& path) {
  DocumentState next = *state_;
  const Place place{next.path, 0, 0};
  toml::table& table = find_named(next.table, "object", object, place);
  const toml::array& tables = *next.table["object"].as_array();
  std::size_t index = 0;
  while (tables[index].as_table() != &table) ++index;
  const Object before = scene().scene.objects[index];
  if (std::holds_alternative<SlabShape>(before.shape))
    throw Error(place, "'" + object + "' is an unbounded slab, which no mesh can take the place of");
  const std::string mesh_path = absolute_path(path);
  const auto mesh = cache_->mesh(mesh_path, is_z_up(table));
  if (!(mesh->size > 0)) throw Error(Place{mesh_path, 0, 0}, "is a single point");
  write_object_mesh(table, mesh_path, before, mesh->mesh);
  adopt(std::move(next));
}

std::size_t SceneDocument::bytes() const { return bytes_of(state_->table) + state_->comment.size(); }

MaterialDescription SceneDocument::material(const std::string& name) const {
  DocumentState copy = *state_;
  const toml::table& raw = find_named(copy.table, "material", name, Place{copy.path, 0, 0});
  TomlTable table(raw, copy.path, "[[material]]");
  return describe_material(table, {millimetres_of(copy.table), cache_->color_maps()});
}

EnvironmentDescription SceneDocument::environment() const {
  EnvironmentDescription description;
  const toml::table* raw = state_->table["environment"].as_table();
  if (!raw) return description;
  TomlTable table(*raw, state_->path, "[environment]");
  description.radiance = table.triple("radiance", kNotNegative, true).value_or(DVec3(0));
  if (const auto sky = table.choice("sky", kSkyNames)) description.sky = static_cast<Sky>(*sky);
  description.image = table.text("image").value_or("");
  description.rotation = table.number("rotation", kAnyNumber).value_or(0);
  description.scale = table.number("scale", kNotNegative).value_or(1);
  description.visible = table.boolean("visible").value_or(true);
  return description;
}

bool SceneDocument::operator==(const SceneDocument& other) const {
  return state_ == other.state_ || (path() == other.path() && text() == other.text());
}

std::string camera_text(const Camera& camera) {
  toml::table document;
  document.insert("camera", camera_table(camera));
  return scene_text(document);
}

}  // namespace meander
