#include "io/mesh_import.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "math/types.h"
#include "scene/mesh.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MEANDER_SHADOW_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MEANDER_SHADOW_MEMORY
#endif
#endif

namespace meander {

namespace {

constexpr int kFile = 0;
constexpr int kAnswer = 3;

void limit(int resource, rlim_t value) {
  rlimit limits{};
  if (getrlimit(resource, &limits) != 0) return;
  limits.rlim_max = std::min(limits.rlim_max, value);
  limits.rlim_cur = limits.rlim_max;
  setrlimit(resource, &limits);
}

// The parent's address space was inherited and counts too. A sanitizer's shadow is too large for any limit.
void limit_memory() {
#ifndef MEANDER_SHADOW_MEMORY
  constexpr rlim_t kAllowance = rlim_t{8} << 30;
  std::array<char, 64> text{};
  const int statm = open("/proc/self/statm", O_RDONLY);
  if (statm < 0) return;
  unsigned long pages = 0;
  if (read(statm, text.data(), text.size() - 1) > 0 && std::sscanf(text.data(), "%lu", &pages) == 1) {
    limit(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kAllowance);
  }
  close(statm);
#endif
}

// Leaves the file as descriptor 0, the answer as 3, silence as 1 and 2; the kernel refuses any other.
void shut_in(const MeshImportJob& job, int cpu_seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the parent's death is the child's
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  limit_memory();
  const int file = fcntl(job.file, F_DUPFD, kAnswer + 1);
  const int answer = fcntl(job.answer, F_DUPFD, kAnswer + 1);
  const int silence = open("/dev/null", O_RDWR);
  if (file < 0 || answer < 0 || silence < 0) _exit(1);
  if (dup2(silence, 1) < 0 || dup2(silence, 2) < 0) _exit(1);
  if (dup2(file, kFile) < 0 || dup2(answer, kAnswer) < 0) _exit(1);
  closefrom(kAnswer + 1);
  limit(RLIMIT_NOFILE, 0);
  limit(RLIMIT_CORE, 0);
  // One second between the signal that has a name in the error line and the one that cannot be held off.
  const rlimit cpu{static_cast<rlim_t>(cpu_seconds), static_cast<rlim_t>(cpu_seconds) + 1};
  setrlimit(RLIMIT_CPU, &cpu);
}

// Buffered bytes to the parent; a parent that is gone ends the process.
class Answer {
 public:
  Answer() { buffer_.reserve(kBytes); }

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put_bytes(const char* bytes, std::size_t count) {
    if (buffer_.size() + count > kBytes) flush();
    buffer_.insert(buffer_.end(), bytes, bytes + count);
  }
  void flush() {
    for (std::size_t sent = 0; sent < buffer_.size();) {
      const ssize_t written = write(kAnswer, buffer_.data() + sent, buffer_.size() - sent);
      if (written < 0 && errno != EINTR) _exit(1);
      if (written > 0) sent += static_cast<std::size_t>(written);
    }
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBytes = 1 << 16;
  std::vector<char> buffer_;
};

[[noreturn]] void answer_error(std::string_view message) {
  const std::size_t size = std::min<std::size_t>(message.size(), kMaxMeshErrorBytes);
  Answer answer;
  answer.put(MeshImportHeader{.error_bytes = size});
  answer.put_bytes(message.data(), size);
  answer.flush();
  _exit(0);
}

std::vector<std::uint8_t> read_file(std::size_t bytes) {
  std::vector<std::uint8_t> content(bytes);
  std::size_t have = 0;
  while (have < bytes) {
    const ssize_t got = read(kFile, content.data() + have, bytes - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::runtime_error(std::strerror(errno));
    if (got == 0) break;
    have += static_cast<std::size_t>(got);
  }
  content.resize(have);
  return content;
}

// In a header that does not end, assimp 5.2 looks for the end forever.
void check_ply_header(const std::vector<std::uint8_t>& content) {
  constexpr std::string_view kEnd = "end_header";
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  for (std::size_t at = text.find(kEnd, 1); at != text.npos; at = text.find(kEnd, at + 1)) {
    const std::size_t after = at + kEnd.size();
    const bool starts_line = text[at - 1] == '\n' || text[at - 1] == '\r';
    if (starts_line && after < text.size() && (text[after] == '\n' || text[after] == '\r')) return;
  }
  throw std::runtime_error("its header has no end_header line");
}

// All the files there are, as far as assimp can tell: the one that was read. No materials, images or buffers.
class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(const std::string& name, const std::vector<std::uint8_t>& content)
      : name_(name), content_(content) {}

  bool Exists(const char* name) const override { return name_ == name; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (name_ != name || mode[0] != 'r') return nullptr;
    return new Assimp::MemoryIOStream(content_.data(), content_.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  const std::string& name_;
  const std::vector<std::uint8_t>& content_;
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
      if (face.mIndices[k] >= instance.mesh->mNumVertices) _exit(1);  // assimp promised otherwise
      triangle[k] = first_position + face.mIndices[k];
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
    answer.put(triangle);
  }
}

void answer_scene(const aiScene& scene, MeshFormat format) {
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
  Answer answer;
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
  answer.flush();
}

}  // namespace

int mesh_import_cpu_seconds(std::size_t bytes) noexcept {
  constexpr std::size_t kLongest = 60;
  return static_cast<int>(std::min(kLongest, 2 + (bytes >> 20)));
}

void run_mesh_import(const MeshImportJob& job) {
  try {
    shut_in(job, mesh_import_cpu_seconds(job.bytes));
    const std::vector<std::uint8_t> content = read_file(job.bytes);
    if (job.format == MeshFormat::ply) check_ply_header(content);
    Assimp::Importer importer;
    keep_one_importer(importer, job.format);
    importer.SetIOHandler(new OneFile(job.name, content));
    const aiScene* scene = importer.ReadFile(job.name, aiProcess_Triangulate);
    if (scene == nullptr) answer_error(importer.GetErrorString());
    answer_scene(*scene, job.format);
    _exit(0);
  } catch (const std::bad_alloc&) {
    answer_error("it needs more memory than the importer may have");
  } catch (const std::exception& error) {
    answer_error(error.what());
  } catch (...) {
    answer_error("unknown error");
  }
}

}  // namespace meander
