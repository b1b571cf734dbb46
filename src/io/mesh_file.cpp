#include "io/mesh_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>

#include "core/error.h"
#include "core/timer.h"
#include "io/mesh_import.h"

namespace meander {

namespace {

constexpr double kDeadlineSeconds = 120;
constexpr std::array<std::string_view, 4> kExtensions{".ply", ".obj", ".glb",
                                                      ".stl"};  // ordered as MeshFormat

class Descriptor {
 public:
  explicit Descriptor(int value) noexcept : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { reset(); }

  [[nodiscard]] int get() const noexcept { return value_; }
  void reset() noexcept {
    if (value_ >= 0) close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

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

// Returns the size in bytes of the regular file behind the descriptor.
std::size_t check_file(const std::string& path, const Descriptor& file) {
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) {
    throw bad_file(path, std::string("cannot open: ") + std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) throw bad_file(path, "is a directory, not a mesh file");
  if (!S_ISREG(status.st_mode)) throw bad_file(path, "is not a regular file");
  if (status.st_size == 0) throw bad_file(path, "is empty");
  if (status.st_size > off_t{1} << 31) throw bad_file(path, "is larger than 2 GiB");
  return static_cast<std::size_t>(status.st_size);
}

// The importing process seen from outside. It is dead and buried when this is gone.
class Importer {
 public:
  Importer(const std::string& path, int file, std::size_t bytes, MeshFormat format)
      : path_(path), bytes_(bytes) {
    MeshImportJob job{file, bytes, format, std::filesystem::path(path).filename().string(), -1};
    std::array<int, 2> ends{-1, -1};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start();
    answer_ = ends[0];
    Descriptor far_end(ends[1]);
    job.answer = far_end.get();
    child_ = fork();
    if (child_ < 0) {
      close(answer_);
      fail_to_start();
    }
    if (child_ == 0) run_mesh_import(job);
  }
  Importer(const Importer&) = delete;
  Importer& operator=(const Importer&) = delete;
  ~Importer() {
    close(answer_);
    if (child_ > 0) {
      kill(child_, SIGKILL);
      while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
  }

  // Fills `bytes` of memory from the answer. Throws when the answer ends before, or the deadline comes.
  void receive(void* memory, std::size_t bytes) {
    for (std::size_t have = 0; have < bytes;) {
      pollfd readable{answer_, POLLIN, 0};
      const int ready = poll(&readable, 1, milliseconds_left());
      if (ready < 0 && errno == EINTR) continue;
      if (ready < 0) throw Error(Fault::runtime, path_ + ": poll: " + std::strerror(errno));
      if (ready == 0) fail_late();
      const ssize_t got = read(answer_, static_cast<char*>(memory) + have, bytes - have);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) fail_of_death();
      have += static_cast<std::size_t>(got);
    }
  }

  // Memory grows with what has really come, not with what was announced.
  template <typename Container>
  void receive_many(Container& values, std::uint64_t count) {
    constexpr std::uint64_t kAtOnce = 1 << 16;
    while (values.size() < count) {
      const std::size_t have = values.size();
      values.resize(std::min<std::uint64_t>(count, have + kAtOnce));
      receive(values.data() + have, (values.size() - have) * sizeof values[0]);
    }
  }

 private:
  [[nodiscard]] int milliseconds_left() const {
    return static_cast<int>(std::max(0.0, std::ceil((kDeadlineSeconds - since_start_.seconds()) * 1000)));
  }

  [[noreturn]] void fail_to_start() const {
    throw Error(Fault::runtime, path_ + ": cannot start the mesh importer: " + std::strerror(errno));
  }
  [[noreturn]] void fail_late() const {
    throw bad_file(path_, "the mesh importer took longer than " + std::to_string(int(kDeadlineSeconds)) +
                              " s and was stopped; the file is damaged or hostile");
  }

  // The answer broke off: says how the child ended, which may take it a moment.
  [[noreturn]] void fail_of_death() {
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(child_, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
      if (milliseconds_left() == 0) fail_late();
      poll(nullptr, 0, 1);
    }
    child_ = -1;
    std::string how = "broke off";
    if (ended > 0 && WIFSIGNALED(status)) {
      const int signal = WTERMSIG(status);
      how = signal == SIGXCPU
                ? "used more than " + std::to_string(mesh_import_cpu_seconds(bytes_)) + " s of processor time"
                : "crashed (signal " + std::to_string(signal) + ")";
    } else if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) != 0) {
      how = "failed (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
    }
    throw bad_file(path_, "the mesh importer " + how + "; the file is damaged or hostile");
  }

  const std::string& path_;
  std::size_t bytes_;
  Timer since_start_;
  int answer_ = -1;
  pid_t child_ = -1;
};

// The importer's words in one printable line: they may quote the file.
std::string one_line(std::string text) {
  constexpr std::size_t kLongest = 300;
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

Mesh receive_mesh(const std::string& path, Importer& importer, std::string_view extension) {
  MeshImportHeader header;
  importer.receive(&header, sizeof header);
  if (header.error_bytes > kMaxMeshErrorBytes || header.triangles > kMaxMeshTriangles ||
      header.positions > kMaxMeshPositions || (header.normals != 0 && header.normals != header.positions)) {
    throw bad_file(path, "the mesh importer sent nonsense; the file is damaged or hostile");
  }
  if (header.error_bytes > 0) {
    std::string text;
    importer.receive_many(text, header.error_bytes);
    throw bad_file(path, "cannot be read as " + std::string(extension) + ": " + one_line(text));
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
  // Without O_NONBLOCK a named pipe would keep us here.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const std::size_t bytes = check_file(path, file);
  try {
    Importer importer(path, file.get(), bytes, format);
    MeshFile result{receive_mesh(path, importer, kExtensions[static_cast<std::size_t>(format)]), {}};
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
