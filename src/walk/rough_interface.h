// The rough interface of a body at one point of its surface, met from either side. What a shading normal
// would send to the wrong side of the surface is mirrored at it, so that nothing is lost.
#pragma once

#include "math/frame.h"
#include "math/ggx.h"
#include "math/rough_dielectric.h"

namespace meander {

class RoughInterface {
 public:
  /// `normal` (geometric, outward) and `shading_normal` are unit; `incoming` travels toward the surface.
  RoughInterface(const Vec3& normal, const Vec3& shading_normal, const RoughDielectric& surface,
                 const Vec3& incoming) noexcept
      : normal_(normal), surface_(surface) {
    // The shading normal must see the light arrive from the side that it does arrive from.
    const bool agrees = (glm::dot(incoming, shading_normal) < 0) == (glm::dot(incoming, normal) < 0);
    frame_ = make_frame(agrees ? shading_normal : normal);
    incoming_ = frame_.to_local(incoming);
  }

  struct Sample {
    Vec3 direction;
    Real density;  // infinite where the interface is as good as not there
    bool outside;
  };
  [[nodiscard]] Sample sample(Random& random) const noexcept {
    const InterfaceSample sample = sample_rough_dielectric(surface_, incoming_, random);
    const bool outside = sample.direction.z > 0;
    Vec3 direction = renormalise(frame_.to_world(sample.direction));
    if ((glm::dot(direction, normal_) > 0) != outside) direction = mirrored(direction);
    return {direction, sample.density, outside};
  }

  /// The weight of a light outside, sampled along `direction` with the density `competing`, against sample();
  /// of a light without extent, its power per unit of `competing`.
  [[nodiscard]] Real weigh(const Vec3& direction, Real competing, bool delta, Random& random) const noexcept {
    if (!(glm::dot(direction, normal_) > 0)) return 0;
    Real sum = 0;
    for (const Vec3& world : {direction, mirrored(direction)}) {
      const Vec3 outgoing = frame_.to_local(world);
      if (!(outgoing.z > 0)) continue;
      sum += delta ? eval_rough_dielectric(surface_, incoming_, outgoing, random) / competing
                   : weigh_rough_dielectric(surface_, incoming_, outgoing, competing, random);
    }
    return sum;
  }

 private:
  [[nodiscard]] Vec3 mirrored(const Vec3& d) const noexcept { return d - 2 * glm::dot(d, normal_) * normal_; }

  Vec3 normal_;
  RoughDielectric surface_;
  Frame frame_;
  Vec3 incoming_;
};

}  // namespace meander
