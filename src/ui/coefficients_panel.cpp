#include <imgui.h>

#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

struct Line {
  const char* name;
  const char* plain;  // the name as it is copied
  DVec3 value;
  const char* unit;
};

void draw_line(const Ui& ui, const Line& line) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  constexpr float kLine = 17;
  constexpr float kNameWidth = 98;
  constexpr float kUnitWidth = 30;
  if (ImGui::InvisibleButton(line.plain, {width, kLine})) {
    const std::string text = edit_text(line.plain, line.value);
    ui.command(CommandKind::copy_text, text);
  }
  if (ImGui::IsItemHovered())
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + kLine}, kFrameColor, kRounding);
  item_tooltip("Press to copy");
  draw_text(small_font(), {at.x, at.y + 3}, kDimColor, line.name);
  const float column = (width - kNameWidth - kUnitWidth) / 3;
  for (int c = 0; c < 3; ++c) {
    const std::string text = significant(line.value[c], 4);
    const float right = at.x + kNameWidth + column * static_cast<float>(c + 1);
    draw_text(small_font(), {std::round(right - text_width(small_font(), text)), at.y + 3}, kTextColor, text);
  }
  draw_text(small_font(), {at.x + width - kUnitWidth + 5, at.y + 3}, kFaintColor, line.unit);
}

}  // namespace

ShownCoefficients shown_coefficients(const MaterialModel& model) {
  const MaterialDescription& now = model.now;
  ShownCoefficients shown{};
  shown.sigma_t = now.sigma_s + now.sigma_a;
  shown.sigma_s_reduced = now.sigma_s * (1 - now.g);
  shown.mean_free_path = 1.0 / shown.sigma_t;
  shown.mean_free_path_reduced = 1.0 / (now.sigma_a + shown.sigma_s_reduced);
  shown.diffusion_length = now.diffusion_length * model.millimetres_per_unit;
  shown.optical_thickness = shown.sigma_t * (model.thickness * model.millimetres_per_unit);
  return shown;
}

void coefficients_panel(const Ui& ui, const MaterialModel& model) {
  if (model.names.empty()) {
    ImGui::TextDisabled("The scene has no translucent material.");
    return;
  }
  const ShownCoefficients shown = shown_coefficients(model);
  const MaterialDescription& now = model.now;
  const std::array<Line, 10> lines{{
      {"single-scatt. α", "single_scattering_albedo", now.albedo, ""},
      {"1 − α", "one_minus_albedo", 1.0 - now.albedo, ""},
      {"σₜ", "sigma_t", shown.sigma_t, "/mm"},
      {"σₛ", "sigma_s", now.sigma_s, "/mm"},
      {"σₐ", "sigma_a", now.sigma_a, "/mm"},
      {"σₛ′ = σₛ (1 − g)", "sigma_s_reduced", shown.sigma_s_reduced, "/mm"},
      {"mean free path", "mean_free_path_mm", shown.mean_free_path, "mm"},
      {"reduced m. f. p.", "mean_free_path_reduced_mm", shown.mean_free_path_reduced, "mm"},
      {"diffusion length", "diffusion_length_mm", shown.diffusion_length, "mm"},
      {"optical thickness", "optical_thickness", shown.optical_thickness, ""},
  }};
  for (const Line& line : lines) draw_line(ui, line);
  if (text_button("Copy all", "All of them as text")) {
    std::string text;
    for (const Line& line : lines) text += edit_text(line.plain, line.value) + '\n';
    ui.command(CommandKind::copy_text, text);
  }
}

}  // namespace meander
