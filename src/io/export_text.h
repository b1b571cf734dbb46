// Pieces of text for files in other programs' languages.
#pragma once

#include <string>
#include <string_view>

#include "math/types.h"

namespace meander {

/// Nine significant digits, enough for any float to come back as it was; whatever the locale.
[[nodiscard]] std::string number_text(double value);
[[nodiscard]] std::string triple_text(const DVec3& value, std::string_view separator);
/// Four significant digits, for a sentence; three numbers with spaces between.
[[nodiscard]] std::string short_text(double value);
[[nodiscard]] std::string short_text(const DVec3& value);

/// A string literal of Python, quotes included, in ASCII: the text's characters (UTF-8) as escapes where they
/// are not printable, U+FFFD for each byte that is not UTF-8.
[[nodiscard]] std::string python_string(std::string_view text);

/// Letters, digits and underscores alone, no digit first, never empty: other bytes become underscores.
[[nodiscard]] std::string identifier_of(std::string_view text);

/// The text as one line of printable ASCII, other bytes as '?'.
[[nodiscard]] std::string one_line_ascii(std::string_view text);

/// A comment of one line, its end included.
[[nodiscard]] std::string hash_comment(std::string_view text);
[[nodiscard]] std::string xml_comment(std::string_view text);

}  // namespace meander
