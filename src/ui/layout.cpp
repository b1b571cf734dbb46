#include "ui/layout.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

constexpr float kToolbar = 38;
constexpr float kStatus = 24;
constexpr float kStrip = 66;
constexpr float kSparkline = 26;
constexpr float kPanel = 320;
constexpr float kNarrowPanel = 284;
constexpr float kLowWindow = 480;
constexpr float kNarrowWindow = 900;

}  // namespace

Layout layout_of(float width, float height, bool hidden) {
  Layout layout;
  layout.window = {0, 0, width, height};
  layout.image = layout.window;
  if (hidden) return layout;
  const float toolbar = std::min(kToolbar, height / 4);
  const float status = std::min(kStatus, height / 8);
  const float panel = std::min(width < kNarrowWindow ? kNarrowPanel : kPanel, width / 2);
  const bool low = height < kLowWindow;
  const float strip = low ? 0 : kStrip;
  const float sparkline = low ? 0 : kSparkline;
  const float left = width - panel;
  const float middle = height - toolbar - status;
  layout.toolbar = {0, 0, width, toolbar};
  layout.status = {0, height - status, width, status};
  layout.panel = {left, toolbar, panel, middle};
  layout.image = {0, toolbar, left, middle - strip - sparkline};
  layout.strip = {0, toolbar + layout.image.height, left, strip};
  layout.sparkline = {0, layout.strip.y + strip, left, sparkline};
  return layout;
}

Area fitted_area(const Area& into, int width, int height) {
  const float ratio = static_cast<float>(width) / static_cast<float>(height);
  const float w = std::min(into.width, into.height * ratio);
  const float h = w / ratio;
  return {std::floor(into.x + 0.5f * (into.width - w)), std::floor(into.y + 0.5f * (into.height - h)), w, h};
}

std::array<double, 2> film_point(const OverlayModel& overlay, float x, float y) {
  const Area& film = overlay.film;
  if (film.width <= 0 || film.height <= 0) return {0, 0};
  return {static_cast<double>((x - film.x) / film.width) * overlay.film_width,
          static_cast<double>((y - film.y) / film.height) * overlay.film_height};
}

Area window_area(const OverlayModel& overlay, const PixelBox& box) {
  const Area& film = overlay.film;
  const float sx = film.width / static_cast<float>(overlay.film_width);
  const float sy = film.height / static_cast<float>(overlay.film_height);
  return {film.x + sx * static_cast<float>(box.x0), film.y + sy * static_cast<float>(box.y0),
          sx * static_cast<float>(box.x1 - box.x0), sy * static_cast<float>(box.y1 - box.y0)};
}

}  // namespace meander
