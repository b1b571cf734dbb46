// Where the GLSL text comes from.
#pragma once

#include <string>
#include <vector>

#include "gl/program.h"

namespace meander {

/// The shader file `name` ("film.frag") from the first folder that has it: the environment variable
/// MEANDER_SHADERS, ../share/meander/shaders beside the executable's folder, the source tree it was built
/// from. Error (runtime) naming the folders when none has it.
[[nodiscard]] ShaderSource shader_source(const std::string& name);

/// The paths of all shader files in the folder that shader_source takes them from: what to watch for changes.
[[nodiscard]] std::vector<std::string> shader_files();

}  // namespace meander
