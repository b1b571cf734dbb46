#include <algorithm>
#include <cmath>

#include "ui/bars.h"
#include "ui/style.h"

namespace meander {
namespace {

constexpr float kThumbHeight = 46;
constexpr float kThumbWidth = 82;

struct Thumb {
  ImVec2 low;
  ImVec2 high;
};

// "A" or "B" in a corner.
void badge(const Thumb& thumb, bool left, const char* letter) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = left ? thumb.low.x : thumb.high.x - 15;
  list.AddRectFilled({x, thumb.low.y}, {x + 15, thumb.low.y + 14}, kAccent, 2);
  const float width = text_width(small_font(), letter);
  draw_text(small_font(), {std::round(x + 7.5f - 0.5f * width), thumb.low.y + 1}, IM_COL32(16, 16, 16, 255),
            letter);
}

void picture(const Thumb& thumb, const SnapshotItem& item) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(thumb.low, thumb.high, IM_COL32(24, 24, 24, 255), 2);
  if (item.texture == 0 || item.width <= 0 || item.height <= 0) return;
  const Area box{thumb.low.x, thumb.low.y, thumb.high.x - thumb.low.x, thumb.high.y - thumb.low.y};
  const Area fit = fitted_area(box, item.width, item.height);
  list.AddImage(reinterpret_cast<ImTextureID>(item.texture), {fit.x, fit.y},
                {fit.x + fit.width, fit.y + fit.height});
}

void item_menu(const Ui& ui, const SnapshotItem& item, int index) {
  if (!ImGui::BeginPopupContextItem("menu")) return;
  if (ImGui::MenuItem("Restore its parameters", nullptr, false, item.has_scene))
    ui.command(CommandKind::restore, index);
  if (ImGui::MenuItem("Make it A")) ui.command(CommandKind::set_a, index);
  if (ImGui::MenuItem("Make it B")) ui.command(CommandKind::set_b, index);
  ImGui::Separator();
  if (ImGui::MenuItem("Remove")) ui.command(CommandKind::drop_snapshot, index);
  ImGui::EndPopup();
}

void snapshot(const Ui& ui, const SnapshotStrip& model, int index, const Thumb& thumb) {
  const SnapshotItem& item = model.items[static_cast<std::size_t>(index)];
  ImGui::PushID(index);
  ImGui::SetCursorScreenPos(thumb.low);
  if (ImGui::InvisibleButton("snapshot", {kThumbWidth, kThumbHeight}))
    ui.command(item.has_scene ? CommandKind::restore : CommandKind::set_b, index);
  const bool hovered = ImGui::IsItemHovered();
  item_tooltip(item.has_scene ? "Press to restore its parameters; right button: make it A or B, remove"
                              : "A picture to compare with: press to make it B; right button: more");
  item_menu(ui, item, index);
  picture(thumb, item);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool used = model.a == index || model.b == index;
  if (used || hovered) list.AddRect(thumb.low, thumb.high, used ? kAccent : kDimColor, 2);
  if (model.a == index) badge(thumb, true, "A");
  if (model.b == index) badge(thumb, false, "B");
  const std::string label = elided(small_font(), std::to_string(index + 1) + "  " + item.label, kThumbWidth);
  draw_text(small_font(), {thumb.low.x, thumb.high.y + 2}, kDimColor, label);
  ImGui::PopID();
}

}  // namespace

void snapshot_strip(const Ui& ui, const SnapshotStrip& model, const Area& area) {
  begin_area("strip", area, kBarColor, {0, 0});
  ImGui::GetWindowDrawList()->AddLine({area.x, area.y}, {area.x + area.width, area.y}, kLineColor);
  if (model.items.empty())
    draw_text(plain_font(), {area.x + 10, area.y + 24}, kFaintColor,
              "K keeps a snapshot here: picture and parameters");
  const auto count = static_cast<int>(model.items.size());
  const int room = std::max(1, static_cast<int>((area.width - 12) / (kThumbWidth + 8)));
  const int first = std::max(0, count - room);  // the latest ones
  for (int i = first; i < count; ++i) {
    const float x = area.x + 10 + static_cast<float>(i - first) * (kThumbWidth + 8);
    const ImVec2 low(std::floor(x), area.y + 4);
    snapshot(ui, model, i, {low, {low.x + kThumbWidth, low.y + kThumbHeight}});
  }
  ImGui::End();
}

}  // namespace meander
