#include "io/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>
#include <string_view>

#include "core/error.h"
#include "io/child_reader.h"
#include "io/mesh_import.h"

namespace meander {

namespace {

constexpr std::array<std::string_view, 4> kExtensions{".ply", ".obj", ".glb",
                                                      ".stl"};  // ordered as MeshFormat

Error bad_file(const std::string& path, const std::string& message) { return {Place{path, 0, 0}, message}; }

MeshFormat format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::find(kExtensions.begin(), kExtensions.end(), extension);
  if (found == kExtensions.end()) {
    throw bad_file(path, "unknown mesh format '" + extension + "'; known are " + list_names(kExtensions));
  }
  return static_cast<MeshFormat>(found - kExtensions.begin());
}

Mesh receive_mesh(ChildReader& importer) {
  const auto header = importer.receive<MeshImportHeader>();
  if (header.triangles > kMaxMeshTriangles || header.positions > kMaxMeshPositions ||
      (header.normals != 0 && header.normals != header.positions)) {
    importer.fail_of_nonsense();
  }
  Mesh mesh;
  importer.receive_many(mesh.positions, header.positions);
  importer.receive_many(mesh.normals, header.normals);
  importer.receive_many(mesh.triangles, header.triangles);
  if (!mesh.normals.empty()) mesh.normal_triangles = mesh.triangles;
  return mesh;
}

void check_mesh(const std::string& path, const Mesh& mesh) {
  if (mesh.triangles.empty()) throw bad_file(path, "holds no triangles");
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner < mesh.positions.size()) continue;
      throw bad_file(path, "a triangle names vertex " + std::to_string(corner) + " of " +
                               std::to_string(mesh.positions.size()));
    }
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const DVec3& p = mesh.positions[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw bad_file(path, "vertex " + std::to_string(i) + " has a coordinate that is not a finite number");
  }
}

// Gives corners whose normal is not a unit vector (or was missing) the normal of their triangle.
void replace_bad_normals(Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.normal_triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const DVec3& a = mesh.positions[triangle[0]];
    const DVec3 across = glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
    const double length = glm::length(across);
    const glm::vec3 own =
        length > 0 && std::isfinite(length) ? glm::vec3(across / length) : glm::vec3(0, 1, 0);
    for (std::uint32_t& corner : mesh.normal_triangles[t]) {
      const glm::vec3& normal = mesh.normals[corner];
      if (std::abs(glm::dot(normal, normal) - 1) < 1e-3f) continue;  // false for a NaN
      corner = static_cast<std::uint32_t>(mesh.normals.size());
      mesh.normals.push_back(own);
    }
  }
}

void turn_z_up(Mesh& mesh) {
  for (DVec3& p : mesh.positions) p = {p.x, p.z, -p.y};
  for (glm::vec3& n : mesh.normals) n = {n.x, n.z, -n.y};
}

}  // namespace

MeshFile load_mesh(const std::string& path, bool z_up) {
  const MeshFormat format = format_of(path);
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string prefix =
      "cannot be read as " + std::string(kExtensions[static_cast<std::size_t>(format)]) + ": ";
  const ReaderWords words{"the mesh importer",
                          [&](const std::string& reason) { return bad_file(path, reason); },
                          [&](const std::string& reason) { return bad_file(path, prefix + reason); }};
  try {
    ChildReader importer(path, words, [&](const FileBytes& content, Answer& answer) {
      import_mesh(content, format, name, answer);
    });
    MeshFile result{receive_mesh(importer), {}};
    check_mesh(path, result.mesh);
    replace_bad_normals(result.mesh);
    if (z_up) turn_z_up(result.mesh);
    const std::size_t count = result.mesh.triangles.size();
    result.report = mend(result.mesh);
    if (result.mesh.triangles.empty()) {
      throw bad_file(path, "all of its triangles (" + std::to_string(count) + ") are points or lines");
    }
    return result;
  } catch (const std::bad_alloc&) {
    throw Error(Fault::runtime, path + ": not enough memory for this mesh");
  }
}

}  // namespace meander
