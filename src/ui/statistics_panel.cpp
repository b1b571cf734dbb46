#include <imgui.h>

#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr float kPlotHeight = 150;

void fact(std::string_view name, std::string_view value, ImU32 color = kTextColor) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  draw_text(small_font(), {at.x, at.y + 2}, kDimColor, name);
  const std::string text = elided(small_font(), value, width - 118);
  draw_text(small_font(), {at.x + 118, at.y + 2}, color, text);
  ImGui::Dummy({width, kSmallSize + 3});
}

void target_row(const Ui& ui, const StatisticsModel& model) {
  SliderSpec spec;
  spec.label = "Time to noise";
  spec.id = "##target_noise";
  spec.effect = Effect::none;
  spec.map = {Spacing::logarithmic, 0.05, 20, nullptr};
  spec.reset = 1;
  spec.typed_low = 0.001;
  spec.typed_high = 100;
  spec.text = short_percent(ui.state.target_noise);
  spec.start = significant(100 * ui.state.target_noise, 4);
  const auto seconds = seconds_to_noise(model, ui.state.target_noise);
  spec.aside = !seconds ? "–" : *seconds == 0 ? "reached" : "in " + duration_text(*seconds);
  spec.tooltip = "When the noise will be this low, by the −1/2 law";
  if (const auto target = slider(ui, spec, 100 * ui.state.target_noise))
    ui.state.target_noise = *target / 100;
}

void speed(const StatisticsModel& model) {
  fact("Samples per pixel", std::to_string(model.spp) + " in " + duration_text(model.seconds));
  fact("Noise",
       model.noise > 0 ? percent_text(model.noise) + (model.noise_reliable ? "" : ", unreliable") : "–",
       model.noise_reliable ? kTextColor : kWarnColor);
  fact("Walks",
       count_text(static_cast<double>(model.walks)) + ", " + count_text(model.walks_per_second) + " /s");
  fact("Steps", count_text(model.steps_per_second) + " /s");
  fact("Mean scatterings", significant(model.mean_scatterings, 3));
  fact("Leaked walks", count_text(static_cast<double>(model.leaked_walks)),
       model.leaked_walks > 0 ? kWarnColor : kTextColor);
  fact("Not finite", count_text(static_cast<double>(model.non_finite)),
       model.non_finite > 0 ? kErrorColor : kTextColor);
  fact("Estimator", model.estimator);
  if (!model.kernel.empty()) fact("Kernel", model.kernel);
}

void heading(const char* text) {
  ImGui::Dummy({1, 2});
  draw_text(plain_font(), ImGui::GetCursorScreenPos(), kTextColor, text);
  ImGui::Dummy({1, kTextSize + 2});
}

void channel_facts(const DVec3& value, const DVec3& error) {
  constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
  for (int c = 0; c < 3; ++c)
    fact(kNames[static_cast<std::size_t>(c)], significant(value[c], 4) + " ± " + significant(error[c], 2));
}

void rectangle_facts(const Ui& ui, const StatisticsModel& model) {
  heading("Rectangle (mean ± 95 %)");
  if (!model.rectangle) {
    draw_text(small_font(), ImGui::GetCursorScreenPos(), kDimColor, "Press X and drag one in the picture.");
    ImGui::Dummy({1, kSmallSize + 3});
    return;
  }
  const PixelBox& box = model.rectangle->box;
  fact("Pixels", std::to_string(box.x1 - box.x0) + " × " + std::to_string(box.y1 - box.y0) + " at " +
                     std::to_string(box.x0) + ", " + std::to_string(box.y0));
  channel_facts(model.rectangle->mean, model.rectangle->interval);
  if (text_button("Clear", "Forget the rectangle")) ui.command(CommandKind::clear_region);
}

void pixel_facts(const StatisticsModel& model) {
  if (!model.pixel) return;
  heading("Pixel (± standard error)");
  fact("Place", std::to_string(model.pixel->x) + ", " + std::to_string(model.pixel->y));
  channel_facts(model.pixel->value, model.pixel->error);
  fact("Scatterings", significant(model.pixel->scatterings, 3));
  fact("Walk length", length_text(model.pixel->length_mm));
}

}  // namespace

void statistics_panel(const Ui& ui, const StatisticsModel& model) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({width, kPlotHeight});
  noise_plot(model, ui.state.target_noise, {at, {at.x + width, at.y + kPlotHeight}});
  target_row(ui, model);
  speed(model);
  rectangle_facts(ui, model);
  pixel_facts(model);
}

}  // namespace meander
