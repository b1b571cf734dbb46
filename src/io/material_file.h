// Materials as scene files write them.
#pragma once

#include "io/toml_table.h"
#include "scene/scene.h"

namespace meander {

/// Reads a `[[material]]` table without its name (medium_file.h says how a medium is given).
/// `millimetres_per_unit` turns coefficients per millimetre into coefficients per scene unit. A translucent
/// material of radius 0 arrives as the plain diffuse one of its colour. Errors: Error with the place.
[[nodiscard]] Material read_material(TomlTable& table, double millimetres_per_unit);

}  // namespace meander
