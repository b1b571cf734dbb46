// Edits from the command line, `PATH=VALUE`: any value of a scene by name.
#pragma once

#include <toml++/toml.h>
#include <string>

#include "core/error.h"
#include "medium/color_maps.h"

namespace meander {

/// Applies one edit to a parsed scene file. PATH is `section.key`, or `material.NAME.key`, `light.NAME.key`,
/// `object.NAME.key`, and may go on into a table (`object.knot.transform.scale`); VALUE is TOML, or plain
/// text. Setting one member of a medium's parametrisation converts the material to that one; setting
/// g holds what the material's g_lock says; setting a preset drops the medium that the material had. Errors:
/// Error naming the edit.
void apply_edit(toml::table& document, const std::string& edit, const std::string& file, ColorMaps& maps);

/// The table of `list` ("material", "light" or "object") that has this name; without one, light1 is the
/// first. Errors: Error at the place, with the known names.
[[nodiscard]] toml::table& find_named(toml::table& document, const std::string& list, const std::string& name,
                                      const Place& place);

}  // namespace meander
