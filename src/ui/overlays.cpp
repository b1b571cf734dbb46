#include "ui/overlays.h"

#include <algorithm>
#include <cmath>

#include "math/color_scale.h"
#include "ui/bars.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr ImU32 kPlate = IM_COL32(18, 18, 18, 190);
constexpr ImU32 kInk = IM_COL32(236, 236, 236, 255);
constexpr float kMargin = 10;
constexpr float kHandle = 9;

ImDrawList& background() { return *ImGui::GetBackgroundDrawList(); }

void text(ImFont* font, const ImVec2& at, ImU32 color, std::string_view words) {
  background().AddText(font, font->FontSize * font->Scale, at, color, words.data(),
                       words.data() + words.size());
}

void plate(const ImVec2& low, const ImVec2& size) {
  background().AddRectFilled(low, {low.x + size.x, low.y + size.y}, kPlate, 4);
}

// A length as a bar with its name; the bar ends in an arrow where it is too long to draw.
void ruler_line(const ImVec2& at, float bar_width, float length, const std::string& words) {
  ImDrawList& list = background();
  const float y = at.y + 7.5f;
  const bool cut = length > bar_width;
  const float end = at.x + std::clamp(length, 1.0f, bar_width);
  list.AddLine({at.x, y}, {end, y}, kInk, 2);
  list.AddLine({at.x, y - 4}, {at.x, y + 4}, kInk, 1);
  if (cut)
    list.AddTriangleFilled({end - 1, y - 4}, {end + 5, y}, {end - 1, y + 4}, kInk);
  else
    list.AddLine({end, y - 4}, {end, y + 4}, kInk, 1);
  text(small_font(), {at.x + bar_width + 12, at.y + 1}, kInk, words);
}

void ruler(const OverlayModel& model, const Area& image) {
  if (!(model.points_per_mm > 0) || image.width < 200 || image.height < 120) return;
  if (!(model.mean_free_path_mm > 0)) return;  // no medium, no length
  const std::string free_path = "mean free path " + length_text(model.mean_free_path_mm) + "  (RGB mean)";
  const std::string diffusion = "diffusion length " + length_text(model.diffusion_length_mm);
  const float words = std::max(text_width(small_font(), free_path), text_width(small_font(), diffusion));
  const auto points = [&](double mm) { return static_cast<float>(std::min(mm * model.points_per_mm, 1e6)); };
  const float longest = std::max(points(model.mean_free_path_mm), points(model.diffusion_length_mm));
  const float bar = std::clamp(std::ceil(longest), 24.0f, std::max(24.0f, image.width - words - 60));
  const float shown = std::min(bar, std::max(24.0f, 0.3f * image.width));
  const ImVec2 low(image.x + kMargin, image.y + image.height - kMargin - 40);
  plate(low, {shown + words + 32, 40});
  ruler_line({low.x + 10, low.y + 5}, shown, points(model.mean_free_path_mm), free_path);
  ruler_line({low.x + 10, low.y + 20}, shown, points(model.diffusion_length_mm), diffusion);
}

std::string legend_text(const LegendModel& legend, double value) {
  return legend.percent ? short_percent(value) : count_text(value);
}

void draw_legend(const LegendModel& legend, const Area& image) {
  constexpr int kSteps = 64;
  const float width = std::min(240.0f, image.width - 60);
  if (width < 100) return;
  const ImVec2 low(image.x + image.width - width - 34, image.y + kMargin);
  plate(low, {width + 24, 48});
  text(small_font(), {low.x + 12, low.y + 4}, kInk, legend.title);
  const ImVec2 bar(low.x + 12, low.y + 20);
  for (int i = 0; i < kSteps; ++i) {
    const auto levels = color_scale((i + 0.5) / kSteps);
    const float x0 = bar.x + width * static_cast<float>(i) / kSteps;
    const float x1 = bar.x + width * static_cast<float>(i + 1) / kSteps;
    background().AddRectFilled({x0, bar.y}, {x1, bar.y + 9}, IM_COL32(levels[0], levels[1], levels[2], 255));
  }
  float free_from = low.x;
  for (const double tick : legend_ticks(legend.low, legend.high)) {
    const float x = bar.x + width * static_cast<float>(log_place(tick, legend.low, legend.high));
    background().AddLine({x, bar.y + 9}, {x, bar.y + 12}, kInk);
    const std::string words = legend_text(legend, tick);
    const float half = 0.5f * text_width(small_font(), words);
    const float left = std::clamp(x - half, low.x + 4, low.x + width + 20 - 2 * half);
    if (left < free_from) continue;  // no room for it
    text(small_font(), {std::round(left), bar.y + 13}, kInk, words);
    free_from = left + 2 * half + 6;
  }
}

void title(const ImVec2& at, bool to_left, const std::string& words) {
  const float width = text_width(plain_font(), words) + 16;
  const ImVec2 low(to_left ? at.x - width : at.x, at.y);
  plate(low, {width, 22});
  text(plain_font(), {low.x + 8, low.y + 4}, kInk, words);
}

void titles(const UiModel& model, const Area& image) {
  const OverlayModel& overlay = model.overlay;
  const float top = image.y + kMargin + (overlay.legend ? 56 : 0);
  const float right = image.x + image.width - kMargin;
  const float room = 0.5f * image.width - 40;
  const std::string a = elided(plain_font(), "A  " + overlay.title_a, room);
  const std::string b = elided(plain_font(), "B  " + overlay.title_b, room);
  switch (model.view.comparison) {
    case CompareMode::none:
      break;
    case CompareMode::wipe:
      title({image.x + kMargin, top}, false, a);
      title({right, top}, true, b);
      break;
    case CompareMode::difference:
      title({image.x + kMargin, top}, false, elided(plain_font(), "|A − B|   " + a + "   " + b, 2 * room));
      break;
    case CompareMode::only_b:
      title({right, top}, true, b);
      break;
  }
}

// The line between A and B, which is dragged by its whole length.
void wipe_line(const Ui& ui, const UiModel& model, const Area& image) {
  if (model.view.comparison != CompareMode::wipe || model.overlay.selecting) return;
  const Area& film = model.overlay.film;
  const float x = std::clamp(film.x + model.view.wipe * film.width, image.x, image.x + image.width);
  const float y0 = std::max(film.y, image.y);
  const float y1 = std::min(film.y + film.height, image.y + image.height);
  if (y1 <= y0) return;
  begin_area("wipe", {x - kHandle, y0, 2 * kHandle, y1 - y0}, 0, {0, 0});
  ImGui::InvisibleButton("line", {2 * kHandle, y1 - y0});
  const bool lively = ImGui::IsItemActive() || ImGui::IsItemHovered();
  if (lively) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0 && film.width > 0) {
    const float place = std::clamp((ImGui::GetIO().MousePos.x - film.x) / film.width, 0.0f, 1.0f);
    ui.actions.commands.push_back({CommandKind::set_wipe, 0, static_cast<double>(place), {}, {}});
  }
  ImGui::End();
  ImDrawList& list = background();
  const ImU32 color = lively ? kAccent : kInk;
  list.AddLine({x, y0}, {x, y1}, IM_COL32(0, 0, 0, 120), 3);
  list.AddLine({x, y0}, {x, y1}, color, 1.4f);
  const float middle = 0.5f * (y0 + y1);
  list.AddCircleFilled({x, middle}, kHandle, kPlate, 24);
  list.AddCircle({x, middle}, kHandle, color, 24, 1.4f);
  list.AddTriangleFilled({x - 6, middle}, {x - 2, middle - 3.5f}, {x - 2, middle + 3.5f}, color);
  list.AddTriangleFilled({x + 6, middle}, {x + 2, middle + 3.5f}, {x + 2, middle - 3.5f}, color);
}

void outline(const Area& area) {
  ImDrawList& list = background();
  const ImVec2 low(std::round(area.x), std::round(area.y));
  const ImVec2 high(std::round(area.x + area.width), std::round(area.y + area.height));
  list.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32(0, 0, 0, 140), 0, 0, 3);
  list.AddRect(low, high, kAccent, 0, 0, 1);
}

PixelBox box_between(const OverlayModel& overlay, const ImVec2& from, const ImVec2& to) {
  const auto a = film_point(overlay, std::min(from.x, to.x), std::min(from.y, to.y));
  const auto b = film_point(overlay, std::max(from.x, to.x), std::max(from.y, to.y));
  constexpr double kEdge = 1e-3;  // of a pixel, which the drag must at least reach into
  const auto first = [](double place, int limit) {
    return static_cast<int>(std::clamp(std::floor(place + kEdge), 0.0, static_cast<double>(limit)));
  };
  const auto end = [](double place, int limit) {
    return static_cast<int>(std::clamp(std::ceil(place - kEdge), 0.0, static_cast<double>(limit)));
  };
  return {first(a[0], overlay.film_width), first(a[1], overlay.film_height), end(b[0], overlay.film_width),
          end(b[1], overlay.film_height)};
}

// While a rectangle is being chosen, the picture belongs to the interface.
void region_selection(const Ui& ui, const OverlayModel& overlay, const Area& image) {
  begin_area("select", image, IM_COL32(0, 0, 0, 60), {0, 0});
  ImGui::InvisibleButton("drag", {image.width, image.height});
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  const ImGuiIO& io = ImGui::GetIO();
  const PixelBox box = box_between(overlay, io.MouseClickedPos[0], io.MousePos);
  const bool some = box.x1 > box.x0 && box.y1 > box.y0;
  if (ImGui::IsItemActive() && some) {
    const Area area = window_area(overlay, box);
    ImGui::GetWindowDrawList()->AddRect({area.x, area.y}, {area.x + area.width, area.y + area.height},
                                        kAccent);
  }
  if (ImGui::IsItemDeactivated() && some)
    ui.actions.commands.push_back({CommandKind::set_region, 0, 0, box, {}});
  ImGui::End();
  const std::string words = "Drag a rectangle · Esc leaves";
  title({image.x + 0.5f * (image.width - text_width(plain_font(), words) - 16), image.y + kMargin}, false,
        words);
}

std::string reading(double value, double error) {
  return significant(value, 4) + " ± " + significant(error, 2);
}

void pixel_tooltip(const PixelReading& pixel, const Area& image) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!contains(image, mouse.x, mouse.y)) return;
  const std::array<std::string, 6> lines{
      std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + "   " + count_text(pixel.samples) + " spp",
      "R  " + reading(pixel.value.x, pixel.error.x),
      "G  " + reading(pixel.value.y, pixel.error.y),
      "B  " + reading(pixel.value.z, pixel.error.z),
      "± one standard error",
      significant(pixel.scatterings, 3) + " scatterings · " + length_text(pixel.length_mm)};
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, text_width(small_font(), line));
  const ImVec2 size(width + 16, 15 * static_cast<float>(lines.size()) + 8);
  ImVec2 low(mouse.x + 16, mouse.y + 14);
  if (low.x + size.x > image.x + image.width) low.x = mouse.x - 10 - size.x;
  if (low.y + size.y > image.y + image.height) low.y = mouse.y - 10 - size.y;
  low = {std::round(std::max(low.x, image.x)), std::round(std::max(low.y, image.y))};
  background().AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(18, 18, 18, 225), 4);
  for (std::size_t i = 0; i < lines.size(); ++i)
    text(small_font(), {low.x + 8, low.y + 5 + 15 * static_cast<float>(i)},
         i == 0 || i == 4 ? kDimColor : kInk, lines[i]);
}

}  // namespace

std::vector<double> legend_ticks(double low, double high) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-6));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-6));
  for (int decade = first; decade <= last; ++decade) ticks.push_back(std::pow(10.0, decade));
  if (ticks.size() < 2) return {low, high};
  return ticks;
}

void overlays(const Ui& ui, const UiModel& model, const Area& image) {
  const OverlayModel& overlay = model.overlay;
  background().PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
  if (overlay.region) outline(window_area(overlay, *overlay.region));
  ruler(overlay, image);
  if (overlay.legend) draw_legend(*overlay.legend, image);
  wipe_line(ui, model, image);
  titles(model, image);
  if (overlay.selecting) region_selection(ui, overlay, image);
  if (!overlay.busy.empty()) {
    const float width = text_width(plain_font(), overlay.busy) + 16;
    title({image.x + 0.5f * (image.width - width), image.y + image.height - kMargin - 22}, false,
          overlay.busy);
  }
  if (overlay.pixel_tooltip && model.statistics.pixel && !ImGui::GetIO().WantCaptureMouse)
    pixel_tooltip(*model.statistics.pixel, image);
  background().PopClipRect();
}

}  // namespace meander
