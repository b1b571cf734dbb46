// What the child process does that reads a mesh file.
#pragma once

#include <cstdint>
#include <string>

#include "io/shut_in.h"

namespace meander {

enum class MeshFormat { ply, obj, glb, stl };

inline constexpr std::uint64_t kMaxMeshTriangles = 100'000'000;
inline constexpr std::uint64_t kMaxMeshPositions = 3 * kMaxMeshTriangles;

/// What the child sends first. Then follow, as they lie in memory: positions as DVec3, as many normals as
/// glm::vec3 or none (zero where the file has none), and triangles.
struct MeshImportHeader {
  std::uint64_t positions = 0;
  std::uint64_t normals = 0;
  std::uint64_t triangles = 0;
};

/// Reads the file with assimp; it is called `name`, and no other is there. Polygons are cut into triangles;
/// points and lines are left out; the transforms of nodes are applied. The normals of an STL file say nothing
/// that its triangles do not, and are left out. Throws std::exception.
void import_mesh(const FileBytes& content, MeshFormat format, const std::string& name, Answer& answer);

}  // namespace meander
