// The Lambertian lobe of a surface whose shading normal may differ from its geometric one. What would leave
// on the wrong side is mirrored at the geometric plane, so that no energy is lost; the value per unit
// reflectance, cosine included, is then also the density of the sampled direction.
#pragma once

#include "math/frame.h"
#include "math/warp.h"

namespace meander {

struct LambertLobe {
  Vec3 normal;          // geometric, unit, on the side of the lobe
  Vec3 shading_normal;  // unit, on the same side

  [[nodiscard]] Real eval(const Vec3& direction) const noexcept {
    const Real height = glm::dot(direction, normal);
    if (!(height > 0)) return 0;
    const Vec3 mirrored = direction - 2 * height * normal;
    return pdf_cosine_hemisphere(glm::dot(direction, shading_normal)) +
           pdf_cosine_hemisphere(glm::dot(mirrored, shading_normal));
  }

  [[nodiscard]] Vec3 sample(const Vec2& u) const noexcept {
    const Vec3 direction = renormalise(make_frame(shading_normal).to_world(sample_cosine_hemisphere(u)));
    const Real height = glm::dot(direction, normal);
    return height < 0 ? direction - 2 * height * normal : direction;
  }
};

/// The lobe on the side of the geometric normal `normal`; a shading normal that points to the other side is
/// turned.
[[nodiscard]] inline LambertLobe make_lobe(const Vec3& normal, const Vec3& shading_normal) noexcept {
  return {normal, glm::dot(normal, shading_normal) < 0 ? -shading_normal : shading_normal};
}

}  // namespace meander
