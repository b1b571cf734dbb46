// From a point on the film to a ray in the world.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace meander {

/// What a ray has just left: against that object alone its origin is moved by `offset`, which outweighs
/// rounding, so that the surface is not met again and another one that touches it is.
struct Departure {
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  std::size_t object = kNowhere;
  Vec3 offset{0};
};

/// A ray in world coordinates; the origin is in double so that a body far from the world's origin loses
/// nothing.
struct Ray {
  DVec3 origin{0};
  Vec3 direction{0, 0, 1};
  Departure departure = {};
};

/// The camera's axes and extents for one film size, made once a job.
struct CameraRays {
  DVec3 origin;
  DVec3 right;    // from the left to the right edge of the film, in directions (perspective) or positions
  DVec3 up;       // from the bottom to the top edge
  DVec3 forward;  // unit
  bool orthographic;
  double pixel_width;  // of the film, as fractions of it
  double pixel_height;

  /// x and y in [0, 1] across the film, y down from the top edge. The direction is unit length.
  [[nodiscard]] Ray at(double x, double y) const noexcept {
    const DVec3 offset = (x - 0.5) * right + (0.5 - y) * up;
    if (orthographic) return {origin + offset, Vec3(forward)};
    return {origin, Vec3(glm::normalize(forward + offset))};
  }
};

/// look_from and look_at must differ and up must not be parallel to the view (the scene reader checks both).
[[nodiscard]] CameraRays make_camera_rays(const Camera& camera, int width, int height) noexcept;

}  // namespace meander
