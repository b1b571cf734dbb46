#include <algorithm>
#include <cmath>

#include "ui/bars.h"
#include "ui/dialogs.h"
#include "ui/style.h"

namespace meander {
namespace {

constexpr std::size_t kMost = 4;
constexpr float kPadding = 10;
constexpr float kFadeIn = 0.15f;

ImU32 color_of(MessageKind kind) {
  if (kind == MessageKind::error) return kErrorColor;
  return kind == MessageKind::warning ? kWarnColor : kAccent;
}

ImVec2 wrapped_size(ImFont* font, const std::string& words, float width) {
  return font->CalcTextSizeA(font->FontSize * font->Scale, FLT_MAX, width, words.data(),
                             words.data() + words.size());
}

float height_of(const Message& message, float width) {
  float height = 2 * kPadding + wrapped_size(plain_font(), message.text, width).y;
  for (const std::string& line : message.details) height += 3 + wrapped_size(small_font(), line, width).y;
  return height;
}

void wrapped(ImFont* font, const ImVec2& at, ImU32 color, const std::pair<const std::string&, float>& words) {
  const std::string& text = words.first;
  ImGui::GetWindowDrawList()->AddText(font, font->FontSize * font->Scale, at, color, text.data(),
                                      text.data() + text.size(), words.second);
}

void toast(const Ui& ui, const Message& message, const Area& area) {
  const std::string name = "message " + std::to_string(message.id);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::min(1.0f, 0.25f + static_cast<float>(message.age) / kFadeIn));
  begin_dialog(name.c_str(), area, {0, 0});
  ImGui::PopStyleVar();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({area.x, area.y}, {area.x + 3, area.y + area.height}, color_of(message.kind));
  const float width = area.width - 2 * kPadding - 30;
  ImVec2 at(area.x + kPadding + 4, area.y + kPadding);
  wrapped(plain_font(), at, kTextColor, {message.text, width});
  at.y += wrapped_size(plain_font(), message.text, width).y;
  for (const std::string& line : message.details) {
    at.y += 3;
    wrapped(small_font(), at, kDimColor, {line, width});
    at.y += wrapped_size(small_font(), line, width).y;
  }
  ImGui::SetCursorScreenPos({area.x + area.width - 28, area.y + 5});
  if (icon_button("dismiss", Icon::close, "Close", {true, false, 24, 24}))
    ui.command(CommandKind::dismiss, static_cast<std::int64_t>(message.id));
  ImGui::End();
}

}  // namespace

void message_toasts(const Ui& ui, const std::vector<Message>& messages, const Area& image) {
  const float width = std::min(460.0f, image.width - 2 * kPadding);
  if (width < 120) return;
  float bottom = image.y + image.height - kPadding - 46;  // above the ruler
  const std::size_t first = messages.size() > kMost ? messages.size() - kMost : 0;
  for (std::size_t i = messages.size(); i-- > first;) {
    const float height = std::min(height_of(messages[i], width - 2 * kPadding - 30), image.height - 60);
    if (bottom - height < image.y) break;
    const float left = std::floor(image.x + 0.5f * (image.width - width));
    toast(ui, messages[i], {left, std::floor(bottom - height), width, std::ceil(height)});
    bottom -= height + 6;
  }
}

}  // namespace meander
