// Orthonormal frames about a direction.
#pragma once

#include <cmath>

#include "math/types.h"

namespace meander {

/// Right-handed: tangent x bitangent = normal.
struct Frame {
  Vec3 tangent;
  Vec3 bitangent;
  Vec3 normal;

  [[nodiscard]] Vec3 to_world(const Vec3& local) const noexcept {
    return local.x * tangent + local.y * bitangent + local.z * normal;
  }
  [[nodiscard]] Vec3 to_local(const Vec3& v) const noexcept {
    return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
  }
};

/// Frame about a unit vector, without a branch (Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin
/// 2017, "Building an Orthonormal Basis, Revisited", listing 3).
[[nodiscard]] inline Frame make_frame(const Vec3& n) noexcept {
  const Real sign = std::copysign(Real(1), n.z);
  const Real a = -1 / (sign + n.z);
  const Real b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// The vector scaled back to unit length by one Newton step; |v| must be within a few per cent of 1.
[[nodiscard]] inline Vec3 renormalise(const Vec3& v) noexcept {
  return v * (Real(1.5) - Real(0.5) * glm::dot(v, v));
}

}  // namespace meander
