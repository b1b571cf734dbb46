// Where the benchmarks' walks enter: the same for the scalar walk and for the lanes.
#pragma once

#include <hwy/cache_control.h>

#include <algorithm>
#include <vector>

#include "math/random.h"
#include "math/warp.h"
#include "scene/mesh.h"
#include "walk/lobe.h"
#include "walk/random_walk.h"

namespace meander {

/// Diffusely through the pole of the unit sphere.
inline void enter_sphere(Walker& walker, Random& random) noexcept {
  const Real u1 = random.next();
  const Real u2 = random.next();
  walker.position = {0, 0, 1};
  walker.direction = -sample_cosine_hemisphere({u1, u2});
}

/// Entries are known some walks ahead, as camera rays are: asks for the memory of the one that walk `next` +
/// 16 of the seed begins at, where it has any.
template <class Start>
void foresee(const Start& start, std::uint64_t seed, std::uint32_t next) noexcept {
  if constexpr (requires(Random & random) { start.place(random); }) {
    Random ahead = stream(seed, 0, next + 16);
    hwy::Prefetch(&start.place(ahead));
  }
}

/// Diffusely through the middle of any triangle of a mesh whose body is centred on `center`.
class MeshEntry {
 public:
  MeshEntry(const Mesh& mesh, const DVec3& center) {
    for (const Triangle& t : mesh.triangles) {
      const DVec3& a = mesh.positions[t[0]];
      const DVec3& b = mesh.positions[t[1]];
      const DVec3& c = mesh.positions[t[2]];
      const Vec3 normal(glm::normalize(glm::cross(b - a, c - a)));
      places_.push_back({Vec3((a + b + c) / 3.0 - center) - Real(0x1p-20) * normal, normal});
    }
  }

  struct Place {
    Vec3 position;
    Vec3 normal;
  };

  [[nodiscard]] const Place& place(Random& random) const noexcept {
    const auto count = static_cast<Real>(places_.size());
    return places_[std::min(static_cast<std::size_t>(random.next() * count), places_.size() - 1)];
  }

  void operator()(Walker& walker, Random& random) const noexcept {
    const Place& at = place(random);
    const Real u1 = random.next();
    const Real u2 = random.next();
    walker.position = at.position;
    walker.direction = make_lobe(-at.normal, -at.normal).sample({u1, u2});
  }

 private:
  std::vector<Place> places_;
};

}  // namespace meander
