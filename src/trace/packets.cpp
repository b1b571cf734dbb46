#include "trace/packets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meander {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Member {
  glm::vec3 middle;  // three times
  std::uint32_t triangle;
};

struct Box {
  glm::vec3 low{kInfinity};
  glm::vec3 high{-kInfinity};

  void add(const Box& other) noexcept {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

// Triangles [begin, end) of the order; begin is a multiple of eight.
struct Range {
  std::size_t begin;
  std::size_t end;
  [[nodiscard]] std::size_t count() const noexcept { return end - begin; }
};

class Builder {
 public:
  Builder(std::span<const glm::vec3> positions, std::span<const Triangle> triangles)
      : positions_(positions), triangles_(triangles) {
    members_.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const Triangle& t = triangles[i];
      members_.push_back({positions[t[0]] + positions[t[1]] + positions[t[2]], i});
    }
    result_.packets.resize((triangles.size() + kPacket - 1) / kPacket);
    result_.planes.resize(result_.packets.size() + 1);
    std::fill_n(result_.planes.back().offset, kPacket, 1.0f);
  }

  [[nodiscard]] Packets build() {
    (void)add_node({0, members_.size()});
    return std::move(result_);
  }

 private:
  Box add_node(const Range& whole) {
    const std::size_t number = result_.nodes.size();
    result_.nodes.emplace_back();
    Range parts[kPacket] = {whole};
    std::size_t count = 1;
    for (int halvings = 0; halvings < 3; ++halvings)
      for (std::size_t i = 0, before = count; i < before; ++i)
        if (parts[i].count() > kPacket) parts[count++] = cut(parts[i]);
    Box all;
    PacketNode node;
    for (std::size_t i = 0; i < kPacket; ++i) {
      Box box;
      node.child[i] = 0;
      if (i < count) {
        const bool leaf = parts[i].count() <= kPacket;
        node.child[i] = leaf ? ~static_cast<std::int32_t>(parts[i].begin / kPacket)
                             : static_cast<std::int32_t>(result_.nodes.size());
        box = leaf ? fill_packet(parts[i]) : add_node(parts[i]);
      }
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][i] = box.low[axis];
        node.high[axis][i] = box.high[axis];
      }
      all.add(box);
    }
    result_.nodes[number] = node;
    return all;
  }

  // Keeps the lower half of a range, and returns the upper one.
  Range cut(Range& range) {
    const auto first = members_.begin();
    const auto at = [&](std::size_t i) { return first + static_cast<std::ptrdiff_t>(i); };
    Box box;
    for (auto m = at(range.begin); m != at(range.end); ++m) box.add({m->middle, m->middle});
    const glm::vec3 size = box.high - box.low;
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const std::size_t half = (range.count() / 2 + kPacket - 1) / kPacket * kPacket;
    const Range upper{range.begin + half, range.end};
    std::nth_element(at(range.begin), at(upper.begin), at(range.end),
                     [axis](const Member& a, const Member& b) {
                       return a.middle[axis] < b.middle[axis] ||
                              (a.middle[axis] == b.middle[axis] && a.triangle < b.triangle);
                     });
    range.end = upper.begin;
    return upper;
  }

  Box fill_packet(const Range& range) {
    Packet& packet = result_.packets[range.begin / kPacket];
    Box box;
    for (std::size_t i = 0; i < kPacket; ++i) {
      const std::uint32_t triangle = members_[std::min(range.begin + i, range.end - 1)].triangle;
      packet.triangle[i] = triangle;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const glm::vec3& p = positions_[triangles_[triangle][corner]];
        for (int axis = 0; axis < 3; ++axis) packet.corner[corner][axis][i] = p[axis];
        box.add({p, p});
      }
      fill_plane(triangles_[triangle], result_.planes[range.begin / kPacket], i);
    }
    return box;
  }

  void fill_plane(const Triangle& triangle, PacketPlanes& planes, std::size_t i) const {
    const DVec3 a(positions_[triangle[0]]);
    const DVec3 b(positions_[triangle[1]]);
    const DVec3 c(positions_[triangle[2]]);
    const DVec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    const glm::vec3 normal(length > 0 ? cross / length : DVec3(0));
    const auto offset = static_cast<float>(glm::dot(DVec3(normal), a));
    double error = length > 0 ? 0 : 1;
    for (const DVec3& corner : {a, b, c})
      error = std::max(error, std::abs(glm::dot(DVec3(normal), corner) - double{offset}));
    const bool good = error < double{kPlaneError} / 4;
    for (int axis = 0; axis < 3; ++axis) planes.normal[axis][i] = good ? normal[axis] : 0;
    planes.offset[i] = good ? offset : 0;
  }

  std::span<const glm::vec3> positions_;
  std::span<const Triangle> triangles_;
  std::vector<Member> members_;
  Packets result_;
};

}  // namespace

Packets make_packets(std::span<const glm::vec3> positions, std::span<const Triangle> triangles) {
  return Builder(positions, triangles).build();
}

}  // namespace meander
