// The slider: a field that is dragged, typed into and reset.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "ui/style.h"
#include "ui/widgets.h"

namespace meander {
namespace {

constexpr float kAsideWidth = 66;
constexpr float kGrabReach = 7;     // points about the handle that hold it as it is
constexpr float kTickReach = 3.5f;  // points within which a tick catches
constexpr double kFine = 0.1;

// One slider in one frame.
struct Field {
  const SliderSpec& spec;
  ImRect box;
  ImGuiID id;
  bool hovered = false;

  [[nodiscard]] float x_of(double place) const {
    return box.Min.x + static_cast<float>(std::clamp(place, 0.0, 1.0)) * box.GetWidth();
  }
};

void hold(const Ui& ui, const Field& field, double value) {
  const ImGuiIO& io = ImGui::GetIO();
  const double place = place_of(field.spec.map, value);
  const bool on_handle = std::abs(io.MousePos.x - field.x_of(place)) < kGrabReach;
  const double pressed = static_cast<double>((io.MousePos.x - field.box.Min.x) / field.box.GetWidth());
  ui.state.drag = {field.id, on_handle || io.KeyShift ? place : pressed, field.id};
}

// The value under the pointer that holds the slider.
double dragged(const Ui& ui, const Field& field) {
  const ImGuiIO& io = ImGui::GetIO();
  const double width = static_cast<double>(field.box.GetWidth());
  const double speed = io.KeyShift ? kFine : 1;
  ui.state.drag.place += speed * static_cast<double>(io.MouseDelta.x) / width;
  const double reach = io.KeyShift ? 0 : static_cast<double>(kTickReach) / width;
  return settled(field.spec.map, field.spec.ticks, ui.state.drag.place, {reach, speed / width});
}

std::optional<double> drag(const Ui& ui, const Field& field, double value) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  const ImGuiIO& io = context.IO;
  if (field.hovered && io.MouseClicked[0]) {
    ImGui::SetActiveID(field.id, context.CurrentWindow);
    ImGui::SetFocusID(field.id, context.CurrentWindow);
    ImGui::FocusWindow(context.CurrentWindow);
    const bool again = io.MouseDoubleClicked[0] && ui.state.drag.pressed == field.id;
    hold(ui, field, value);
    if (again) {
      ui.state.drag.id = 0;
      ui.actions.gesture_resumed = true;
      if (field.spec.reset != value) return field.spec.reset;
      return std::nullopt;
    }
  }
  if (context.ActiveId != field.id) return std::nullopt;
  if (!io.MouseDown[0]) {
    ImGui::ClearActiveID();
    ui.state.drag.id = 0;
    return std::nullopt;
  }
  if (ui.state.drag.id != field.id) return std::nullopt;
  const double place = place_of(field.spec.map, value);
  if (io.MouseClicked[0] && place == ui.state.drag.place) return std::nullopt;  // held where it is
  if (!io.MouseClicked[0] && io.MouseDelta.x == 0) return std::nullopt;
  const double next = dragged(ui, field);
  if (next == value) return std::nullopt;
  return next;
}

std::optional<double> commit_typed(const Ui& ui, const SliderSpec& spec, double value) {
  const std::string text = std::move(ui.state.typing.text);
  ui.state.typing = {};
  const std::string& start = spec.start.empty() ? spec.text : spec.start;
  if (text == start) return std::nullopt;
  const auto number = typed_number(text, spec.typed_low, spec.typed_high);
  if (number && *number != value) return number;
  return std::nullopt;
}

// Shows the text field; the number, once it has been entered.
std::optional<double> type(const Ui& ui, const Field& field, double value) {
  const std::string& start = field.spec.start.empty() ? field.spec.text : field.spec.start;
  if (ui.state.typing.id != field.id) ui.state.typing = {field.id, start};
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%s", start.c_str());
  ImGui::TempInputText(field.box, field.id, field.spec.id.c_str(), buffer.data(),
                       static_cast<int>(buffer.size()), ImGuiInputTextFlags_AutoSelectAll);
  ui.state.typing.text = buffer.data();
  if (ImGui::TempInputIsActive(field.id)) return std::nullopt;
  return commit_typed(ui, field.spec, value);
}

void draw_ticks(const Field& field, ImDrawList& list) {
  for (const Tick& tick : field.spec.ticks) {
    const float x = std::round(field.x_of(place_of(field.spec.map, tick.value)));
    if (x <= field.box.Min.x + 1 || x >= field.box.Max.x - 1) continue;
    list.AddLine({x, field.box.Max.y - 4}, {x, field.box.Max.y}, IM_COL32(150, 150, 150, 200));
  }
}

// At the lower end of the track, clear of the text.
void draw_handle(const Field& field, float x, bool held) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImRect& box = field.box;
  const float at = std::round(std::clamp(x, box.Min.x + 4, box.Max.x - 4));
  const ImU32 color = held ? IM_COL32_WHITE : kAccent;
  list.AddRectFilled({at - 4, box.Max.y - 4}, {at + 4, box.Max.y}, color, 1.5f);
}

void draw_channel(const Field& field) {
  if (field.spec.channel.empty()) return;
  const char letter = field.spec.channel.front();
  const ImU32 color = letter == 'R'   ? IM_COL32(224, 128, 120, 255)
                      : letter == 'G' ? IM_COL32(126, 196, 130, 255)
                                      : IM_COL32(132, 164, 232, 255);
  draw_text(small_font(), {field.box.Min.x + 6, field.box.Min.y + 4}, color, field.spec.channel);
}

void draw(const Field& field, double value, bool held) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImRect& box = field.box;
  list.AddRectFilled(box.Min, box.Max, field.hovered || held ? kHoverColor : kFrameColor, kRounding);
  const float x = field.x_of(place_of(field.spec.map, value));
  const float from = field.x_of(place_of(field.spec.map, std::max(field.spec.origin, field.spec.map.low)));
  list.PushClipRect({std::min(from, x), box.Min.y}, {std::max(from, x), box.Max.y}, true);
  list.AddRectFilled(box.Min, box.Max, kTrackFill, kRounding);
  list.PopClipRect();
  draw_ticks(field, list);
  draw_handle(field, x, held);
  draw_channel(field);
  const std::string text = elided(plain_font(), field.spec.text, box.GetWidth() - 10);
  draw_text(plain_font(), {std::round(box.Max.x - 6 - text_width(plain_font(), text)), box.Min.y + 3},
            kTextColor, text);
}

void show_tick_name(const Field& field) {
  const float x = ImGui::GetIO().MousePos.x;
  for (const Tick& tick : field.spec.ticks)
    if (*tick.name && std::abs(field.x_of(place_of(field.spec.map, tick.value)) - x) < kTickReach)
      ImGui::SetTooltip("%g  %s", tick.value, tick.name);
}

}  // namespace

std::optional<double> bare_slider(const Ui& ui, const SliderSpec& spec, double value,
                                  const std::pair<ImVec2, ImVec2>& box) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  Field field{spec, ImRect(box.first, box.second), window->GetID(spec.id.c_str())};
  if (window->SkipItems || !ImGui::ItemAdd(field.box, field.id, nullptr, ImGuiItemFlags_Inputable)) {
    if (ui.state.typing.id == field.id) return commit_typed(ui, spec, value);
    return std::nullopt;
  }
  field.hovered = ImGui::ItemHoverable(field.box, field.id);
  const ImGuiIO& io = ImGui::GetIO();
  const bool typing = ImGui::TempInputIsActive(field.id);
  if (typing || (field.hovered && io.MouseClicked[0] && io.KeyCtrl)) {
    if (!typing) ImGui::FocusWindow(window);
    return type(ui, field, value);
  }
  if (ui.state.typing.id == field.id) return commit_typed(ui, spec, value);
  const auto changed = drag(ui, field, value);
  const bool held = ImGui::GetCurrentContext()->ActiveId == field.id;
  draw(field, changed.value_or(value), held);
  if (field.hovered || held) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (field.hovered && !held) {
    item_tooltip(spec.tooltip);
    show_tick_name(field);
  }
  return changed;
}

std::optional<double> slider(const Ui& ui, const SliderSpec& spec, double value) {
  const Row row = begin_row(spec.label, spec.effect, spec.tooltip);
  ImVec2 high = row.high;
  if (!spec.aside.empty()) {
    high.x -= kAsideWidth;
    const std::string aside = elided(small_font(), spec.aside, kAsideWidth - 4);
    draw_text(small_font(), {high.x + 6, row.low.y + 4}, kDimColor, aside);
  }
  const auto changed = bare_slider(ui, spec, value, {row.low, high});
  end_row(row);
  return changed;
}

}  // namespace meander
