// What tells two scenes apart.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace meander {

/// A digest of all that decides the radiance of the film: camera, size of the film, environment, lights,
/// materials, objects and their meshes, in their order. Names, how the film is displayed, and the unit of
/// lengths (the coefficients are already per scene unit) do not count. The same scene has the same digest
/// wherever its numbers are resolved to the same bits, as one build does on any machine of its kind.
[[nodiscard]] std::uint64_t digest_of(const Scene& scene);

}  // namespace meander
