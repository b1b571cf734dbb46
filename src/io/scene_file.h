// Scene files: TOML in, a checked Scene out. A bare mesh file is wrapped in the built-in studio.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace meander {

struct SceneFile {
  Scene scene;
  std::vector<std::string> warnings;  // one line each
};

/// Reads a scene, applying the edits (`PATH=VALUE`, see scene_edit.h) first. `path` ends in .toml, or in the
/// name of a mesh format. Errors: Error with file, line and column.
[[nodiscard]] SceneFile load_scene(const std::string& path, std::span<const std::string> edits);

}  // namespace meander
