#include <cmath>

#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {

void camera_panel(const Ui& ui, const CameraModel& model) {
  constexpr std::array<std::string_view, 2> kProjections{"perspective", "orthographic"};
  const bool orthographic = model.camera.orthographic_height.has_value();
  const Row projection = begin_row("Projection", Effect::restart);
  if (const auto picked = segmented(projection, "projection", kProjections, orthographic ? 1 : 0))
    if ((*picked == 1) != orthographic) ui.command(CommandKind::orthographic, *picked);
  SliderSpec spec;
  spec.label = orthographic ? "View height" : "Field of view";
  spec.id = orthographic ? "##height" : "##fov";
  const double now = model.camera.orthographic_height.value_or(model.camera.vertical_fov);
  if (orthographic) {
    const double usual = model.original.orthographic_height.value_or(now);
    spec.map = {Spacing::logarithmic, 0.01 * usual, 100 * usual, nullptr};
    spec.reset = usual;
    spec.typed_low = 1e-6;
    spec.typed_high = 1e9;
    spec.text = significant(now, 4);
  } else {
    spec.map = {Spacing::linear, 5, 120, nullptr};
    spec.reset = model.original.vertical_fov;
    spec.typed_low = 0.1;
    spec.typed_high = 175;
    spec.text = significant(now, 3) + "°";
    spec.start = significant(now, 6);
    spec.tooltip = "The full vertical angle";
  }
  if (const auto changed = slider(ui, spec, now))
    ui.edit(edit_text(orthographic ? "camera.orthographic_height" : "camera.vertical_fov", *changed));
  if (const auto view = segmented(begin_wide_row(Effect::restart), "views", kCameraViewNames, -1))
    ui.command(CommandKind::camera_view, *view);
  const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
  if (text_button("Frame", "The whole object in view (F)", width)) ui.command(CommandKind::frame);
  ImGui::SameLine();
  if (text_button("Reset", "As the scene file has it (R)", width)) ui.command(CommandKind::reset_camera);
  ImGui::SameLine();
  if (text_button("Copy", "The camera as scene text (C)", width)) ui.command(CommandKind::copy_camera);
}

}  // namespace meander
