#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/color.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr float kLabelWidth = 92;
constexpr float kMarkWidth = 12;
constexpr float kTooltipDelay = 0.45f;

// A full ring of small size: filled where the picture starts again.
void draw_mark(const ImVec2& low, Effect effect) {
  if (effect == Effect::none) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle(low.x + 0.5f * kMarkWidth + 1, low.y + 0.5f * kRowHeight);
  if (effect == Effect::restart)
    list.AddCircleFilled(middle, 2.4f, kFaintColor, 12);
  else
    list.AddCircle(middle, 2.2f, kFaintColor, 12, 1);
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, {low.x + kMarkWidth, low.y + kRowHeight}))
    ImGui::SetTooltip(effect == Effect::restart ? "Restarts the image" : "Instant: the image goes on");
}

// All the same where the names fit into that, else by what the names need.
std::vector<float> segment_widths(float room, std::span<const std::string_view> names) {
  const auto count = static_cast<float>(names.size());
  std::vector<float> widths;
  float sum = 0;
  float widest = 0;
  for (const std::string_view name : names) {
    widths.push_back(text_width(plain_font(), name));
    sum += widths.back();
    widest = std::max(widest, widths.back());
  }
  const float spare = (room - sum) / count;
  for (float& width : widths) width = widest + 8 <= room / count ? room / count : width + spare;
  return widths;
}

std::string_view without_id(std::string_view label) { return label.substr(0, label.find("##")); }

Row row_of(float label_width, Effect effect) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  Row row;
  row.low = {at.x + label_width, at.y};
  row.high = {at.x + width - kMarkWidth, at.y + kRowHeight};
  row.next = {at.x, at.y + kRowHeight + ImGui::GetStyle().ItemSpacing.y};
  ImGui::ItemSize({width, kRowHeight});
  draw_mark({row.high.x, at.y}, effect);
  return row;
}

}  // namespace

float text_width(ImFont* font, std::string_view text) {
  const float size = font->FontSize * font->Scale;
  return font->CalcTextSizeA(size, FLT_MAX, 0, text.data(), text.data() + text.size()).x;
}

float draw_text(ImFont* font, const ImVec2& at, ImU32 color, std::string_view text) {
  const float size = font->FontSize * font->Scale;
  ImGui::GetWindowDrawList()->AddText(font, size, at, color, text.data(), text.data() + text.size());
  return text_width(font, text);
}

std::string elided(ImFont* font, std::string_view text, float width) {
  if (text_width(font, text) <= width) return std::string(text);
  const float room = width - text_width(font, "…");
  std::size_t kept = text.size();
  while (kept > 0 && text_width(font, text.substr(0, kept)) > room) {
    --kept;
    while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xC0) == 0x80) --kept;  // inside a character
  }
  return std::string(text.substr(0, kept)) + "…";
}

void item_tooltip(const char* text) {
  if (text && *text && ImGui::IsItemHovered() && ImGui::GetCurrentContext()->HoveredIdTimer > kTooltipDelay &&
      !ImGui::IsAnyItemActive()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(320);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
}

Row begin_row(std::string_view label, Effect effect, const char* tooltip) {
  const Row row = row_of(kLabelWidth, effect);
  const std::string text = elided(plain_font(), without_id(label), kLabelWidth - 6);
  const ImVec2 at(row.next.x, row.low.y + 3);
  draw_text(plain_font(), at, kDimColor, text);
  if (tooltip && ImGui::IsWindowHovered() && !ImGui::IsAnyItemActive() &&
      ImGui::IsMouseHoveringRect({at.x, row.low.y}, {row.low.x - 6, row.high.y})) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(320);
    ImGui::TextUnformatted(tooltip);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  return row;
}

Row begin_wide_row(Effect effect) { return row_of(0, effect); }

void end_row(const Row& row) { ImGui::SetCursorScreenPos(row.next); }

std::optional<int> segmented(const Row& row, const char* id, std::span<const std::string_view> names,
                             int chosen) {
  std::optional<int> pressed;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(row.low, row.high, kFrameColor, kRounding);
  ImGui::PushID(id);
  const std::vector<float> widths = segment_widths(row.width(), names);
  float left = row.low.x;
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ImVec2 low(std::round(left), row.low.y);
    const ImVec2 high(std::round(left + widths[index]), row.high.y);
    left += widths[index];
    ImGui::SetCursorScreenPos(low);
    ImGui::PushID(i);
    if (ImGui::InvisibleButton("segment", {std::max(high.x - low.x, 1.0f), high.y - low.y})) pressed = i;
    ImGui::PopID();
    const bool lit = i == chosen;
    if (lit || ImGui::IsItemHovered())
      list.AddRectFilled(low, high, lit ? kAccentFill : kHoverColor, kRounding);
    if (i > 0 && !lit && i - 1 != chosen) list.AddLine({low.x, low.y + 4}, {low.x, high.y - 4}, kHeldColor);
    const std::string text = elided(plain_font(), names[index], high.x - low.x - 2);
    const float x = std::round(0.5f * (low.x + high.x - text_width(plain_font(), text)));
    draw_text(plain_font(), {x, low.y + 3}, lit ? IM_COL32_WHITE : kTextColor, text);
  }
  ImGui::PopID();
  end_row(row);
  return pressed;
}

bool begin_list(const Row& row, const char* id, const std::string& shown) {
  ImGui::SetCursorScreenPos(row.low);
  ImGui::SetNextItemWidth(row.width());
  const std::string text = elided(plain_font(), shown, row.width() - 26);
  ImDrawList& list = *ImGui::GetWindowDrawList();  // of the window that the list drops from
  const bool open =
      ImGui::BeginCombo(id, text.c_str(), ImGuiComboFlags_HeightLarge | ImGuiComboFlags_NoArrowButton);
  draw_icon(list, Icon::chevron_down, {row.high.x - 11, 0.5f * (row.low.y + row.high.y)}, kDimColor);
  return open;
}

std::optional<int> choice(const Row& row, const char* id, std::span<const std::string_view> names,
                          int chosen) {
  std::optional<int> picked;
  const bool known = chosen >= 0 && chosen < static_cast<int>(names.size());
  const std::string shown(known ? names[static_cast<std::size_t>(chosen)] : "");
  if (begin_list(row, id, shown)) {
    for (int i = 0; i < static_cast<int>(names.size()); ++i)
      if (ImGui::Selectable(std::string(names[static_cast<std::size_t>(i)]).c_str(), i == chosen,
                            ImGuiSelectableFlags_None, {0, kListLine}))
        picked = i;
    ImGui::EndCombo();
  }
  end_row(row);
  return picked;
}

bool icon_button(const char* id, Icon icon, const char* tooltip, const ButtonLook& look) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 high(low.x + look.width, low.y + look.height);
  const bool pressed = ImGui::InvisibleButton(id, {look.width, look.height}) && look.enabled;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool hovered = look.enabled && ImGui::IsItemHovered();
  if (look.lit)
    list.AddRectFilled(low, high, kAccentFill, kRounding);
  else if (hovered)
    list.AddRectFilled(low, high, ImGui::IsItemActive() ? kHeldColor : kHoverColor, kRounding);
  const ImVec2 middle(0.5f * (low.x + high.x), 0.5f * (low.y + high.y));
  const ImU32 lively = look.lit ? IM_COL32_WHITE : kTextColor;
  draw_icon(list, icon, middle, look.enabled ? lively : IM_COL32(92, 92, 92, 255));
  item_tooltip(tooltip);
  return pressed;
}

bool text_button(const char* text, const char* tooltip, float width) {
  const bool pressed = ImGui::Button(text, {width, kRowHeight});
  item_tooltip(tooltip);
  return pressed;
}

void drop_from_last_item(const ImVec2& size) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const ImVec2 at(ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y + 4);
  ImGui::SetNextWindowPos({std::max(0.0f, std::min(at.x, room.x - size.x - 4)),
                           std::max(0.0f, std::min(at.y, room.y - size.y - 4))});
}

void swatch(const ImVec2& low, const ImVec2& high, const DVec3& linear) {
  const auto level = [](double x) {
    return static_cast<int>(std::lround(255 * encode_srgb(static_cast<Real>(std::clamp(x, 0.0, 1.0)))));
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, IM_COL32(level(linear.x), level(linear.y), level(linear.z), 255), kRounding);
  list.AddRect(low, high, IM_COL32(0, 0, 0, 90), kRounding);
}

std::optional<DVec3> color_button(const char* id, const Row& box, const DVec3& linear, const DVec3& reset) {
  std::optional<DVec3> changed;
  ImGui::PushID(id);
  ImGui::SetCursorScreenPos(box.low);
  if (ImGui::InvisibleButton("swatch", {box.width(), box.high.y - box.low.y})) ImGui::OpenPopup("picker");
  swatch(box.low, box.high, linear);
  if (ImGui::IsItemHovered()) ImGui::GetWindowDrawList()->AddRect(box.low, box.high, kTextColor, kRounding);
  item_tooltip("Pick a colour");
  drop_from_last_item({242, 300});
  if (ImGui::BeginPopup("picker")) {
    const auto encode = [](double x) {
      return static_cast<float>(encode_srgb(static_cast<Real>(std::clamp(x, 0.0, 1.0))));
    };
    std::array<float, 3> encoded{encode(linear.x), encode(linear.y), encode(linear.z)};
    ImGui::SetNextItemWidth(220);
    constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoLabel |
                                           ImGuiColorEditFlags_DisplayRGB | ImGuiColorEditFlags_DisplayHex |
                                           ImGuiColorEditFlags_InputRGB | ImGuiColorEditFlags_NoOptions;
    if (ImGui::ColorPicker3("##picker", encoded.data(), kFlags)) {
      const auto decode = [](float x) {
        return std::round(1e5 * static_cast<double>(decode_srgb(std::clamp(x, 0.0f, 1.0f)))) / 1e5;
      };
      changed = DVec3(decode(encoded[0]), decode(encoded[1]), decode(encoded[2]));
    }
    draw_text(small_font(), ImGui::GetCursorScreenPos(), kDimColor, "linear  " + triple_text(linear, 3));
    ImGui::Dummy({220, kSmallSize + 2});
    if (text_button("Reset", "As the scene file has it")) changed = reset;
    ImGui::EndPopup();
  }
  ImGui::PopID();
  return changed;
}

bool section(const char* title, bool& open) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = kRowHeight + 4;
  if (ImGui::InvisibleButton(title, {width, height})) open = !open;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float margin = ImGui::GetStyle().WindowPadding.x;
  const ImU32 color = ImGui::IsItemHovered() ? IM_COL32(62, 62, 62, 255) : IM_COL32(50, 50, 50, 255);
  const ImVec2 low(ImGui::GetWindowPos().x + 1, at.y);
  list.PushClipRect(
      {low.x, std::max(low.y, ImGui::GetWindowPos().y)},
      {at.x + width + margin, std::min(at.y + height, ImGui::GetWindowPos().y + ImGui::GetWindowHeight())});
  list.AddRectFilled(low, {at.x + width + margin, at.y + height}, color);
  list.PopClipRect();
  draw_icon(list, open ? Icon::chevron_down : Icon::chevron_right, {at.x + 4, at.y + 0.5f * height},
            kDimColor);
  draw_text(strong_font(), {at.x + 16, at.y + 5}, kTextColor, title);
  return open;
}

}  // namespace meander
