// Small mesh files of every format, as bytes: one box, and for GLB a few of them.
#pragma once

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "math/types.h"

namespace meander {

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The box [0, 1] x [0, 2] x [0, 3]: corner k has bit 0 of k in x, bit 1 in y, bit 2 in z; quads wound
// outward.
inline constexpr int kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

inline glm::vec3 box_corner(int k) { return {float(k & 1), float(k >> 1 & 1) * 2, float(k >> 2 & 1) * 3}; }

inline std::vector<std::array<int, 3>> box_triangles() {
  std::vector<std::array<int, 3>> triangles;
  for (const auto& q : kQuads) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

inline std::string ply_header(const std::string& encoding, const std::string& vertices,
                              const std::string& faces) {
  return "ply\nformat " + encoding + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ascii_ply() {
  std::ostringstream text;
  text << ply_header("ascii", "8", "6");
  for (int k = 0; k < 8; ++k)
    text << box_corner(k).x << ' ' << box_corner(k).y << ' ' << box_corner(k).z << '\n';
  for (const auto& q : kQuads) text << "4 " << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
  return text.str();
}

inline std::string binary_ply() {
  std::string bytes = ply_header("binary_little_endian", "8", "12");
  for (int k = 0; k < 8; ++k) append(bytes, box_corner(k));
  for (const auto& triangle : box_triangles()) {
    append(bytes, std::uint8_t{3});
    append(bytes, triangle);
  }
  return bytes;
}

inline std::string obj() {
  std::ostringstream text;
  text << "# a box\nmtllib nowhere.mtl\no box\n";
  for (int k = 0; k < 8; ++k) {
    text << "v " << box_corner(k).x << ' ' << box_corner(k).y << ' ' << box_corner(k).z << '\n';
  }
  text << "vn -1 0 0\nvn 1 0 0\nvn 0 -1 0\nvn 0 1 0\nvn 0 0 -1\nvn 0 0 1\nusemtl jade\n";
  for (int f = 0; f < 6; ++f) {
    text << 'f';
    for (const int k : kQuads[f]) text << ' ' << k + 1 << "//" << f + 1;
    text << '\n';
  }
  text << "l 1 2\np 3\n";
  return text.str();
}

inline std::string ascii_stl() {
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& triangle : box_triangles()) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int k : triangle) {
      text << "vertex " << box_corner(k).x << ' ' << box_corner(k).y << ' ' << box_corner(k).z << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid box\n";
  return text.str();
}

inline std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{12});
  for (const auto& triangle : box_triangles()) {
    append(bytes, glm::vec3(0));
    for (const int k : triangle) append(bytes, box_corner(k));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string glb_of(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append(bytes, std::uint32_t{2});
  append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  append(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

// The box three times: at (10, 0, 0) doubled; in that node's frame at (5, 0, 0); and mirrored in x.
inline std::string glb() {
  std::string binary;
  for (int k = 0; k < 8; ++k) append(binary, box_corner(k));
  for (const auto& triangle : box_triangles()) {
    for (const int k : triangle) append(binary, static_cast<std::uint16_t>(k));
  }
  return glb_of(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],
"nodes":[{"mesh":0,"translation":[10,0,0],"scale":[2,2,2],"children":[1]},{"mesh":0,"translation":[5,0,0]},
{"mesh":0,"scale":[-1,1,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},
{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72}],
"buffers":[{"byteLength":168}]})",
                binary);
}

struct Sample {
  const char* name;
  std::string bytes;
};

inline std::vector<Sample> samples() {
  return {{"ascii.ply", ascii_ply()}, {"binary.ply", binary_ply()}, {"quads.obj", obj()},
          {"ascii.stl", ascii_stl()}, {"binary.stl", binary_stl()}, {"nodes.glb", glb()}};
}

}  // namespace meander
