// How large the things of a scene are, in the world.
#pragma once

#include "scene/scene.h"

namespace meander {

/// The tightest box about the object in the world. An unbounded slab counts as the piece over [-1, 1]^2 of
/// its own x and z.
[[nodiscard]] Bounds world_bounds(const Object& object);

/// The largest distance of the object's surface from the centre of its world bounds; for a slab, of the same
/// piece.
[[nodiscard]] double bounding_radius(const Object& object);

/// Of the translucent objects together; of all when none is; [-1, 1]^3 without objects. Slabs count only
/// where there is nothing else.
[[nodiscard]] Bounds subject_bounds(const Scene& scene);

/// The mean chord 4 V / S of the object in the world, in scene units: the mean length of a straight line
/// through it under uniform light. Exact for every shape, 4/3 for the unit sphere and box; twice its
/// thickness for a slab. A mesh that encloses no volume, or whose vector areas do not cancel because it is
/// open, has the shortest side of its world bounds instead. Milliseconds for a large mesh.
[[nodiscard]] double mean_chord(const Object& object);

}  // namespace meander
