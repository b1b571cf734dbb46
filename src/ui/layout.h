// Where everything is in the window.
#pragma once

#include <array>

#include "ui/models.h"

namespace meander {

/// The fixed regions of the window, in points. Without an interface the image has all of it and the others
/// are empty.
struct Layout {
  Area window;
  Area toolbar;
  Area image;
  Area strip;      // snapshots
  Area sparkline;  // noise
  Area status;
  Area panel;

  bool operator==(const Layout&) const = default;
};

/// The regions of a window of `width` x `height` points: they cover it without overlaps. Windows under 480
/// points high have no strip of snapshots; narrow ones have a narrower panel.
[[nodiscard]] Layout layout_of(float width, float height, bool hidden);

[[nodiscard]] constexpr bool contains(const Area& area, float x, float y) noexcept {
  return x >= area.x && y >= area.y && x < area.x + area.width && y < area.y + area.height;
}

/// The largest centred rectangle of this shape in the area: where a film is shown as a whole.
[[nodiscard]] Area fitted_area(const Area& into, int width, int height);

/// The film pixel under a place in the window, as an unclamped coordinate, and back.
[[nodiscard]] std::array<double, 2> film_point(const OverlayModel& overlay, float x, float y);
[[nodiscard]] Area window_area(const OverlayModel& overlay, const PixelBox& box);

}  // namespace meander
