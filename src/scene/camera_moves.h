// A camera moved by hand. Motions of a pointer are fractions of the view's height, right and down positive.
// Every move holds what it does not name, needs a valid camera and yields one, after however many moves.
#pragma once

#include "scene/scene.h"

namespace meander {

/// Turns the camera about look_at as if the pointer dragged the subject: the height of the view is half a
/// turn. The distance and `up` are held; the camera stops short of the poles of `up` and never flips.
[[nodiscard]] Camera orbit(const Camera& camera, double dx, double dy);

/// Shifts the camera across its view so that what lies under the pointer in the plane of look_at stays there.
[[nodiscard]] Camera pan(const Camera& camera, double dx, double dy);

/// Comes nearer by a tenth of the distance to look_at (orthographic: of the height) a step; negative steps go
/// back and undo exactly as many. Distances and heights stay in [1e-9, 1e9].
[[nodiscard]] Camera dolly(const Camera& camera, double steps);

/// Looks at the middle of the bounds from the same direction, near enough for them to fill 1/margin of the
/// view one way, of which `aspect` is width over height.
[[nodiscard]] Camera frame(const Camera& camera, const Bounds& bounds, double aspect, double margin = 1.25);

/// The bounds framed as seen from `direction` (from the subject toward the camera: +z is the front), which is
/// turned off the axis of `up` by 1e-4 where it lies on it.
[[nodiscard]] Camera view_from(const Camera& camera, const Bounds& bounds, const DVec3& direction,
                               double aspect = 16.0 / 9);

/// Height of the view in the plane of look_at, in scene units.
[[nodiscard]] double view_height(const Camera& camera);

}  // namespace meander
