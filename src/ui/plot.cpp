#include "ui/plot.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "ui/interface.h"
#include "ui/plot_layout.h"
#include "ui/style.h"

namespace meander {
namespace {

constexpr ImU32 kPaper = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kInk = IM_COL32(32, 32, 32, 255);
constexpr ImU32 kGrid = IM_COL32(212, 212, 212, 255);
constexpr ImU32 kMinorGrid = IM_COL32(238, 238, 238, 255);
constexpr ImU32 kGuideText = IM_COL32(110, 110, 110, 255);
constexpr ImU32 kGuide = IM_COL32(150, 150, 150, 255);
// Okabe and Ito 2008, "Color Universal Design": told apart by every kind of colour vision.
constexpr std::array<ImU32, 6> kColors{IM_COL32(0, 114, 178, 255),  IM_COL32(213, 94, 0, 255),
                                       IM_COL32(0, 158, 115, 255),  IM_COL32(204, 121, 167, 255),
                                       IM_COL32(86, 180, 233, 255), IM_COL32(230, 159, 0, 255)};
constexpr float kBar = 1.6f;
constexpr float kMark = 3.2f;
constexpr float kDash = 6;
constexpr float kZoom = 1.1f;  // of the interface's text
constexpr float kLegendLine = 18;
constexpr float kLegendKey = 38;     // the line before a name
constexpr std::size_t kTallest = 4;  // names in a column of the legend
constexpr float kMargin = 8;         // of the legend from the axes
constexpr float kClear = kMark + 2;  // of words from curves

bool usable(const PlotPoint& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); }

bool has_bar(const PlotPoint& p) { return p.y_low > 0 && p.y_high > p.y_low && std::isfinite(p.y_high); }

class Drawing {
 public:
  Drawing(const Plot& plot, const FrameShape& frame)
      : plot_(plot),
        list_(*ImGui::GetBackgroundDrawList()),
        low_(64, 54),
        high_(frame.width() - 22, frame.height() - 50) {
    list_.AddRectFilled({0, 0}, {frame.width(), frame.height()}, kPaper);
    std::vector<double> xs;
    std::vector<double> ys;
    for (const PlotSeries& series : plot.series)
      for (const PlotPoint& p : series.points) {
        if (!usable(p)) continue;
        xs.push_back(p.x);
        ys.insert(ys.end(), {p.y, p.y_low, p.y_high});
      }
    empty_ = xs.empty();
    x_ = plot_axis(xs);
    y_ = plot_axis(ys);
    place_legend(ys);
  }

  void draw() {
    grid();
    list_.PushClipRect(low_, high_);
    guide();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) curve(plot_.series[i], style_of(i));
    list_.PopClipRect();
    list_.AddRect(low_, high_, kInk);
    text(strong_font(), {low_.x, 8}, kInk, plot_.title);
    text(plain_font(), {low_.x, 32}, kInk, plot_.y_label);
    const float width = width_of(plain_font(), plot_.x_label);
    text(plain_font(), {0.5f * (low_.x + high_.x - width), high_.y + 24}, kInk, plot_.x_label);
    if (empty_)
      text(plain_font(), {0.5f * (low_.x + high_.x) - 22, 0.5f * (low_.y + high_.y)}, kInk, "no data");
    legend();
    name_guide();
  }

 private:
  static float size_of(const ImFont* font) { return kZoom * font->FontSize * font->Scale; }
  static float width_of(const ImFont* font, const std::string& words) {
    return font->CalcTextSizeA(size_of(font), 1e6f, 0, words.c_str()).x;
  }
  void text(ImFont* font, ImVec2 at, ImU32 color, const std::string& words) {
    list_.AddText(font, size_of(font), at, color, words.c_str());
  }

  // The number of a series' colour and mark.
  [[nodiscard]] std::size_t style_of(std::size_t i) const {
    const auto end = plot_.series.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto measured =
        std::count_if(plot_.series.begin(), end, [](auto& series) { return series.measured; });
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(measured, 1)) - 1;
  }

  [[nodiscard]] ImVec2 at(double x, double y) const {
    const double across = (std::log10(x) - x_.low) / (x_.high - x_.low);
    const double up = (std::log10(y) - y_.low) / (y_.high - y_.low);
    return {low_.x + static_cast<float>(across) * (high_.x - low_.x),
            high_.y - static_cast<float>(up) * (high_.y - low_.y)};
  }

  void grid() {
    const double middle_x = std::pow(10, 0.5 * (x_.low + x_.high));
    const double middle_y = std::pow(10, 0.5 * (y_.low + y_.high));
    const auto line = [&](ImVec2 from, ImVec2 to, ImU32 color) { list_.AddLine(from, to, color); };
    for (const double x : x_.minor) {
      const float left = at(x, middle_y).x;
      line({left, low_.y}, {left, high_.y}, kMinorGrid);
      line({left, high_.y - 3}, {left, high_.y}, kInk);
    }
    for (const double y : y_.minor) {
      const float top = at(middle_x, y).y;
      line({low_.x, top}, {high_.x, top}, kMinorGrid);
      line({low_.x, top}, {low_.x + 3, top}, kInk);
    }
    for (const double x : x_.labelled) {
      const float left = at(x, middle_y).x;
      line({left, low_.y}, {left, high_.y}, kGrid);
      const std::string words = seconds_label(x);
      text(plain_font(), {left - 0.5f * width_of(plain_font(), words), high_.y + 5}, kInk, words);
    }
    for (const double y : y_.labelled) {
      const float top = at(middle_x, y).y;
      line({low_.x, top}, {high_.x, top}, kGrid);
      const std::string words = percent_label(y);
      text(plain_font(), {low_.x - 7 - width_of(plain_font(), words), top - 8}, kInk, words);
    }
  }

  void dashes(ImVec2 from, ImVec2 to, ImU32 color, float thickness) {
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0)) return;
    const ImVec2 step{(to.x - from.x) / length, (to.y - from.y) / length};
    for (float s = 0; s < length; s += 2 * kDash) {
      const float e = std::min(s + kDash, length);
      list_.AddLine({from.x + s * step.x, from.y + s * step.y}, {from.x + e * step.x, from.y + e * step.y},
                    color, thickness);
    }
  }

  // The part of the guide that is in sight, from the left; nothing where there is none.
  [[nodiscard]] std::optional<PlotBox> guide_line() const {
    if (empty_ || plot_.guide_slope == 0 || plot_.series.empty()) return std::nullopt;
    const auto& points = plot_.series.front().points;
    const auto last = std::find_if(points.rbegin(), points.rend(), usable);
    if (last == points.rend()) return std::nullopt;
    const auto on_guide = [&](double x) { return at(x, last->y * std::pow(x / last->x, plot_.guide_slope)); };
    const ImVec2 from = on_guide(std::pow(10, x_.low));
    const ImVec2 to = on_guide(std::pow(10, x_.high));
    if (from.y == to.y) return PlotBox{from, to};
    const auto in_sight = [&](ImVec2 end) {
      const float y = std::clamp(end.y, low_.y, high_.y);
      return ImVec2(from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x), y);
    };
    return PlotBox{in_sight(from), in_sight(to)};
  }

  void guide() {
    if (const auto line = guide_line()) dashes(line->low, line->high, kGuide, 1.2f);
  }

  // Where there is room for its name.
  void name_guide() {
    const auto line = guide_line();
    if (!line) return;
    const std::string words = plot_.guide_slope == -0.5 ? "slope −1/2" : "slope";
    const ImVec2 size{width_of(small_font(), words), size_of(small_font())};
    PlotClutter all = clutter();
    all.add_line(line->low, line->high);
    all.add_box(legend_);
    const auto places = places_beside({low_, high_}, size, line->low, line->high);
    const auto clear = std::ranges::find_if(
        places, [&](const PlotBox& place) { return all.covered(place, kClear - 1) == 0; });
    if (clear != places.end()) text(small_font(), clear->low, kGuideText, words);
  }

  // The curves and their bars.
  [[nodiscard]] PlotClutter clutter() const {
    PlotClutter curves;
    for (const PlotSeries& series : plot_.series) {
      const PlotPoint* before = nullptr;
      for (const PlotPoint& p : series.points) {
        if (!usable(p)) continue;
        const ImVec2 here = at(p.x, p.y);
        if (has_bar(p)) curves.add_line(at(p.x, p.y_high), at(p.x, p.y_low));
        curves.add_line(before ? at(before->x, before->y) : here, here);
        before = &p;
      }
    }
    return curves;
  }

  void curve(const PlotSeries& series, std::size_t number) {
    const ImU32 color = kColors[number % kColors.size()];
    const PlotPoint* before = nullptr;
    for (const PlotPoint& p : series.points) {
      if (!usable(p)) continue;
      const ImVec2 here = at(p.x, p.y);
      if (has_bar(p)) {
        const float top = at(p.x, p.y_high).y;
        const float bottom = at(p.x, p.y_low).y;
        list_.AddLine({here.x, top}, {here.x, bottom}, color, kBar);
        for (const float y : {top, bottom}) list_.AddLine({here.x - 3, y}, {here.x + 3, y}, color, kBar);
      }
      if (before && series.measured) list_.AddLine(at(before->x, before->y), here, color, 1.8f);
      if (before && !series.measured) dashes(at(before->x, before->y), here, color, 1.4f);
      if (series.measured) mark(here, color, number);
      before = &p;
    }
  }

  // A shape of its own for each colour.
  void mark(ImVec2 p, ImU32 color, std::size_t number) {
    const float r = kMark;
    switch (number % 4) {
      case 0:
        return list_.AddCircleFilled(p, r, color);
      case 1:
        return list_.AddRectFilled({p.x - r, p.y - r}, {p.x + r, p.y + r}, color);
      case 2:
        return list_.AddTriangleFilled({p.x - r, p.y + r}, {p.x, p.y - 1.2f * r}, {p.x + r, p.y + r}, color);
      default:
        return list_.AddQuadFilled({p.x - 1.3f * r, p.y}, {p.x, p.y - 1.3f * r}, {p.x + 1.3f * r, p.y},
                                   {p.x, p.y + 1.3f * r}, color);
    }
  }

  [[nodiscard]] float column_width() const {
    float widest = 0;
    for (const PlotSeries& series : plot_.series)
      widest = std::max(widest, width_of(plain_font(), series.name));
    return widest + kLegendKey + 16;
  }

  [[nodiscard]] ImVec2 legend_size() const {
    const std::size_t count = plot_.series.size();
    const std::size_t columns = (count + kTallest - 1) / kTallest;
    return {static_cast<float>(columns) * column_width(),
            static_cast<float>(std::min(count, kTallest)) * kLegendLine + 8};
  }

  // Where it covers no curve, and as little of the guide as can be; room is made above where there is none.
  void place_legend(std::vector<double> ys) {
    const ImVec2 size = legend_size();
    const auto places = places_at_edges({low_, high_}, size, kMargin);
    if (plot_.series.empty()) return;
    legend_ = {{low_.x + kMargin, low_.y + kMargin}, {low_.x + kMargin + size.x, low_.y + kMargin + size.y}};
    if (best_place(places) || places.empty()) return;
    const float share = (size.y + 2 * kMargin + kClear) / (high_.y - low_.y);
    ys.push_back(std::pow(10, y_.low + (y_.high - y_.low) / std::max(1 - share, 0.3f)));
    y_ = plot_axis(ys);
    best_place(places);
  }

  // Takes it, and says whether it covers no curve.
  bool best_place(const std::vector<PlotBox>& places) {
    constexpr int kCurve = 1000;  // dots of the guide, which one of a curve is worth
    const PlotClutter curves = clutter();
    PlotClutter guide;
    if (const auto line = guide_line()) guide.add_line(line->low, line->high);
    int least = std::numeric_limits<int>::max();
    for (const PlotBox& place : places) {
      const int cost = kCurve * curves.covered(place, kClear) + guide.covered(place, 0);
      if (cost >= least) continue;
      least = cost;
      legend_ = place;
    }
    return least < kCurve;
  }

  void legend() {
    if (plot_.series.empty()) return;
    list_.AddRectFilled(legend_.low, legend_.high, IM_COL32(255, 255, 255, 230));
    list_.AddRect(legend_.low, legend_.high, kGrid);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      const float x = legend_.low.x + 8 + static_cast<float>(i / kTallest) * column_width();
      const float y = legend_.low.y + kLegendLine * static_cast<float>(i % kTallest) + 13;
      const std::size_t style = style_of(i);
      const ImU32 color = kColors[style % kColors.size()];
      if (plot_.series[i].measured) {
        list_.AddLine({x, y}, {x + 30, y}, color, 1.8f);
        mark({x + 15, y}, color, style);
      } else {
        dashes({x, y}, {x + 30, y}, color, 1.4f);
      }
      text(plain_font(), {x + kLegendKey, y - 8}, kInk, plot_.series[i].name);
    }
  }

  const Plot& plot_;
  ImDrawList& list_;
  ImVec2 low_;
  ImVec2 high_;
  PlotAxis x_;
  PlotAxis y_;
  PlotBox legend_{};
  bool empty_ = false;
};

}  // namespace

void draw_plot(const Plot& plot, const FrameShape& frame) { Drawing(plot, frame).draw(); }

}  // namespace meander
