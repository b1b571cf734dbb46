// Edits from the command line, `PATH=VALUE`: any value of a scene by name.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace meander {

/// Applies one edit to a parsed scene file. PATH is `section.key`, or `material.NAME.key`, `light.NAME.key`,
/// `object.NAME.key`, and may go on into a table (`object.knot.transform.scale`); VALUE is TOML, or plain
/// text. Setting one member of a medium's parametrisation converts the material to that one; setting
/// g holds what the material's g_lock says; setting a preset drops the medium that the material had. Errors:
/// Error naming the edit.
void apply_edit(toml::table& document, const std::string& edit, const std::string& file);

}  // namespace meander
