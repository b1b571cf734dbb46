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
  std::vector<std::string> files;     // that were read: the scene's own, and those that it names
};

/// Reads a scene, applying the edits (`PATH=VALUE`, see scene_edit.h) first. `path` ends in .toml, or in the
/// name of a mesh format. A name of a file in it is relative to the folder of `path`, not to the working
/// directory; an absolute one, `..` and links are followed. No other file is opened: not what a mesh names.
/// Errors: Error with file, line and column; a scene file of more than 16 MiB is one.
[[nodiscard]] SceneFile load_scene(const std::string& path, std::span<const std::string> edits);

}  // namespace meander
