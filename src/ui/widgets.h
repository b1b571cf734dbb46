// The controls that panels are made of. Each draws itself at the cursor of the current window and says what
// the user has done to it; what it shows is always the value that it is given.
#pragma once

#include <imgui.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ui/icons.h"
#include "ui/slider_map.h"
#include "ui/state.h"

namespace meander {

/// What panels work on: what they remember, and what they have to say.
struct Ui {
  UiState& state;
  UiActions& actions;

  void edit(std::string edit) const { actions.edits.push_back(std::move(edit)); }
  void command(CommandKind kind, std::int64_t index = 0) const {
    actions.commands.push_back({kind, index, 0, {}, {}});
  }
  void command(CommandKind kind, std::string text) const {
    actions.commands.push_back({kind, 0, 0, {}, std::move(text)});
  }
};

/// What a change of a control does to the picture; `none` is for controls to which it does not apply.
enum class Effect : std::uint8_t { none, instant, restart };

/// A line of a panel: the label on the left and the mark of the effect on the right, with room for a control
/// between them. `next` is where the line below begins.
struct Row {
  ImVec2 low;
  ImVec2 high;
  ImVec2 next;

  [[nodiscard]] float width() const noexcept { return high.x - low.x; }
};

[[nodiscard]] Row begin_row(std::string_view label, Effect effect, const char* tooltip = nullptr);
void end_row(const Row& row);

/// A line without a label.
[[nodiscard]] Row begin_wide_row(Effect effect = Effect::none);

/// `id` is unique in its window, `text` the value as shown, `start` as typing starts with it (empty: as
/// shown), `aside` stands to its right. A slider is dragged from where it is held, or from where the track is
/// pressed; with Shift ten times finer; Ctrl and a press type; a double click gives `reset`.
struct SliderSpec {
  std::string label;
  std::string id;
  SliderMap map;
  std::span<const Tick> ticks;
  double reset = 0;
  double typed_low = 0;
  double typed_high = 1;
  std::string text;
  std::string start;
  std::string aside;
  Effect effect = Effect::restart;
  const char* tooltip = nullptr;
  double origin = -1e300;    // where the filled part begins
  std::string_view channel;  // "R", "G" or "B" on the track
};

/// The new value, when there is one.
[[nodiscard]] std::optional<double> slider(const Ui& ui, const SliderSpec& spec, double value);
/// The same between `low` and `high` of the window, without a line of its own.
[[nodiscard]] std::optional<double> bare_slider(const Ui& ui, const SliderSpec& spec, double value,
                                                const std::pair<ImVec2, ImVec2>& box);

/// Buttons side by side over the row, of which one is chosen (-1: none): the one that was pressed.
[[nodiscard]] std::optional<int> segmented(const Row& row, const char* id,
                                           std::span<const std::string_view> names, int chosen);
/// Opens a drop-down list over the row, which shows `shown`; where it is open, ImGui::EndCombo() ends it. The
/// row is still to be ended.
[[nodiscard]] bool begin_list(const Row& row, const char* id, const std::string& shown);
/// A drop-down list of names.
[[nodiscard]] std::optional<int> choice(const Row& row, const char* id,
                                        std::span<const std::string_view> names, int chosen);

/// How an icon button looks.
struct ButtonLook {
  bool enabled = true;
  bool lit = false;
  float width = 26;
  float height = 24;
};
[[nodiscard]] bool icon_button(const char* id, Icon icon, const char* tooltip, const ButtonLook& look = {});
/// A plain button of the row's height; `width` 0 is that of the text.
[[nodiscard]] bool text_button(const char* text, const char* tooltip, float width = 0);

/// The popup that comes next drops from the last item, moved into the window where it is `size` large.
void drop_from_last_item(const ImVec2& size);

/// A filled rectangle of a linear colour.
void swatch(const ImVec2& low, const ImVec2& high, const DVec3& linear);
/// A swatch that opens a picker with hex; `reset` is offered in it.
[[nodiscard]] std::optional<DVec3> color_button(const char* id, const Row& box, const DVec3& linear,
                                                const DVec3& reset);

/// Headline of a section, which opens and closes it: whether it is open.
bool section(const char* title, bool& open);

/// Draws text in a font and colour with the top left at `at`; returns its width.
float draw_text(ImFont* font, const ImVec2& at, ImU32 color, std::string_view text);
[[nodiscard]] float text_width(ImFont* font, std::string_view text);
/// As much of the text as fits, with "…" where something is left out.
[[nodiscard]] std::string elided(ImFont* font, std::string_view text, float width);

/// Shows the text when the last item has been hovered for a moment.
void item_tooltip(const char* text);

}  // namespace meander
