#include "ui/draw.h"

#include <imgui_internal.h>

#include <algorithm>

#include "ui/bars.h"
#include "ui/dialogs.h"
#include "ui/overlays.h"
#include "ui/panels.h"
#include "ui/style.h"

namespace meander {
namespace {

// Holding any control is a gesture.
void report_gesture(const Ui& ui) {
  const ImGuiID now = ImGui::GetCurrentContext()->ActiveId;
  const ImGuiID before = ui.state.last_active;
  ui.actions.gesture_started = now != 0 && now != before;
  ui.actions.gesture_ended = before != 0 && now != before;
  ui.state.last_active = now;
}

// Escape closes the list, menu or picker on top: the keyboard is the interface's while one is open.
void close_popup_on_escape() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.OpenPopupStack.Size > 0 && !context.IO.WantTextInput &&
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
    ImGui::ClosePopupToLevel(context.OpenPopupStack.Size - 1, true);
}

void draw_section(const Ui& ui, PanelName name, const UiModel& model) {
  switch (name) {
    case PanelName::preset:
      return preset_panel(ui, model.material);
    case PanelName::material:
      return material_panel(ui, model.material);
    case PanelName::light:
      return light_panel(ui, model.light);
    case PanelName::camera:
      return camera_panel(ui, model.camera);
    case PanelName::render:
      return render_panel(ui, model.render);
    case PanelName::statistics:
      return statistics_panel(ui, model.statistics);
    case PanelName::coefficients:
      return coefficients_panel(ui, model.material);
  }
}

}  // namespace

UiActions draw_interface(const UiModel& model, UiState& state, const Layout& layout) {
  UiActions actions;
  const Ui ui{state, actions};
  close_popup_on_escape();
  if (!state.hidden) {
    toolbar(ui, model, layout.toolbar);
    if (layout.strip.height > 0) snapshot_strip(ui, model.snapshots, layout.strip);
    if (layout.sparkline.height > 0) sparkline(ui, model.statistics, layout.sparkline);
    status_line(ui, model, layout.status);
    side_panel(ui, model, layout.panel);
    overlays(ui, model, layout.image);
  }
  message_toasts(ui, model.messages, layout.image);
  browser_dialog(ui, model.browser, layout.window);
  if (state.help) help_overlay(ui, layout.window);
  report_gesture(ui);
  return actions;
}

UiActions draw_panel(PanelName name, const UiModel& model, UiState& state, const Area& window) {
  UiActions actions;
  const Ui ui{state, actions};
  Area area = window;
  area.width = std::max(area.width, kLeastPanel);
  begin_area("single panel", area, kPanelColor, {10, 0});
  bool open = true;
  std::string title(kPanelNames[static_cast<std::size_t>(name)]);
  title[0] = static_cast<char>(title[0] - 'a' + 'A');
  section(title.c_str(), open);
  draw_section(ui, name, model);
  ImGui::End();
  report_gesture(ui);
  return actions;
}

}  // namespace meander
