// Cameras as scene files write them.
#pragma once

#include "io/toml_table.h"
#include "scene/scene.h"

namespace meander {

/// Reads the `[camera]` table. Errors: Error with the place, also for a view without a direction or an up.
[[nodiscard]] Camera read_camera(TomlTable table);

/// The table that reads as this camera; an orthographic one has no field of view.
[[nodiscard]] toml::table camera_table(const Camera& camera);

}  // namespace meander
