// Materials as scene files write them.
#pragma once

#include "io/medium_file.h"
#include "io/toml_table.h"
#include "scene/scene.h"

namespace meander {

/// Reads a `[[material]]` table without its name (medium_file.h says how a medium is given). A translucent
/// material of radius 0 arrives as the plain diffuse one of its colour. Errors: Error with the place.
[[nodiscard]] Material read_material(TomlTable& table, const MediumTools& tools);

/// The same for people to look at, with its name.
[[nodiscard]] MaterialDescription describe_material(TomlTable& table, const MediumTools& tools);

}  // namespace meander
