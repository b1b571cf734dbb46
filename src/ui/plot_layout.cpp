#include "ui/plot_layout.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

constexpr float kBetween = 2;  // dots

bool holds(const PlotBox& area, const PlotBox& box) {
  return area.low.x <= box.low.x && area.low.y <= box.low.y && box.high.x <= area.high.x &&
         box.high.y <= area.high.y;
}

}  // namespace

void PlotClutter::add_line(ImVec2 from, ImVec2 to) {
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  if (!std::isfinite(length)) return;
  const int steps = static_cast<int>(std::ceil(std::min(length, 1e5f) / kBetween)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(steps);
    dots_.emplace_back(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
  }
}

void PlotClutter::add_box(const PlotBox& box) {
  for (float y = box.low.y; y <= box.high.y; y += kBetween) add_line({box.low.x, y}, {box.high.x, y});
}

int PlotClutter::covered(const PlotBox& box, float margin) const {
  return static_cast<int>(std::count_if(dots_.begin(), dots_.end(), [&](ImVec2 dot) {
    return box.low.x - margin < dot.x && dot.x < box.high.x + margin && box.low.y - margin < dot.y &&
           dot.y < box.high.y + margin;
  }));
}

std::vector<PlotBox> places_at_edges(const PlotBox& area, ImVec2 size, float margin) {
  const float left = area.low.x + margin;
  const float right = area.high.x - margin - size.x;
  const float top = area.low.y + margin;
  const float bottom = area.high.y - margin - size.y;
  std::vector<PlotBox> places;
  if (right < left || bottom < top) return places;
  const auto add = [&](float x, float y) { places.push_back({{x, y}, {x + size.x, y + size.y}}); };
  add(right, top);
  add(left, bottom);
  add(left, top);
  add(right, bottom);
  constexpr int kSteps = 12;
  for (int i = 1; i < kSteps; ++i) {
    const float share = static_cast<float>(i) / kSteps;
    const float x = right + share * (left - right);
    const float y = top + share * (bottom - top);
    add(x, top);
    add(right, y);
    add(x, bottom);
    add(left, y);
  }
  return places;
}

std::vector<PlotBox> places_beside(const PlotBox& area, ImVec2 size, ImVec2 from, ImVec2 to) {
  constexpr float kGap = 5;
  constexpr int kSteps = 40;
  std::vector<PlotBox> places;
  for (int i = 0; i < kSteps; ++i) {
    const float share = static_cast<float>((i + kSteps / 4) % kSteps) / kSteps;
    const ImVec2 p{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    const PlotBox below{{p.x - kGap - size.x, p.y + kGap}, {p.x - kGap, p.y + kGap + size.y}};
    const PlotBox above{{p.x + kGap, p.y - kGap - size.y}, {p.x + kGap + size.x, p.y - kGap}};
    for (const PlotBox& place : {below, above})
      if (holds(area, place)) places.push_back(place);
  }
  return places;
}

}  // namespace meander
