// Lights as scene files write them.
#pragma once

#include "io/toml_table.h"
#include "scene/scene.h"

namespace meander {

/// Reads a `[[light]]` table; without a name the light is "light" and its number, index + 1. Errors: Error
/// with the place.
[[nodiscard]] Light read_light(TomlTable table, std::size_t index);

/// The table that reads as this light.
[[nodiscard]] toml::table light_table(const Light& light);

}  // namespace meander
