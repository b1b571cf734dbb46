// How deep the tables of a TOML text nest by their keys.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace meander {

/// Parts that a key may have: a.b.c has three, and so have the deepest of a scene.
inline constexpr int kMostKeyParts = 16;

/// Every part of a dotted key makes a table in a table. The parser limits how deep values nest and not this,
/// and what frees its tables, or looks through them, needs stack for each. The place of the first key of more
/// than kMostKeyParts parts, in a file of this name; nothing where there is none.
[[nodiscard]] std::optional<Place> find_deep_key(std::string_view text, const std::string& file);

/// What is thrown of it.
[[nodiscard]] Error deep_key(const Place& place);

}  // namespace meander
