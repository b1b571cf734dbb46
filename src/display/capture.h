// The frame the preview would show, without a display.
#pragma once

#include "display/film_view.h"
#include "film/film_planes.h"
#include "math/image.h"

namespace meander {

/// Draws the planes (at least 1 x 1 pixel, any size that fits in memory) as FilmView does, one film pixel to
/// a pixel, in an off-screen context of its own, which ends with the call. The same input gives the same
/// bytes. Error (runtime) when there is no such context or no shader.
[[nodiscard]] Image8 capture_frame(const FilmPlanes& planes, const ViewOptions& options);

/// The same of channels 0..2 of an image, which has the views image, luminance and clipping.
[[nodiscard]] Image8 capture_frame(const Image& linear, const ViewOptions& options);

}  // namespace meander
