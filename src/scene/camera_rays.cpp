#include "scene/camera_rays.h"

#include <cmath>

namespace meander {

CameraRays make_camera_rays(const Camera& camera, int width, int height) noexcept {
  const DVec3 forward = glm::normalize(camera.look_at - camera.look_from);
  const DVec3 right = glm::normalize(glm::cross(forward, camera.up));
  const DVec3 up = glm::cross(right, forward);
  const double full_height = camera.orthographic_height ? *camera.orthographic_height
                                                        : 2 * std::tan(glm::radians(camera.vertical_fov) / 2);
  const double aspect = static_cast<double>(width) / height;
  return {camera.look_from, right * (full_height * aspect),         up * full_height,
          forward,          camera.orthographic_height.has_value(), 1.0 / width,
          1.0 / height};
}

DMat3 linear_part(const Transform& t) {
  const DVec3 r = glm::radians(t.rotate);
  const DVec3 c = glm::cos(r);
  const DVec3 s = glm::sin(r);
  const DMat3 rx(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x);
  const DMat3 ry(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y);
  const DMat3 rz(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
  const DMat3 scale(t.scale.x, 0, 0, 0, t.scale.y, 0, 0, 0, t.scale.z);
  return rz * ry * rx * scale;
}

}  // namespace meander
