#include "ui/plot.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/interface.h"
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

bool usable(const PlotPoint& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); }

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
  }

  void draw() {
    grid();
    list_.PushClipRect(low_, high_);
    guide();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) curve(plot_.series[i], i);
    list_.PopClipRect();
    list_.AddRect(low_, high_, kInk);
    text(strong_font(), {low_.x, 8}, kInk, plot_.title);
    text(plain_font(), {low_.x, 32}, kInk, plot_.y_label);
    const float width = width_of(plain_font(), plot_.x_label);
    text(plain_font(), {0.5f * (low_.x + high_.x - width), high_.y + 24}, kInk, plot_.x_label);
    if (empty_)
      text(plain_font(), {0.5f * (low_.x + high_.x) - 22, 0.5f * (low_.y + high_.y)}, kInk, "no data");
    legend();
  }

 private:
  static float size_of(const ImFont* font) { return kZoom * font->FontSize * font->Scale; }
  static float width_of(const ImFont* font, const std::string& words) {
    return font->CalcTextSizeA(size_of(font), 1e6f, 0, words.c_str()).x;
  }
  void text(ImFont* font, ImVec2 at, ImU32 color, const std::string& words) {
    list_.AddText(font, size_of(font), at, color, words.c_str());
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

  void guide() {
    if (empty_ || plot_.guide_slope == 0 || plot_.series.empty()) return;
    const auto& points = plot_.series.front().points;
    const auto last = std::find_if(points.rbegin(), points.rend(), usable);
    if (last == points.rend()) return;
    const auto on_guide = [&](double x) { return at(x, last->y * std::pow(x / last->x, plot_.guide_slope)); };
    const ImVec2 from = on_guide(std::pow(10, x_.low));
    const ImVec2 to = on_guide(std::pow(10, x_.high));
    dashes(from, to, kGuide, 1.2f);
    // Named where a third of the line that is in sight is left behind.
    const float top = std::clamp(from.y, low_.y, high_.y);
    const float share = from.y != to.y ? (top - from.y) / (to.y - from.y) : 0;
    const float place = share + 0.25f * (1 - share);
    const std::string words = plot_.guide_slope == -0.5 ? "slope −1/2" : "slope";
    const float left = from.x + place * (to.x - from.x) - width_of(small_font(), words) - 8;
    text(small_font(), {left, from.y + place * (to.y - from.y) + 1}, kGuideText, words);
  }

  void curve(const PlotSeries& series, std::size_t number) {
    const ImU32 color = kColors[number % kColors.size()];
    const PlotPoint* before = nullptr;
    for (const PlotPoint& p : series.points) {
      if (!usable(p)) continue;
      const ImVec2 here = at(p.x, p.y);
      if (p.y_low > 0 && p.y_high > p.y_low && std::isfinite(p.y_high)) {
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

  void legend() {
    float widest = 0;
    for (const PlotSeries& series : plot_.series)
      widest = std::max(widest, width_of(plain_font(), series.name));
    if (plot_.series.empty()) return;
    constexpr float kLine = 18;
    const ImVec2 corner{high_.x - widest - 58, low_.y + 8};
    const float bottom = corner.y + kLine * static_cast<float>(plot_.series.size()) + 6;
    list_.AddRectFilled({corner.x - 8, corner.y - 2}, {high_.x - 8, bottom}, IM_COL32(255, 255, 255, 230));
    list_.AddRect({corner.x - 8, corner.y - 2}, {high_.x - 8, bottom}, kGrid);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      const float y = corner.y + kLine * static_cast<float>(i) + 11;
      const ImU32 color = kColors[i % kColors.size()];
      if (plot_.series[i].measured) {
        list_.AddLine({corner.x, y}, {corner.x + 30, y}, color, 1.8f);
        mark({corner.x + 15, y}, color, i);
      } else {
        dashes({corner.x, y}, {corner.x + 30, y}, color, 1.4f);
      }
      text(plain_font(), {corner.x + 38, y - 8}, kInk, plot_.series[i].name);
    }
  }

  const Plot& plot_;
  ImDrawList& list_;
  ImVec2 low_;
  ImVec2 high_;
  PlotAxis x_;
  PlotAxis y_;
  bool empty_ = false;
};

}  // namespace

void draw_plot(const Plot& plot, const FrameShape& frame) { Drawing(plot, frame).draw(); }

}  // namespace meander
