// The child process that reads a mesh file: it opens nothing but that file, has limits, and may die of what
// it reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace meander {

enum class MeshFormat { ply, obj, glb, stl };

inline constexpr std::uint64_t kMaxMeshTriangles = 100'000'000;
inline constexpr std::uint64_t kMaxMeshPositions = 3 * kMaxMeshTriangles;
inline constexpr std::uint64_t kMaxMeshErrorBytes = 4096;

/// What the child sends first. Then follow, as they lie in memory: error_bytes of text, or positions as
/// DVec3, as many normals as glm::vec3 or none (zero where the file has none), and triangles.
struct MeshImportHeader {
  std::uint64_t error_bytes = 0;
  std::uint64_t positions = 0;
  std::uint64_t normals = 0;
  std::uint64_t triangles = 0;
};

struct MeshImportJob {
  int file = -1;          // descriptor of the mesh file, at its beginning
  std::size_t bytes = 0;  // its size
  MeshFormat format = MeshFormat::ply;
  std::string name;  // what messages call the file
  int answer = -1;   // descriptor of the pipe to the parent
};

/// Processor time that the child may use: two seconds and one a MiB, at most 60. assimp reads some 40 MiB a
/// second; a damaged file can keep it busy forever.
[[nodiscard]] int mesh_import_cpu_seconds(std::size_t bytes) noexcept;

/// For a child just forked, before anything else: gives up signal handlers, every other descriptor and the
/// right to open more, limits processor time and memory, reads the file with assimp, sends the answer and
/// ends the process. Polygons are cut into triangles; points and lines are left out; the transforms of nodes
/// are applied. The normals of an STL file say nothing that its triangles do not, and are left out.
[[noreturn]] void run_mesh_import(const MeshImportJob& job);

}  // namespace meander
