#include "io/mesh_import.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "io/ply_check.h"
#include "math/types.h"
#include "scene/mesh.h"

namespace meander {

namespace {

// All the files there are, as far as assimp can tell: the one that was read. No materials, images or buffers.
class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(const std::string& name, const FileBytes& content) : name_(name), content_(content) {}

  bool Exists(const char* name) const override { return name_ == name; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (name_ != name || mode[0] != 'r') return nullptr;
    return new Assimp::MemoryIOStream(content_.data(), content_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  const std::string& name_;
  const FileBytes& content_;
};

std::string_view importer_name(MeshFormat format) {
  switch (format) {
    case MeshFormat::ply:
      return "Stanford Polygon Library (PLY) Importer";
    case MeshFormat::obj:
      return "Wavefront Object Importer";
    case MeshFormat::glb:
      return "glTF2 Importer";
    case MeshFormat::stl:
      return "Stereolithography (STL) Importer";
  }
  return {};
}

// Unregistered importers are not freed: the process is about to end anyhow.
void keep_one_importer(Assimp::Importer& importer, MeshFormat format) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (importer.GetImporterInfo(i)->mName == importer_name(format)) continue;
    importer.UnregisterLoader(importer.GetImporter(i));
  }
  if (importer.GetImporterCount() != 1)
    throw std::runtime_error("this build of assimp has no importer for it");
}

struct Instance {
  const aiMesh* mesh = nullptr;
  glm::dmat4 to_world{1.0};
};

std::uint64_t count_triangles(const aiMesh& mesh) {
  std::uint64_t count = 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) count += mesh.mFaces[f].mNumIndices == 3;
  return count;
}

// Walks with a list of its own, not the stack: a file may nest its nodes as deep as it likes.
std::vector<Instance> collect_instances(const aiScene& scene) {
  std::vector<std::uint64_t> triangles(scene.mNumMeshes);
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) triangles[m] = count_triangles(*scene.mMeshes[m]);
  struct Visit {
    const aiNode* node;
    glm::dmat4 parent;
  };
  std::vector<Visit> visits{{scene.mRootNode, glm::dmat4(1.0)}};
  std::vector<Instance> instances;
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    if (visit.node == nullptr) continue;
    glm::dmat4 local;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column)
        local[column][row] = visit.node->mTransformation[row][column];
    }
    const glm::dmat4 to_world = visit.parent * local;
    for (unsigned m = 0; m < visit.node->mNumMeshes; ++m) {
      const unsigned index = visit.node->mMeshes[m];
      if (index >= scene.mNumMeshes || triangles[index] == 0) continue;
      instances.push_back({scene.mMeshes[index], to_world});
    }
    for (unsigned c = visit.node->mNumChildren; c-- > 0;)
      visits.push_back({visit.node->mChildren[c], to_world});
  }
  return instances;
}

// Transposed inverse of the linear part times |determinant|: the sign keeps normals outward through a mirror.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
  const glm::dmat3 cofactors{glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
  return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

void put_positions(Answer& answer, const Instance& instance) {
  for (unsigned v = 0; v < instance.mesh->mNumVertices; ++v) {
    const aiVector3D& p = instance.mesh->mVertices[v];
    answer.put(DVec3(instance.to_world * glm::dvec4(p.x, p.y, p.z, 1.0)));
  }
}

void put_normals(Answer& answer, const Instance& instance) {
  const glm::dmat3 matrix = normal_matrix(glm::dmat3(instance.to_world));
  for (unsigned v = 0; v < instance.mesh->mNumVertices; ++v) {
    DVec3 normal{0.0};
    if (instance.mesh->HasNormals()) {
      const aiVector3D& n = instance.mesh->mNormals[v];
      normal = matrix * DVec3(n.x, n.y, n.z);
    }
    const double length = glm::length(normal);
    answer.put(glm::vec3(length > 0 ? normal / length : DVec3(0.0)));
  }
}

void put_triangles(Answer& answer, const Instance& instance, std::uint32_t first_position) {
  const bool mirrored = glm::determinant(glm::dmat3(instance.to_world)) < 0;
  for (unsigned f = 0; f < instance.mesh->mNumFaces; ++f) {
    const aiFace& face = instance.mesh->mFaces[f];
    if (face.mNumIndices != 3) continue;
    Triangle triangle{};
    for (int k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= instance.mesh->mNumVertices) std::_Exit(1);  // assimp promised otherwise
      triangle[k] = first_position + face.mIndices[k];
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
    answer.put(triangle);
  }
}

void put_scene(Answer& answer, const aiScene& scene, MeshFormat format) {
  const std::vector<Instance> instances = collect_instances(scene);
  MeshImportHeader header;
  bool normals = false;
  for (const Instance& instance : instances) {
    header.positions += instance.mesh->mNumVertices;
    header.triangles += count_triangles(*instance.mesh);
    normals = normals || instance.mesh->HasNormals();
    if (header.triangles > kMaxMeshTriangles || header.positions > kMaxMeshPositions) {
      throw std::runtime_error("more than 100 million triangles");
    }
  }
  if (normals && format != MeshFormat::stl) header.normals = header.positions;
  answer.put(header);
  for (const Instance& instance : instances) put_positions(answer, instance);
  if (header.normals != 0) {
    for (const Instance& instance : instances) put_normals(answer, instance);
  }
  std::uint32_t first_position = 0;
  for (const Instance& instance : instances) {
    put_triangles(answer, instance, first_position);
    first_position += instance.mesh->mNumVertices;
  }
}

}  // namespace

void import_mesh(const FileBytes& content, MeshFormat format, const std::string& name, Answer& answer) {
  if (format == MeshFormat::ply)
    check_ply(content);  // in a header that does not end, assimp 5.2 looks on forever
  Assimp::Importer importer;
  keep_one_importer(importer, format);
  importer.SetIOHandler(new OneFile(name, content));
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate);
  if (scene == nullptr) {
    const std::string why = importer.GetErrorString();
    if (why == "std::bad_alloc") throw std::bad_alloc();  // the library catches it
    throw std::runtime_error(why);
  }
  put_scene(answer, *scene, format);
}

}  // namespace meander
