// What lies over the picture: drawn under the windows of the interface, and clipped to the image area.
#pragma once

#include "ui/layout.h"
#include "ui/widgets.h"

namespace meander {

/// Ruler, rectangle, legend, titles, wipe line, what is going on, and the reading of the pixel under the
/// pointer.
void overlays(const Ui& ui, const UiModel& model, const Area& image);

/// Decades from `low` to `high`, both included where they are ones; both ends where there is none.
[[nodiscard]] std::vector<double> legend_ticks(double low, double high);

}  // namespace meander
