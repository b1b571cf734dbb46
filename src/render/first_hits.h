// What the camera sees first, found once a job: the pixels of the objects, and the normals.
#pragma once

#include "math/image.h"
#include "render/progressive.h"

namespace meander {

/// `mask`: one byte a pixel of the job's area, 1 where its whole square shows a translucent object, judged at
/// its corners and its middle. `normals`: the shading normal at the middle of each pixel, toward the camera,
/// three channels, 0 where nothing is hit.
struct FirstHits {
  std::vector<std::uint8_t> mask;
  Image normals;
};

/// Once `stop` is true the rest is left 0.
[[nodiscard]] FirstHits first_hits(const Job& job, const std::atomic<bool>& stop);

/// Whether two scenes show a camera the same surfaces, up to what they are made of, so that first_hits are
/// equal.
[[nodiscard]] bool same_first_hits(const Scene& a, const Scene& b) noexcept;

}  // namespace meander
