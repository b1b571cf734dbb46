// Materials as scene files write them: three parametrisations of a medium, checked and resolved.
#pragma once

#include "io/toml_table.h"
#include "scene/scene.h"

namespace meander {

/// The three ways to give a medium.
enum class Parametrisation { color, albedo, sigma };

/// The parametrisation that a key belongs to, if it belongs to one.
[[nodiscard]] std::optional<Parametrisation> parametrisation_of(std::string_view key);

/// Reads a `[[material]]` table without its name. `millimetres_per_unit` turns coefficients per millimetre
/// into coefficients per scene unit. Errors: Error with the place.
[[nodiscard]] Material read_material(TomlTable& table, double millimetres_per_unit);

/// Rewrites a translucent material's table in another parametrisation of the same medium, everything else
/// held. Errors: as read_material.
void convert_material(toml::table& table, Parametrisation target, const std::string& file,
                      double millimetres_per_unit);

}  // namespace meander
