// Bodies that overlap or nest, which a walk cannot deal with: it sees only its own body's surface.
#pragma once

#include <string>
#include <vector>

#include "trace/geometry.h"

namespace meander {

/// One line for each pair of translucent objects of which one reaches into the other, as far as a few hundred
/// points of their surfaces show.
[[nodiscard]] std::vector<std::string> overlap_warnings(const Scene& scene, const Geometry& geometry);

}  // namespace meander
