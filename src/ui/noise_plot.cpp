#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "film/plan.h"
#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

// Decimal logarithms of both axes over a box of the window.
struct Axes {
  ImVec2 low;  // of the window: left, top
  ImVec2 high;
  double x0, x1, y0, y1;

  [[nodiscard]] ImVec2 at(double seconds, double noise) const {
    const double x = (std::log10(seconds) - x0) / (x1 - x0);
    const double y = (std::log10(noise) - y0) / (y1 - y0);
    return {low.x + static_cast<float>(x) * (high.x - low.x),
            high.y - static_cast<float>(y) * (high.y - low.y)};
  }
};

bool usable(const NoiseSample& sample) { return sample.seconds > 0 && sample.noise > 0; }

// Whole decades about everything there is to show.
Axes axes_of(const StatisticsModel& model, double target, const std::pair<ImVec2, ImVec2>& box) {
  double first = 0.1, last = 1, least = target, most = 1;
  bool any = false;
  for (const NoiseSample& sample : model.history) {
    if (!usable(sample)) continue;
    first = any ? std::min(first, sample.seconds) : sample.seconds;
    last = any ? std::max(last, sample.seconds) : sample.seconds;
    least = std::min(least, sample.noise);
    most = any ? std::max(most, sample.noise) : sample.noise;
    any = true;
  }
  if (const auto more = seconds_to_noise(model, target))
    last = std::max(last, std::min(model.seconds + *more, 1e3 * std::max(last, 1e-3)));
  Axes axes{box.first,
            box.second,
            std::floor(std::log10(first)),
            std::ceil(std::log10(1.05 * last)),
            std::floor(std::log10(0.95 * least)),
            std::ceil(std::log10(most))};
  if (axes.x1 <= axes.x0) axes.x1 = axes.x0 + 1;
  if (axes.y1 <= axes.y0) axes.y1 = axes.y0 + 1;
  return axes;
}

std::string decade_text(int exponent) {
  if (exponent >= 4) return "10⁴";
  return significant(std::pow(10.0, exponent), 1);
}

void draw_grid(const Axes& axes, ImDrawList& list) {
  constexpr ImU32 kMajor = IM_COL32(66, 66, 66, 255);
  constexpr ImU32 kMinor = IM_COL32(42, 42, 42, 255);
  const bool minor = axes.x1 - axes.x0 <= 4;
  for (int decade = static_cast<int>(axes.x0); decade <= static_cast<int>(axes.x1); ++decade) {
    const float x = std::round(axes.at(std::pow(10.0, decade), 1).x);
    list.AddLine({x, axes.low.y}, {x, axes.high.y}, kMajor);
    const std::string text = decade_text(decade) + (decade == static_cast<int>(axes.x1) ? " s" : "");
    const float width = text_width(small_font(), text);
    const float left = std::clamp(x - 0.5f * width, axes.low.x - 8, axes.high.x - width + 4);
    draw_text(small_font(), {std::round(left), axes.high.y + 2}, kDimColor, text);
    for (int k = 2; minor && k < 10 && decade < static_cast<int>(axes.x1); ++k) {
      const float between = std::round(axes.at(k * std::pow(10.0, decade), 1).x);
      list.AddLine({between, axes.low.y}, {between, axes.high.y}, kMinor);
    }
  }
  for (int decade = static_cast<int>(axes.y0); decade <= static_cast<int>(axes.y1); ++decade) {
    const float y = std::round(axes.at(1, std::pow(10.0, decade)).y);
    list.AddLine({axes.low.x, y}, {axes.high.x, y}, kMajor);
    const std::string text = decade_text(decade + 2) + " %";
    const float top = std::clamp(y - 7, axes.low.y - 3, axes.high.y - 10);
    draw_text(small_font(), {axes.low.x - 5 - text_width(small_font(), text), top}, kDimColor, text);
  }
}

void draw_history(const Axes& axes, const StatisticsModel& model, ImDrawList& list, float thickness) {
  for (const NoiseSample& sample : model.history)
    if (usable(sample)) list.PathLineTo(axes.at(sample.seconds, sample.noise));
  list.PathStroke(kAccent, 0, thickness);
}

}  // namespace

std::optional<double> seconds_to_noise(const StatisticsModel& model, double target) {
  return seconds_to_error({model.spp, model.seconds, model.noise}, target);
}

void noise_plot(const StatisticsModel& model, double target, const std::pair<ImVec2, ImVec2>& box) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(box.first, box.second, IM_COL32(32, 32, 32, 255), kRounding);
  const std::pair<ImVec2, ImVec2> inner{{box.first.x + 44, box.first.y + 8},
                                        {box.second.x - 10, box.second.y - 19}};
  const Axes axes = axes_of(model, target, inner);
  draw_grid(axes, list);
  list.PushClipRect({axes.low.x, axes.low.y}, {axes.high.x + 1, axes.high.y + 1}, true);
  const float goal = axes.at(1, target).y;
  list.AddLine({axes.low.x, goal}, {axes.high.x, goal}, kWarnColor);
  if (model.noise > 0 && model.seconds > 0) {
    const double end = std::pow(10.0, axes.x1);
    const double begin = std::pow(10.0, axes.x0);
    const auto law = [&](double seconds) { return model.noise * std::sqrt(model.seconds / seconds); };
    list.AddLine(axes.at(begin, law(begin)), axes.at(end, law(end)), IM_COL32(150, 150, 150, 150));
  }
  draw_history(axes, model, list, 1.8f);
  if (model.noise > 0 && model.seconds > 0)
    list.AddCircleFilled(axes.at(model.seconds, model.noise), 3, kAccent, 16);
  list.PopClipRect();
  const char* law = "slope −1/2";
  const float width = text_width(small_font(), law);
  draw_text(small_font(), {axes.high.x - width - 4, axes.low.y + 2}, kDimColor, law);
  list.AddLine({axes.high.x - width - 24, axes.low.y + 9}, {axes.high.x - width - 8, axes.low.y + 9},
               IM_COL32(150, 150, 150, 150));
}

void noise_sparkline(const StatisticsModel& model, const std::pair<ImVec2, ImVec2>& box) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  double first = 0, last = 0, least = 0, most = 0;
  for (const NoiseSample& sample : model.history) {
    if (!usable(sample)) continue;
    first = first > 0 ? std::min(first, sample.seconds) : sample.seconds;
    last = std::max(last, sample.seconds);
    least = least > 0 ? std::min(least, sample.noise) : sample.noise;
    most = std::max(most, sample.noise);
  }
  list.AddLine({box.first.x, box.second.y}, box.second, IM_COL32(60, 60, 60, 255));
  if (!(last > first) || !(most > least)) return;
  const Axes axes{{box.first.x, box.first.y + 2},
                  {box.second.x, box.second.y - 2},
                  std::log10(first),
                  std::log10(last),
                  std::log10(least),
                  std::log10(most)};
  draw_history(axes, model, list, 1.3f);
}

}  // namespace meander
