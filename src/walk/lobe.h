// The Lambertian lobe of a surface whose shading normal may differ from its geometric one. What would leave
// on the wrong side is mirrored at the geometric plane, so that no energy is lost; the value per unit
// reflectance, cosine included, is then also the density of the sampled direction.
#pragma once

#include <optional>

#include "math/frame.h"
#include "math/fresnel.h"
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

/// The light that a Lambertian inside sends out through a smooth interface, `ior` > 1 the index inside over
/// outside: directions are cosine-distributed inside and refracted out, or stay in by Fresnel reflection.
class RefractedLobe {
 public:
  RefractedLobe(const LambertLobe& lobe, Real ior) noexcept : outside_(lobe), ior_(ior) {}

  /// Power per steradian outside per unit power that arrives from inside, (1 - F) cos / (pi ior^2); it
  /// integrates to what gets out, and is the density of sample() too.
  [[nodiscard]] Real eval(const Vec3& direction) const noexcept {
    const Real height = glm::dot(direction, outside_.normal);
    if (!(height > 0)) return 0;
    const Vec3 mirrored = direction - 2 * height * outside_.normal;
    return through(glm::dot(direction, outside_.shading_normal)) +
           through(glm::dot(mirrored, outside_.shading_normal));
  }

  /// A direction outside, or nothing when the light stays in. u3 decides which.
  [[nodiscard]] std::optional<Vec3> sample(const Vec2& u, Real u3) const noexcept {
    const Vec3 inside = sample_cosine_hemisphere(u);
    const Fresnel fresnel = eval_fresnel(inside.z, 1 / ior_);
    if (u3 < fresnel.reflectance) return std::nullopt;
    const Vec3 local(ior_ * inside.x, ior_ * inside.y, fresnel.cos_t);
    const Vec3 direction = renormalise(make_frame(outside_.shading_normal).to_world(local));
    const Real height = glm::dot(direction, outside_.normal);
    return height < 0 ? direction - 2 * height * outside_.normal : direction;
  }

 private:
  [[nodiscard]] Real through(Real cosine) const noexcept {
    if (!(cosine > 0)) return 0;
    return (1 - eval_fresnel(std::min(cosine, Real(1)), ior_).reflectance) * pdf_cosine_hemisphere(cosine) /
           (ior_ * ior_);
  }

  LambertLobe outside_;
  Real ior_;
};

/// The lobe on the side of the geometric normal `normal`; a shading normal that points to the other side is
/// turned.
[[nodiscard]] inline LambertLobe make_lobe(const Vec3& normal, const Vec3& shading_normal) noexcept {
  return {normal, glm::dot(normal, shading_normal) < 0 ? -shading_normal : shading_normal};
}

}  // namespace meander
