// What a user does to a window, as plain data: who reads it need not know who made it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace meander {

enum class InputKind : std::uint8_t {
  move,    // x, y: the pointer, in window points from the top left
  leave,   // the pointer has left the window
  button,  // code: 0 left, 1 right, 2 middle; down; x, y: the pointer
  scroll,  // x, y: wheel steps, y > 0 away from the user
  key,     // code: see `key`; down, again for every repeat
  text,    // character: what was typed, as Unicode
  drop,    // paths: files dropped on the window; x, y: the pointer
  focus,   // down: the window has got the keyboard, or lost it
  redraw   // the window was resized or uncovered: its picture is gone
};

/// Codes of the keys that print nothing. A key that prints has the ASCII code of its letter (upper case, as
/// the user's keyboard layout has it), digit or sign.
namespace key {
inline constexpr int kSpace = 32;
inline constexpr int kEscape = 256;
inline constexpr int kEnter = 257;
inline constexpr int kTab = 258;
inline constexpr int kBackspace = 259;
inline constexpr int kInsert = 260;
inline constexpr int kDelete = 261;
inline constexpr int kRight = 262;
inline constexpr int kLeft = 263;
inline constexpr int kDown = 264;
inline constexpr int kUp = 265;
inline constexpr int kPageUp = 266;
inline constexpr int kPageDown = 267;
inline constexpr int kHome = 268;
inline constexpr int kEnd = 269;
inline constexpr int kF1 = 290;  // to kF1 + 11
inline constexpr int kF2 = 291;
inline constexpr int kF5 = 294;
inline constexpr int kF12 = 301;
inline constexpr int kKeypad0 = 320;  // to kKeypad0 + 9
inline constexpr int kKeypadDecimal = 330;
inline constexpr int kKeypadEnter = 335;
inline constexpr int kLeftShift = 340;
inline constexpr int kLeftControl = 341;
inline constexpr int kLeftAlt = 342;
inline constexpr int kLeftSuper = 343;
inline constexpr int kRightShift = 344;
inline constexpr int kRightControl = 345;
inline constexpr int kRightAlt = 346;
inline constexpr int kRightSuper = 347;
}  // namespace key

struct Modifiers {
  bool shift = false;
  bool control = false;
  bool alt = false;
  bool super = false;

  bool operator==(const Modifiers&) const = default;
};

struct InputEvent {
  InputKind kind = InputKind::move;
  double x = 0;
  double y = 0;
  int code = 0;
  bool down = false;
  Modifiers modifiers;
  char32_t character = 0;
  std::vector<std::string> paths;
};

}  // namespace meander
