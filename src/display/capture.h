// The frame the preview would show, without a display.
#pragma once

#include "display/film_view.h"
#include "math/image.h"

namespace meander {

/// Draws channels 0..2 of `linear` (at least 1 x 1 pixel, any size that fits in memory) as FilmView does, in
/// an off-screen context of its own, which ends with the call. The same input gives the same bytes. Error
/// (runtime) when there is no such context or no shader.
[[nodiscard]] Image8 capture_frame(const Image& linear, const ViewOptions& options);

}  // namespace meander
