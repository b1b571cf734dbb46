// Where words on a plot cover no curve.
#pragma once

#include <imgui.h>

#include <span>
#include <vector>

namespace meander {

struct PlotBox {
  ImVec2 low;
  ImVec2 high;
};

/// What is drawn on a plot, as dots two points apart.
class PlotClutter {
 public:
  void add_line(ImVec2 from, ImVec2 to);
  void add_box(const PlotBox& box);
  /// How many dots lie in a box or less than `margin` beside it.
  [[nodiscard]] int covered(const PlotBox& box, float margin) const;

 private:
  std::vector<ImVec2> dots_;
};

/// Places of a size at the edges of `area`, `margin` inside it: the corners, the upper right one first, then
/// what is between them. Empty where the size does not fit.
[[nodiscard]] std::vector<PlotBox> places_at_edges(const PlotBox& area, ImVec2 size, float margin);

/// Places of a size beside a falling line within `area`: above it and below, near its first quarter first.
/// Empty where none fits.
[[nodiscard]] std::vector<PlotBox> places_beside(const PlotBox& area, ImVec2 size, ImVec2 from, ImVec2 to);

}  // namespace meander
