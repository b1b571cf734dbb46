// What a scene gives cause to warn of, whichever verb shows it.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace meander {

/// One line for each: what single precision cannot do (scene/precision.h), and lights that cannot be seen.
/// What was said in reading the file (SceneFile::warnings) and bodies that overlap (trace/overlaps.h) are
/// apart.
[[nodiscard]] std::vector<std::string> scene_warnings(const Scene& scene);

/// Says it on standard error.
void warn(const std::string& text);

}  // namespace meander
