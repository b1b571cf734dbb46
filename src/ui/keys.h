// Keys to commands: one table for both what they do and what the help says.
#pragma once

#include <bitset>
#include <optional>
#include <span>
#include <string_view>

#include "gl/input.h"
#include "ui/actions.h"

namespace meander {

/// One row of the table. Keys `code` to `last_code` give the command's index 0, 1, …. `keys` and `meaning`
/// are for the help, empty where another row already says it; without `chord` the row is help alone: what
/// the pointer does.
struct KeyRow {
  bool chord = true;
  int code = 0;
  int last_code = 0;
  Modifiers modifiers;
  CommandKind command = CommandKind::quit;
  double value = 0;
  bool repeats = false;  // when the key is held
  std::string_view keys;
  std::string_view meaning;
};

[[nodiscard]] std::span<const KeyRow> key_table();

/// The keys that are down, by which a repeat is told from a press.
using HeldKeys = std::bitset<512>;

/// What a key chord asks for; keeps `held` up to date, so it must see every event. Nothing for a repeat of a
/// chord that does not repeat. Not to be asked while text is being typed (Interface::wants_keyboard).
[[nodiscard]] std::optional<Command> command_of(const InputEvent& event, HeldKeys& held);

}  // namespace meander
