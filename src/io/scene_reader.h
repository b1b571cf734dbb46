// From the parsed scene file to the scene.
#pragma once

#include <toml++/toml.h>
#include <string>

#include "io/scene_cache.h"
#include "io/scene_file.h"

namespace meander {

/// Reads and checks the whole scene; `path` is the scene file's, for messages and for the relative names of
/// files. Errors: Error with the place.
[[nodiscard]] SceneFile read_scene(const toml::table& document, const std::string& path, SceneCache& cache);

/// The path of a file that the scene file at `scene_path` names.
[[nodiscard]] std::string named_file(const std::string& scene_path, const std::string& name);

}  // namespace meander
