#include "io/mesh_file.h"

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/timer.h"
#include "io/mesh_samples.h"
#include "support/temporary_folder.h"

using namespace meander;
namespace fs = std::filesystem;

namespace {

std::string error_of(const std::string& path) {
  try {
    static_cast<void>(load_mesh(path, false));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// True when it loads; whatever else happens must be an Error of one line that begins with the path.
bool loads_or_throws(const std::string& path) {
  try {
    const MeshFile file = load_mesh(path, false);
    bool sound = !file.mesh.triangles.empty();
    for (const DVec3& p : file.mesh.positions) sound = sound && std::isfinite(p.x + p.y + p.z);
    for (const Triangle& t : file.mesh.triangles)
      sound = sound && std::max({t[0], t[1], t[2]}) < file.mesh.positions.size();
    for (const Triangle& t : file.mesh.normal_triangles) {
      sound = sound && std::max({t[0], t[1], t[2]}) < file.mesh.normals.size();
    }
    CHECK(sound);
    return true;
  } catch (const Error& error) {
    const std::string line = error.what();
    CHECK(line.starts_with(path + ": "));
    CHECK(std::none_of(line.begin(), line.end(), [](char c) { return c < 0x20 || c > 0x7e; }));
    CHECK(error.exit_code() == 2);
    return false;
  }
}

std::size_t count_descriptors() {
  const fs::directory_iterator entries("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

}  // namespace

TEST_CASE("a box loads from every format, welded and closed") {
  const TemporaryFolder folder;
  for (const Sample& sample : samples()) {
    CAPTURE(sample.name);
    if (sample.bytes == glb()) continue;
    const MeshFile file = load_mesh(folder.write(sample.name, sample.bytes), false);
    CHECK(file.mesh.positions.size() == 8);
    CHECK(file.mesh.triangles.size() == 12);
    CHECK(file.report.open_edges == 0);
    CHECK(file.report.dropped_triangles == 0);
    CHECK_FALSE(file.report.flipped);
    CHECK(signed_volume(file.mesh) == doctest::Approx(6));
    CHECK(surface_area(file.mesh) == doctest::Approx(22));
    CHECK(bounds_of(file.mesh).low == DVec3(0));
    CHECK(bounds_of(file.mesh).high == DVec3(1, 2, 3));
  }
}

TEST_CASE("a glb file's nodes are applied, mirrors included") {
  const TemporaryFolder folder;
  const MeshFile file = load_mesh(folder.write("nodes.glb", glb()), false);
  CHECK(file.mesh.positions.size() == 24);
  CHECK(file.mesh.triangles.size() == 36);
  CHECK(file.report.open_edges == 0);
  CHECK(signed_volume(file.mesh) == doctest::Approx(6 * (8 + 8 + 1)));
  CHECK(bounds_of(file.mesh).low == DVec3(-1, 0, 0));
  CHECK(bounds_of(file.mesh).high == DVec3(22, 4, 6));
}

TEST_CASE("an obj file keeps its hard edges, and the missing material file is no matter") {
  const TemporaryFolder folder;
  const MeshFile file = load_mesh(folder.write("box.OBJ", obj()), true);
  CHECK(file.report.open_edges == 0);
  REQUIRE(file.mesh.normal_triangles.size() == 12);
  for (std::size_t t = 0; t < 12; ++t) {
    const Triangle& p = file.mesh.triangles[t];
    const DVec3& a = file.mesh.positions[p[0]];
    const DVec3 own =
        glm::normalize(glm::cross(file.mesh.positions[p[1]] - a, file.mesh.positions[p[2]] - a));
    for (const std::uint32_t n : file.mesh.normal_triangles[t]) CHECK(DVec3(file.mesh.normals[n]) == own);
  }
}

TEST_CASE("z up is turned into y up") {
  const TemporaryFolder folder;
  const MeshFile file = load_mesh(folder.write("box.ply", binary_ply()), true);
  CHECK(bounds_of(file.mesh).low == DVec3(0, 0, -2));
  CHECK(bounds_of(file.mesh).high == DVec3(1, 3, 0));
  CHECK(signed_volume(file.mesh) == doctest::Approx(6));
}

TEST_CASE("normals that are no normals are replaced by their triangle's own") {
  const TemporaryFolder folder;
  const std::string path = folder.write("bad.obj",
                                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn nan 0 0\nvn 0 3 4\n"
                                        "f 1//1 2//2 3//3\n");
  const MeshFile file = load_mesh(path, false);
  REQUIRE(file.mesh.normal_triangles.size() == 1);
  const Triangle& n = file.mesh.normal_triangles[0];
  CHECK(file.mesh.normals[n[0]] == glm::vec3(0, 0, 1));
  CHECK(file.mesh.normals[n[1]] == glm::vec3(0, 0, 1));
  CHECK(glm::length(file.mesh.normals[n[2]] - glm::vec3(0, 0.6f, 0.8f)) < 1e-6f);
  CHECK(file.report.open_edges == 3);
}

TEST_CASE("an inside-out file is turned and an open one is counted") {
  const TemporaryFolder folder;
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 4 2\n";
  CHECK(load_mesh(folder.write("open.obj", text), false).report.open_edges == 3);
  const MeshFile closed = load_mesh(folder.write("closed.obj", text + "f 2 4 3\n"), false);
  CHECK(closed.report.open_edges == 0);
  CHECK(closed.report.flipped);
  CHECK(signed_volume(closed.mesh) == doctest::Approx(1.0 / 6));
}

TEST_CASE("files that are no mesh files are refused by name") {
  const TemporaryFolder folder;
  const std::string missing = folder.at("missing.ply");
  CHECK(error_of(missing) == missing + ": cannot open: No such file or directory");
  fs::create_directory(folder.at("folder.obj"));
  CHECK(contains(error_of(folder.at("folder.obj")), "is a directory"));
  CHECK(contains(error_of(folder.write("empty.stl", "")), "is empty"));
  for (const char* name : {"box.fbx", "box", "box.gltf"}) {
    const std::string line = error_of(folder.write(name, binary_ply()));
    CHECK(contains(line, "unknown mesh format"));
    for (const char* known : {".ply", ".obj", ".glb", ".stl"}) CHECK(contains(line, known));
  }
  const std::string huge = folder.write("huge.stl", "solid");
  fs::resize_file(huge, (std::uintmax_t{1} << 31) + 1);
  CHECK(contains(error_of(huge), "larger than 2 GiB"));
}

TEST_CASE("the extension decides the format, not the content") {
  const TemporaryFolder folder;
  CHECK(contains(error_of(folder.write("ply.glb", binary_ply())), "cannot be read as .glb"));
  CHECK(contains(error_of(folder.write("obj.ply", obj())), "cannot be read as .ply"));
}

TEST_CASE("a file without a triangle is refused") {
  const TemporaryFolder folder;
  CHECK(contains(error_of(folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nl 1 2\nl 2 3\np 1\n")),
                 "holds no triangles"));
  CHECK(contains(error_of(folder.write("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n")),
                 "points or lines"));
}

TEST_CASE("vertices that are not finite are refused") {
  const TemporaryFolder folder;
  const float bad_values[] = {std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity()};
  for (const float bad : bad_values) {
    std::string bytes = binary_ply();
    std::memcpy(&bytes[bytes.find("end_header\n") + 11 + 12 * 3], &bad, 4);
    CHECK(contains(error_of(folder.write("bad.ply", bytes)),
                   "vertex 3 has a coordinate that is not a finite number"));
    bytes = binary_stl();
    std::memcpy(&bytes[84 + 12], &bad, 4);
    CHECK(contains(error_of(folder.write("bad.stl", bytes)), "not a finite number"));
  }
}

TEST_CASE("indices out of range never reach the mesh") {
  const TemporaryFolder folder;
  for (const std::uint32_t bad : {8u, 1000000u, 0x7fffffffu, 0xffffffffu}) {
    std::string bytes = binary_ply();
    std::memcpy(&bytes[bytes.size() - 4], &bad, 4);
    CHECK_FALSE(loads_or_throws(folder.write("bad.ply", bytes)));
    bytes = glb();
    const auto narrow = static_cast<std::uint16_t>(bad);
    std::memcpy(&bytes[bytes.size() - 2], &narrow, 2);
    static_cast<void>(loads_or_throws(folder.write("bad.glb", bytes)));
    static_cast<void>(loads_or_throws(
        folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 " + std::to_string(bad) + "\n")));
  }
}

TEST_CASE("a claim of four billion vertices is refused quickly") {
  const TemporaryFolder folder;
  const Timer timer;
  for (const char* encoding : {"ascii", "binary_little_endian"}) {
    for (const char* count : {"4000000000", "4294967295"}) {
      CHECK_FALSE(loads_or_throws(
          folder.write("big.ply", ply_header(encoding, count, "12") + "0 0 0\n1 0 0\n0 1 0\n")));
      CHECK_FALSE(loads_or_throws(
          folder.write("big.ply", ply_header(encoding, "3", count) + "0 0 0\n1 0 0\n0 1 0\n")));
    }
  }
  std::string bytes = binary_stl();
  const std::uint32_t count = 4000000000u;
  std::memcpy(&bytes[80], &count, 4);
  CHECK_FALSE(loads_or_throws(folder.write("big.stl", bytes)));
  bytes = glb();
  bytes.replace(bytes.find("\"count\":8,"), 10, "\"count\":4e9,");
  CHECK_FALSE(loads_or_throws(folder.write("big.glb", bytes)));
  CHECK(timer.seconds() < 5);
}

TEST_CASE("nodes nested without end are refused") {
  const TemporaryFolder folder;
  std::string nodes;
  constexpr int kDepth = 200000;
  for (int i = 0; i < kDepth; ++i) nodes += "{\"children\":[" + std::to_string(i + 1) + "]},";
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes + "{}]}";
  CHECK_FALSE(loads_or_throws(folder.write("deep.glb", glb_of(json, "    "))));
  std::string loop = glb();
  loop.replace(loop.find("\"children\":[1]"), 14, "\"children\":[0]");
  CHECK_FALSE(loads_or_throws(folder.write("loop.glb", loop)));
}

TEST_CASE("a small file that instances its triangles beyond the limit is refused quickly") {
  const TemporaryFolder folder;
  const Timer timer;
  std::string binary;
  for (int k = 0; k < 3; ++k) append(binary, box_corner(1 << k));
  for (int t = 0; t < 12000; ++t) {
    for (int k = 0; k < 3; ++k) append(binary, static_cast<std::uint16_t>(k));
  }
  std::string roots = "0";
  std::string nodes = "{\"mesh\":0}";
  for (int i = 1; i < 10000; ++i) {
    roots += "," + std::to_string(i);
    nodes += ",{\"mesh\":0}";
  }
  const std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots +
                           R"(]}],"nodes":[)" + nodes +
                           R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},
{"bufferView":1,"componentType":5123,"count":36000,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":72000}],
"buffers":[{"byteLength":72036}]})";
  CHECK(
      contains(error_of(folder.write("many.glb", glb_of(json, binary))), "more than 100 million triangles"));
  CHECK(timer.seconds() < 5);
}

TEST_CASE("a ply file that ends before its elements do is refused wherever it ends") {
  const TemporaryFolder folder;
  const std::string header = ply_header("binary_big_endian", "8", "12");
  std::string big_endian = header + binary_ply().substr(ply_header("binary_little_endian", "8", "12").size());
  for (std::size_t at = header.size(); at < header.size() + 8 * 12; at += 4)
    std::reverse(&big_endian[at], &big_endian[at] + 4);
  for (int face = 0; face < 12; ++face)
    for (int k = 0; k < 3; ++k) {
      char* index = &big_endian[header.size() + 8 * 12 + static_cast<std::size_t>(face) * 13 + 1 +
                                4 * static_cast<std::size_t>(k)];
      std::reverse(index, index + 4);
    }
  std::string of_windows = ascii_ply();
  for (std::size_t at = 0; (at = of_windows.find('\n', at)) != std::string::npos; at += 2)
    of_windows.replace(at, 1, "\r\n");
  for (const std::string& whole : {ascii_ply(), binary_ply(), big_endian, of_windows}) {
    CHECK(load_mesh(folder.write("cut.ply", whole), false).mesh.triangles.size() == 12);
    CHECK(load_mesh(folder.write("cut.ply", whole + "more"), false).mesh.triangles.size() == 12);
    const std::size_t begin = whole.find("end_header") + 12;
    const std::size_t end = whole.find_last_not_of("\r\n");  // of a number nobody knows whether it is whole
    for (std::size_t length = begin; length <= end - (whole.find("ascii") == std::string::npos ? 0 : 1);
         length += 7)
      CHECK(contains(error_of(folder.write("cut.ply", whole.substr(0, length))), "it ends within "));
  }
  const std::string last = binary_ply().substr(0, binary_ply().size() - 1);
  CHECK(contains(error_of(folder.write("cut.ply", last)),
                 "cannot be read as .ply: it ends within face 12 of 12"));
}

TEST_CASE("truncated files load what is left or are refused") {
  const TemporaryFolder folder;
  for (const Sample& sample : samples()) {
    CAPTURE(sample.name);
    const std::size_t step = std::max<std::size_t>(3, sample.bytes.size() / 100);
    std::size_t refused = 0;
    for (std::size_t length = 1; length < sample.bytes.size(); length += step) {
      refused += !loads_or_throws(folder.write(sample.name, sample.bytes.substr(0, length)));
    }
    CHECK(refused > 10);
  }
}

TEST_CASE("files with flipped bytes load or are refused, and leave nothing behind") {
  const TemporaryFolder folder;
  static_cast<void>(load_mesh(folder.write("first.ply", binary_ply()), false));
  const std::size_t descriptors = count_descriptors();
  std::mt19937 random(20240607);
  for (const Sample& sample : samples()) {
    CAPTURE(sample.name);
    std::size_t loaded = 0;
    for (int round = 0; round < 300; ++round) {
      CAPTURE(round);
      std::string bytes = sample.bytes;
      for (int flips = 1 + round % 4; flips > 0; --flips) {
        bytes[random() % bytes.size()] = static_cast<char>(random() & 0xff);
      }
      loaded += loads_or_throws(folder.write(sample.name, bytes));
    }
    CHECK(loaded > 0);
    CHECK(loaded < 300);
  }
  CHECK(count_descriptors() == descriptors);
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
}

TEST_CASE("the soap of the scenes is a closed bar of soap that stands on the ground") {
  const MeshFile soap = load_mesh(std::string(MEANDER_SOURCE_DIR) + "/scenes/soap.ply", false);
  CHECK(soap.mesh.triangles.size() == 102384);
  CHECK(soap.report.open_edges == 0);
  CHECK(soap.report.dropped_triangles == 0);
  CHECK(soap.report.welded_positions == 0);
  CHECK_FALSE(soap.report.flipped);
  CHECK(signed_volume(soap.mesh) == doctest::Approx(0.7128).epsilon(1e-4));
  const Bounds bounds = bounds_of(soap.mesh);
  CHECK(bounds.low.y == 0);
  CHECK(bounds.low.x == -bounds.high.x);
  CHECK(bounds.low.z == -bounds.high.z);
}
