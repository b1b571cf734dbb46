// The built-in studio: a bare mesh, framed, on a ground, in wax, with a key and a back light.
#pragma once

#include <string>

#include "scene/mesh.h"

namespace meander {

/// The text of a scene file beside the mesh of `path` that shows it; everything is placed and scaled by its
/// bounds. Error (input): too large, too small or too far from the origin for that.
[[nodiscard]] std::string studio_text(const Mesh& mesh, const std::string& path);

}  // namespace meander
