#include "ui/bars.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr float kButton = 26;
constexpr std::array<std::string_view, 6> kRendererTitles{"Cycles",  "Arnold",    "RenderMan",
                                                          "OpenPBR", "Mitsuba 3", "pbrt-v4"};

void gap(float width) {
  ImGui::SameLine(0, 0);
  ImGui::Dummy({width, 1});
  ImGui::SameLine(0, 0);
}

void divider() {
  gap(5);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y + 4}, {at.x, at.y + 20}, IM_COL32(64, 64, 64, 255));
  gap(6);
}

std::string title_of(const std::string& renderer) {
  const auto plain = [](std::string_view name) {
    std::string text;
    for (const char c : name)
      if (c != ' ' && c != '-') text += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return text;
  };
  for (const std::string_view title : kRendererTitles)
    if (plain(title).starts_with(plain(renderer))) return std::string(title);
  return renderer;
}

bool begin_menu(const char* id) {
  drop_from_last_item({220, 150});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(10, 7));
  const bool open = ImGui::BeginPopup(id);
  if (!open) ImGui::PopStyleVar();
  return open;
}

void end_menu() {
  ImGui::EndPopup();
  ImGui::PopStyleVar();
}

void copy_menu(const Ui& ui, const ToolbarModel& model) {
  if (icon_button("copy", Icon::copy, "Copy the look as another renderer's material"))
    ImGui::OpenPopup("copy as");
  if (!begin_menu("copy as")) return;
  ImGui::TextDisabled("Copy as");
  for (std::size_t i = 0; i < model.renderers.size(); ++i)
    if (ImGui::MenuItem(title_of(model.renderers[i]).c_str()))
      ui.command(CommandKind::copy_as, static_cast<std::int64_t>(i));
  end_menu();
}

void save_menu(const Ui& ui, const ToolbarModel& model) {
  if (icon_button("save", Icon::save, "Save: scene, EXR, PNG", {})) ImGui::OpenPopup("save as");
  if (model.modified) {  // a dot at the corner
    const ImVec2 corner(ImGui::GetItemRectMax().x - 4, ImGui::GetItemRectMin().y + 4);
    ImGui::GetWindowDrawList()->AddCircleFilled(corner, 2.5f, kAccent, 12);
  }
  if (!begin_menu("save as")) return;
  if (ImGui::MenuItem("Save the scene", "Ctrl + S")) ui.command(CommandKind::save);
  if (ImGui::MenuItem("Save the scene as …", "Ctrl + Shift + S")) ui.command(CommandKind::save_browser);
  if (ImGui::MenuItem("Save the picture …", "Ctrl + E")) ui.command(CommandKind::save_picture_browser);
  end_menu();
}

void file_buttons(const Ui& ui, const ToolbarModel& model) {
  if (icon_button("open", Icon::open, "Open a scene, mesh, environment or picture (Ctrl + O)"))
    ui.command(CommandKind::open_browser);
  gap(2);
  save_menu(ui, model);
  gap(2);
  copy_menu(ui, model);
  divider();
  if (icon_button("undo", Icon::undo, "Undo (Ctrl + Z)", {model.can_undo})) ui.command(CommandKind::undo);
  gap(2);
  if (icon_button("redo", Icon::redo, "Redo (Ctrl + Shift + Z)", {model.can_redo}))
    ui.command(CommandKind::redo);
  divider();
}

void picture_buttons(const Ui& ui, const UiModel& model) {
  if (icon_button("snapshot", Icon::camera, "Take a snapshot (K)")) ui.command(CommandKind::snapshot);
  gap(2);
  const bool wiping = model.view.comparison == CompareMode::wipe;
  if (icon_button("wipe", Icon::compare, "Compare A and B by a wipe (W); D shows their difference",
                  {!model.snapshots.items.empty(), wiping}))
    ui.command(CommandKind::wipe);
  gap(2);
  if (icon_button("region", Icon::region, "Drag a rectangle: statistics, render only this (X)",
                  {true, model.overlay.selecting}))
    ui.command(CommandKind::select_region);
  divider();
}

void view_choice(const Ui& ui, const ViewModel& model) {
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 2);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const Row row{at, {at.x + 96, at.y + kRowHeight}, at};
  const std::vector<std::string_view> names(model.names.begin(), model.names.end());
  if (const auto picked = choice(row, "##view", names, model.view)) ui.command(CommandKind::view, *picked);
  item_tooltip("What is shown (1 … 8)");
  ImGui::SetCursorScreenPos({at.x + 102, at.y});
}

void exposure_slider(const Ui& ui, const ViewModel& model) {
  constexpr std::array<Tick, 1> kZero{{{0, ""}}};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  SliderSpec spec;
  spec.id = "##exposure";
  spec.map = {Spacing::linear, -8, 8, nullptr};
  spec.ticks = kZero;
  spec.reset = model.original_exposure;
  spec.typed_low = -50;
  spec.typed_high = 50;
  spec.text = signed_text(model.exposure, 2) + " EV";
  spec.start = significant(model.exposure, 4);
  spec.origin = 0;
  spec.tooltip = "Exposure in stops (E, Shift + E); instant";
  if (const auto exposure = bare_slider(ui, spec, model.exposure, {at, {at.x + 104, at.y + kRowHeight}}))
    ui.edit(edit_text("display.exposure", *exposure));
  const ImVec2 next(at.x + 110, at.y);
  const Row row{next, {next.x + 96, next.y + kRowHeight}, next};
  constexpr std::array<std::string_view, 2> kTones{"sRGB", "filmic"};
  if (const auto tone = segmented(row, "tone", kTones, model.tone == Tone::filmic ? 1 : 0))
    ui.edit(edit_text("display.tone", *tone == 1 ? std::string_view("filmic") : std::string_view("srgb")));
  const float end = row.high.x + 11;
  ImGui::GetWindowDrawList()->AddLine({end - 6, at.y + 2}, {end - 6, at.y + 18}, IM_COL32(64, 64, 64, 255));
  ImGui::SetCursorScreenPos({end, at.y - 2});
}

struct WindowLook {
  ImU32 color;
  ImVec2 padding;
};

void begin_window(const char* name, const Area& area, const WindowLook& look, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, look.padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, look.color);
  ImGui::Begin(name, nullptr,
               flags | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollWithMouse |
                   ImGuiWindowFlags_NoNav);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

std::string pad(const std::string& text) { return text.empty() ? text : " · " + text; }

}  // namespace

void begin_area(const char* name, const Area& area, ImU32 color, const ImVec2& padding) {
  begin_window(name, area, {color, padding}, ImGuiWindowFlags_NoBringToFrontOnFocus);
}

void begin_dialog(const char* name, const Area& area, const ImVec2& padding) {
  begin_window(name, area, {kDialogColor, padding}, ImGuiWindowFlags_None);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 high(area.x + area.width, area.y + area.height);
  list.PushClipRect({area.x, area.y}, high);
  list.AddRect({area.x, area.y}, high, IM_COL32(78, 78, 78, 255));
  list.PopClipRect();
}

void toolbar(const Ui& ui, const UiModel& model, const Area& area) {
  begin_area("toolbar", area, kBarColor, {8, 7});
  file_buttons(ui, model.toolbar);
  picture_buttons(ui, model);
  view_choice(ui, model.view);
  exposure_slider(ui, model.view);
  if (icon_button("pause", model.toolbar.paused ? Icon::play : Icon::pause,
                  model.toolbar.paused ? "Go on (Space)" : "Pause (Space)", {true, model.toolbar.paused}))
    ui.command(CommandKind::pause);
  ImGui::SameLine(0, 10);
  const float from = ImGui::GetCursorScreenPos().x;
  const float help_at = area.x + area.width - kButton - 8;
  const std::string name = model.toolbar.scene_name + (model.toolbar.modified ? " •" : "");
  const float room = help_at - 10 - from;
  if (room > 40) {
    const std::string shown = elided(plain_font(), name, room);
    draw_text(plain_font(), {help_at - 10 - text_width(plain_font(), shown), area.y + 12}, kDimColor, shown);
  }
  ImGui::SetCursorScreenPos({help_at, area.y + 7});
  if (icon_button("help", Icon::help, "Keys (H or ?)", {true, ui.state.help})) ui.command(CommandKind::help);
  ImGui::GetWindowDrawList()->AddLine({area.x, area.y + area.height - 1},
                                      {area.x + area.width, area.y + area.height - 1}, kLineColor);
  ImGui::End();
}

std::string status_text(const StatisticsModel& model, double target, bool paused) {
  std::string text = std::to_string(model.spp) + " spp · " + duration_text(model.seconds);
  if (model.noise > 0) {
    text += " · noise " + percent_text(model.noise);
    const auto more = seconds_to_noise(model, target);
    if (more)
      text += " · " + short_percent(target) + (*more > 0 ? " in " + duration_text(*more) : " reached");
  }
  text += pad(model.estimator);
  if (model.leaked_walks > 0)
    text += " · " + count_text(static_cast<double>(model.leaked_walks)) + " walks leaked";
  if (paused) text += " · paused";
  return text;
}

void status_line(const Ui& ui, const UiModel& model, const Area& area) {
  begin_area("status", area, kBarColor, {10, 4});
  const std::string text = status_text(model.statistics, ui.state.target_noise, model.toolbar.paused);
  const std::string right = model.statistics.walks_per_second > 0
                                ? count_text(model.statistics.walks_per_second) + " walks/s"
                                : std::string();
  const float right_width = text_width(plain_font(), right);
  const std::string shown = elided(plain_font(), text, area.width - right_width - 40);
  draw_text(plain_font(), {area.x + 10, area.y + 5}, kTextColor, shown);
  draw_text(plain_font(), {std::round(area.x + area.width - right_width - 10), area.y + 5}, kDimColor, right);
  ImGui::End();
}

void sparkline(const Ui& ui, const StatisticsModel& model, const Area& area) {
  begin_area("sparkline", area, kBarColor, {8, 2});
  const std::string text = model.noise > 0 ? "noise " + percent_text(model.noise) : "noise –";
  draw_text(small_font(), {area.x + 10, area.y + 6}, kDimColor, text);
  noise_sparkline(model, {{area.x + 86, area.y + 2}, {area.x + area.width - 12, area.y + area.height - 5}});
  ImGui::SetCursorScreenPos({area.x, area.y});
  constexpr auto kStatistics = static_cast<std::size_t>(PanelName::statistics);
  if (ImGui::InvisibleButton("open statistics", {area.width, area.height})) ui.state.open[kStatistics] = true;
  item_tooltip("Noise against time, logarithmic: press for the whole plot");
  ImGui::End();
}

void side_panel(const Ui& ui, const UiModel& model, const Area& area) {
  ImGui::SetNextWindowPos({area.x, area.y});
  ImGui::SetNextWindowSize({std::max(area.width, kLeastPanel), area.height});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().WindowPadding.y);
  const auto part = [&](const char* title, PanelName name, const auto& draw) {
    bool& open = ui.state.open[static_cast<std::size_t>(name)];
    ImGui::PushID(title);
    if (section(title, open)) {
      draw();
      ImGui::Dummy({1, 2});
    }
    ImGui::PopID();
  };
  part("Preset", PanelName::preset, [&] { preset_panel(ui, model.material); });
  part("Material", PanelName::material, [&] { material_panel(ui, model.material); });
  part("Light", PanelName::light, [&] { light_panel(ui, model.light); });
  part("Camera", PanelName::camera, [&] { camera_panel(ui, model.camera); });
  part("Render", PanelName::render, [&] { render_panel(ui, model.render); });
  part("Statistics", PanelName::statistics, [&] { statistics_panel(ui, model.statistics); });
  part("Coefficients", PanelName::coefficients, [&] { coefficients_panel(ui, model.material); });
  ImGui::GetWindowDrawList()->AddLine({area.x, area.y}, {area.x, area.y + area.height}, kLineColor);
  ImGui::End();
}

}  // namespace meander
