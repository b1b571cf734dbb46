// Numbers as people read them, and edits as the scene reads them.
#pragma once

#include <string>
#include <string_view>

#include "math/types.h"

namespace meander {

/// About `digits` significant digits without an exponent from 1e-4 to 1e6, "∞" for infinity.
[[nodiscard]] std::string significant(double value, int digits);
/// "+1.50" for stops and other signed steps.
[[nodiscard]] std::string signed_text(double value, int decimals);
/// "1.8 %" of 0.018.
[[nodiscard]] std::string percent_text(double fraction);
/// "1 %" of 0.01, without zeros at the end: of a number that someone chose.
[[nodiscard]] std::string short_percent(double fraction);
/// "6.2 s", "2 min 05 s", "1 h 12 min".
[[nodiscard]] std::string duration_text(double seconds);
/// "950", "12.3 k", "4.56 M".
[[nodiscard]] std::string count_text(double count);
/// "12 µm", "0.35 mm", "4.2 cm", "∞".
[[nodiscard]] std::string length_text(double millimetres);
/// "#E8C89A" of a linear colour, clamped to what a display has.
[[nodiscard]] std::string hex_text(const DVec3& linear);
/// The three numbers with a space between.
[[nodiscard]] std::string triple_text(const DVec3& v, int digits);
/// "whole milk" of "whole_milk".
[[nodiscard]] std::string spaced(std::string_view name);

/// `PATH=VALUE` with the fewest digits that read back exactly.
[[nodiscard]] std::string edit_text(const std::string& path, double value);
[[nodiscard]] std::string edit_text(const std::string& path, const DVec3& value);
[[nodiscard]] std::string edit_text(const std::string& path, bool value);
[[nodiscard]] std::string edit_text(const std::string& path, std::string_view word);

}  // namespace meander
