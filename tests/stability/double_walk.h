// The oracle of the suite: a random walk of its own, in double precision, in one convex matched body.
#pragma once

#include "scene/scene.h"
#include "stability/readings.h"

namespace meander {

/// Whether double_walk knows the scene: a square film, one matched object that is a sphere, a box or a convex
/// mesh, and a constant white surround.
[[nodiscard]] bool knows_double_walk(const Scene& scene);

/// The readings of the scene's image from about `samples` walks a channel: other random numbers, other
/// arithmetic and other geometry (a quadric, or planes) than the renderer's. The coefficients are those of
/// the scene, as they are stored.
[[nodiscard]] Readings double_walk(const Scene& scene, std::uint64_t samples);

}  // namespace meander
