// A plot as a picture.
#pragma once

#include "math/image.h"
#include "ui/plot.h"

namespace meander {

/// Drawn through OpenGL in an off-screen context of its own, two pixels a point. Error (runtime) when there
/// is no such context, no shader or no font.
[[nodiscard]] Image8 plot_picture(const Plot& plot, int width, int height);

}  // namespace meander
