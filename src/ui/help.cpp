#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "ui/bars.h"
#include "ui/dialogs.h"
#include "ui/keys.h"
#include "ui/style.h"

namespace meander {
namespace {

constexpr float kLine = 19;
constexpr float kKeysWidth = 164;
constexpr float kColumn = 470;
constexpr float kNarrowColumn = 290;

void help_row(const KeyRow& row, const ImVec2& at, float width) {
  const float keys = std::min(kKeysWidth, 0.45f * width);
  draw_text(plain_font(), at, kAccent, elided(plain_font(), row.keys, keys - 8));
  draw_text(plain_font(), {at.x + keys, at.y}, kTextColor,
            elided(plain_font(), row.meaning, width - keys - 8));
}

}  // namespace

void help_overlay(const Ui& ui, const Area& window) {
  std::vector<const KeyRow*> rows;
  for (const KeyRow& row : key_table())
    if (!row.keys.empty()) rows.push_back(&row);
  const float title = 40;
  const auto lines = static_cast<float>(rows.size());
  const bool single = window.height >= title + kLine * lines + 40 || window.width < 2 * kNarrowColumn + 40;
  const float columns = single ? 1 : 2;
  const float width = std::min(columns * kColumn + 32, window.width - 16);
  const float per_column = std::ceil(lines / columns);
  const float height = std::min(title + kLine * per_column + 20, window.height - 16);
  const Area area{std::floor(0.5f * (window.width - width)), std::floor(0.5f * (window.height - height)),
                  width, height};
  begin_dialog("help", area, {0, 0});
  // Over messages that come later, too, but not over a list or menu that is opened beside it.
  if (ImGui::GetCurrentContext()->OpenPopupStack.Size == 0)
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  draw_text(strong_font(), {area.x + 16, area.y + 13}, kTextColor, "Keys and pointer");
  ImGui::SetCursorScreenPos({area.x + width - 34, area.y + 8});
  if (icon_button("close", Icon::close, "Close (Esc)")) ui.state.help = false;
  const float column = (width - 32) / columns;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto place = static_cast<float>(i);
    const float at_column = std::floor(place / per_column);
    const ImVec2 at(area.x + 16 + at_column * column,
                    area.y + title + kLine * (place - at_column * per_column));
    help_row(*rows[i], at, column);
  }
  ImGui::End();
}

}  // namespace meander
