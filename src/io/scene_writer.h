// Scene files out: one canonical text for a parsed scene file.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace meander {

/// A number in the fewest digits that read back as the same double, a whole one without a point.
[[nodiscard]] std::string toml_number(double value);

/// Text in quotes, with what TOML wants escaped.
[[nodiscard]] std::string toml_string(const std::string& text);

/// The scene file: sections and keys in the order in which they are documented, unknown ones after the
/// others. Tables without a key are left out.
[[nodiscard]] std::string scene_text(const toml::table& document);

}  // namespace meander
