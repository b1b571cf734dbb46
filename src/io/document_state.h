// What a scene document is made of, for the files that edit it.
#pragma once

#include <toml++/toml.h>
#include <string>

#include "core/error.h"
#include "io/scene_cache.h"
#include "scene/scene.h"

namespace meander {

/// A parsed scene file.
struct DocumentState {
  toml::table table;
  std::string path;
  std::string comment;  // the leading lines of the file that begin with #, each with its end of line
  FileStamp stamp{};    // of the file before it was read
};

/// The parsed scene file at `path`, or the built-in studio about a bare mesh file. Errors: Error with the
/// place.
[[nodiscard]] DocumentState open_document(const std::string& path, SceneCache& cache);
/// Errors: Error with the place.
[[nodiscard]] DocumentState parse_document(const std::string& text, const std::string& path);

/// Structural edits of a parsed scene file; whether the result reads is left to the caller. A grey colour of
/// a light stays one number where it was one. Error at the place when there is no light of this name.
void write_lights(toml::table& document, const std::vector<Light>& lights);
void write_light(toml::table& document, const std::string& name, const Light& light, const Place& place);

/// One of radiance, image and sky in the place of the others; rotation and scale stay where it replaces its
/// like.
void write_environment(toml::table& document, std::string_view key, const toml::node& value);

/// A mesh in the place of an object's shape, fitted to `old_object`, which is the object as the scene has it.
/// `mesh` is the file at `path`, read with the up_axis that is_z_up says.
void write_object_mesh(toml::table& object, const std::string& path, const Object& old_object,
                       const std::shared_ptr<const Mesh>& mesh);

/// Whether a mesh in the place of the object's shape is read with z up: when the old one is a mesh that was.
[[nodiscard]] bool is_z_up(const toml::table& object);

/// The names of files in the table that are relative, as seen from another scene file's folder.
void rebase_files(toml::table& document, const std::string& from_path, const std::string& to_path);

/// The meshes and pictures that the scene file names, by path.
[[nodiscard]] std::vector<std::string> files_of(const toml::table& document, const std::string& path);

}  // namespace meander
