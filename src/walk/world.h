// The seam between a walk and the shape it walks in. A walk sees only the surface of its own body, in the
// body's own coordinates: tests and `measure` give it exact shapes, production gives it a mesh.
#pragma once

#include <concepts>

#include "scene/crossing.h"

namespace meander {

/// first_crossing(p, d, t): the step of length t >= 0 (may be infinite) from p inside along the unit
/// direction d.
template <class W>
concept World = requires(const W& world, const Vec3& p, const Vec3& d, Real t) {
  { world.first_crossing(p, d, t) } -> std::same_as<Crossing>;
};

}  // namespace meander
