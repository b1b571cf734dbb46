#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/bars.h"
#include "ui/dialogs.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

struct Wording {
  const char* title;
  const char* hint;
  const char* action;
  CommandKind command;
};

Wording wording(BrowserUse use) {
  if (use == BrowserUse::save_scene) return {"Save the scene", "name.toml", "Save", CommandKind::save_scene};
  if (use == BrowserUse::save_picture)
    return {"Save the picture", "name.exr (linear) or name.png (as shown)", "Save",
            CommandKind::save_picture};
  return {"Open a scene, mesh, environment or picture", "path or name", "Open", CommandKind::open};
}

std::string with_extension(const std::string& path, BrowserUse use) {
  const std::size_t slash = path.find_last_of('/');
  const std::size_t dot = path.find_last_of('.');
  const bool has = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  if (has || use == BrowserUse::open) return path;
  return path + (use == BrowserUse::save_scene ? ".toml" : ".exr");
}

void finish(const Ui& ui, const BrowserModel& model) {
  if (ui.state.path.empty()) return;
  const std::string path = with_extension(joined_path(model.folder, ui.state.path), ui.state.browser);
  ui.command(wording(ui.state.browser).command, path);
  ui.state.browser = BrowserUse::closed;
}

void go_to(const Ui& ui, const std::string& folder) {
  ui.command(CommandKind::browse, folder);
  ui.state.path.clear();
}

void entry_line(const Ui& ui, const BrowserModel& model, const BrowserEntry& entry) {
  ImGui::PushID(entry.name.c_str());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool pressed = ImGui::Selectable("##entry", ui.state.path == entry.name,
                                         ImGuiSelectableFlags_AllowDoubleClick, {width, 18});
  if (pressed && entry.folder) go_to(ui, joined_path(model.folder, entry.name));
  if (pressed && !entry.folder) {
    ui.state.path = entry.name;
    if (ImGui::IsMouseDoubleClicked(0)) finish(ui, model);
  }
  draw_icon(*ImGui::GetWindowDrawList(), entry.folder ? Icon::folder : Icon::file, {at.x + 9, at.y + 9},
            kDimColor);
  const std::string size = entry.folder ? "" : count_text(static_cast<double>(entry.bytes)) + "B";
  const float size_width = text_width(small_font(), size);
  draw_text(plain_font(), {at.x + 24, at.y + 2}, kTextColor,
            elided(plain_font(), entry.name, width - size_width - 40));
  draw_text(small_font(), {std::round(at.x + width - size_width - 4), at.y + 3}, kDimColor, size);
  ImGui::PopID();
}

// The folder, and the way up.
void folder_line(const Ui& ui, const BrowserModel& model, float width) {
  if (icon_button("up", Icon::up, "The folder above", {true, false, 26, kRowHeight}))
    go_to(ui, parent_folder(model.folder));
  ImGui::SameLine();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_text(plain_font(), {at.x, at.y + 3}, kDimColor, elided(plain_font(), model.folder, width - 70));
  ImGui::NewLine();
}

void path_field(const Ui& ui, const BrowserModel& model, const Wording& words) {
  std::array<char, 1024> buffer{};
  ui.state.path.copy(buffer.data(), buffer.size() - 1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##path", words.hint, buffer.data(), buffer.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  ui.state.path = buffer.data();
  if (entered) finish(ui, model);
}

}  // namespace

std::string joined_path(const std::string& folder, const std::string& name) {
  if (name.empty()) return folder;
  if (name.front() == '/' || folder.empty()) return name;
  return folder.back() == '/' ? folder + name : folder + '/' + name;
}

std::string parent_folder(const std::string& folder) {
  const std::size_t end = folder.find_last_not_of('/');
  if (end == std::string::npos) return "/";
  const std::size_t slash = folder.find_last_of('/', end);
  if (slash == std::string::npos || slash == 0) return "/";
  return folder.substr(0, slash);
}

void browser_dialog(const Ui& ui, const BrowserModel& model, const Area& window) {
  if (ui.state.browser == BrowserUse::closed) return;
  const Wording words = wording(ui.state.browser);
  const float width = std::min(560.0f, window.width - 24);
  const float height = std::min(420.0f, window.height - 24);
  const Area area{std::floor(0.5f * (window.width - width)), std::floor(0.4f * (window.height - height)),
                  width, height};
  begin_dialog("browser", area, {14, 12});
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ui.state.browser = BrowserUse::closed;
  draw_text(strong_font(), {area.x + 14, area.y + 13}, kTextColor, words.title);
  ImGui::SetCursorScreenPos({area.x + width - 36, area.y + 8});
  if (icon_button("close", Icon::close, "Close (Esc)")) ui.state.browser = BrowserUse::closed;
  ImGui::SetCursorScreenPos({area.x + 14, area.y + 40});
  folder_line(ui, model, width);
  const float bottom = 2 * (kRowHeight + 8) + 6;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, kSurround);
  ImGui::BeginChild("entries", {0, ImGui::GetContentRegionAvail().y - bottom});
  for (const BrowserEntry& entry : model.entries) entry_line(ui, model, entry);
  if (!model.error.empty()) ImGui::TextWrapped("%s", model.error.c_str());
  ImGui::EndChild();
  ImGui::PopStyleColor();
  ImGui::Dummy({1, 2});
  path_field(ui, model, words);
  ImGui::SetCursorScreenPos({area.x + width - 14 - 2 * 86 - 8, area.y + height - 12 - kRowHeight});
  if (text_button("Cancel", nullptr, 86)) ui.state.browser = BrowserUse::closed;
  ImGui::SameLine(0, 8);
  if (text_button(words.action, nullptr, 86)) finish(ui, model);
  ImGui::End();
}

}  // namespace meander
