// The triangles of a mesh in groups of eight neighbours, which SIMD tests at once, and a tree over them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/mesh.h"

namespace meander {

inline constexpr std::size_t kPacket = 8;

/// Positions by corner, axis and triangle. Where there are fewer than eight, the last stands again.
struct alignas(64) Packet {
  float corner[3][3][kPacket];
  std::uint32_t triangle[kPacket];  // in the mesh
};

/// The planes of a packet's triangles: the height of a place p above one is dot(normal, p) - offset, normal
/// unit and outward, to within kPlaneError at its triangle. Both 0 where it would be worse than that.
struct alignas(64) PacketPlanes {
  float normal[3][kPacket];
  float offset[kPacket];
};
inline constexpr float kPlaneError = 0x1p-20f;

/// The bounds of up to eight children by axis and child, from +infinity to -infinity where there is none. A
/// child is a node, or ~packet.
struct alignas(32) PacketNode {
  float low[3][kPacket];
  float high[3][kPacket];
  std::int32_t child[kPacket];
};

/// The root is nodes[0].
struct Packets {
  std::vector<Packet> packets;
  std::vector<PacketPlanes> planes;  // one a packet, then some that no step passes
  std::vector<PacketNode> nodes;

  /// The number of the planes that no step passes.
  [[nodiscard]] std::uint32_t nothing() const noexcept { return static_cast<std::uint32_t>(packets.size()); }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return packets.size() * (sizeof(Packet) + sizeof(PacketPlanes)) + nodes.size() * sizeof(PacketNode);
  }
};

/// Halves the triangles across their longest extent until eight are left. There must be a triangle; indices
/// must be in range, and positions of size about 1.
[[nodiscard]] Packets make_packets(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

}  // namespace meander
