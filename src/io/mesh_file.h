// Mesh files, read in a child process because they are hostile input.
#pragma once

#include <string>

#include "scene/mesh.h"

namespace meander {

struct MeshFile {
  Mesh mesh;  // welded and turned outward where it is closed; see mend
  MeshReport report;
};

/// The triangles of a .ply, .obj, .glb or .stl file (in any case of letters), in the file's units, with the
/// transforms of its nodes applied. z_up turns (x, y, z) into (x, z, -y). Corners without a usable shading
/// normal get their triangle's own; a file without normals yields none. Files that it names (materials,
/// images, buffers) are not opened. At most 2 GiB, 100 million triangles, 60 s of processor time and two
/// minutes. Whatever the file holds, it yields a mesh of at least one triangle, finite positions and valid
/// indices, or throws Error with its path.
[[nodiscard]] MeshFile load_mesh(const std::string& path, bool z_up);

}  // namespace meander
