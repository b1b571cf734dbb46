#include "ui/keys.h"

#include <array>

namespace meander {
namespace {

constexpr Modifiers kNone{};
constexpr Modifiers kShift{true, false, false, false};
constexpr Modifiers kControl{false, true, false, false};
constexpr Modifiers kControlShift{true, true, false, false};

constexpr KeyRow pointer(std::string_view keys, std::string_view meaning) {
  KeyRow row;
  row.chord = false;
  row.keys = keys;
  row.meaning = meaning;
  return row;
}

constexpr KeyRow chord(int code, Modifiers modifiers, CommandKind command, std::string_view keys = {},
                       std::string_view meaning = {}) {
  KeyRow row;
  row.code = row.last_code = code;
  row.modifiers = modifiers;
  row.command = command;
  row.keys = keys;
  row.meaning = meaning;
  return row;
}

constexpr KeyRow range(KeyRow row, int last_code) {
  row.last_code = last_code;
  return row;
}

constexpr KeyRow repeating(KeyRow row, double value = 0) {
  row.repeats = true;
  row.value = value;
  return row;
}

using enum CommandKind;

constexpr std::array kTable{
    pointer("Drag", "Orbit"),
    pointer("Middle drag, Shift + drag", "Pan"),
    pointer("Wheel", "Dolly"),
    chord('F', kNone, frame, "F", "Frame the object"),
    chord('R', kNone, reset_camera, "R", "Reset the camera"),
    chord('C', kNone, copy_camera, "C", "Copy the camera as scene text"),
    pointer("L + drag", "Orbit the key light"),
    pointer("Shift + L + drag", "Turn the environment"),
    range(chord('1', kNone, view, "1 … 8", "Views, in the order of their list"), '8'),
    repeating(chord('E', kNone, exposure_step, "E, Shift + E", "Exposure up, down by half a stop"), 0.5),
    repeating(chord('E', kShift, exposure_step), -0.5),
    chord(key::kSpace, kNone, pause, "Space", "Pause, go on"),
    chord('X', kNone, select_region, "X", "Drag a rectangle: statistics, region"),
    chord('K', kNone, snapshot, "K, F12", "Take a snapshot"),
    chord(key::kF12, kNone, snapshot),
    range(chord('1', kControl, restore, "Ctrl + 1 … 9", "Restore a snapshot"), '9'),
    chord('W', kNone, wipe, "W", "Compare A and B by a wipe"),
    chord('D', kNone, difference, "D", "Difference of A and B"),
    chord('B', kNone, swap_ab, "B", "Look at B instead of A"),
    repeating(chord('Z', kControl, undo, "Ctrl + Z", "Undo")),
    repeating(chord('Z', kControlShift, redo, "Ctrl + Shift + Z, Ctrl + Y", "Redo")),
    repeating(chord('Y', kControl, redo)),
    chord('O', kControl, open_browser, "Ctrl + O", "Open a scene, mesh, environment or picture"),
    chord('S', kControl, save, "Ctrl + S", "Save the scene"),
    chord('S', kControlShift, save_browser, "Ctrl + Shift + S", "Save the scene under another name"),
    chord('E', kControl, save_picture_browser, "Ctrl + E", "Save the picture: EXR or PNG"),
    chord('R', kControl, reload, "Ctrl + R, F5", "Reload scene and shaders"),
    chord(key::kF5, kNone, reload),
    chord(key::kTab, kNone, hide_interface, "Tab, Ctrl + B", "Hide the interface"),
    chord('B', kControl, hide_interface),
    chord('H', kNone, help, "H, ?, F1", "This help"),
    chord('/', kShift, help),
    chord('?', kNone, help),
    chord('?', kShift, help),
    chord(key::kF1, kNone, help),
    chord(key::kEscape, kNone, quit, "Esc", "Close what is open; quit"),
    pointer("Drag a slider", "Shift: fine · Ctrl + click: type · double click: reset"),
    pointer("Drop a file", "Scene, mesh, environment, or a picture to compare with"),
};

}  // namespace

std::span<const KeyRow> key_table() { return kTable; }

std::optional<Command> command_of(const InputEvent& event, HeldKeys& held) {
  if (event.kind == InputKind::focus) held.reset();
  if (event.kind != InputKind::key || event.code < 0 || event.code >= static_cast<int>(held.size()))
    return std::nullopt;
  const auto code = static_cast<std::size_t>(event.code);
  const bool repeated = event.down && held[code];
  held[code] = event.down;
  if (!event.down) return std::nullopt;
  for (const KeyRow& row : kTable) {
    if (!row.chord || event.code < row.code || event.code > row.last_code) continue;
    if (row.modifiers != event.modifiers) continue;
    if (repeated && !row.repeats) return std::nullopt;
    Command command{row.command, event.code - row.code, row.value, {}, {}};
    return command;
  }
  return std::nullopt;
}

}  // namespace meander
