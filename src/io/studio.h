// The built-in studio: a bare mesh, framed, on a ground, in wax, with a key and a back light.
#pragma once

#include <string>

#include "scene/mesh.h"

namespace meander {

/// The text of the scene file that shows a mesh; everything is placed and scaled by its bounds. `mesh_name`
/// is what the object's `mesh` key says.
[[nodiscard]] std::string studio_text(const Mesh& mesh, const std::string& mesh_name);

}  // namespace meander
