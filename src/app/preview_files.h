// What the previewer reads and writes: scenes, meshes, surrounds, pictures, and materials for other
// renderers.
#pragma once

#include <string>

#include "app/preview_pictures.h"
#include "app/preview_state.h"
#include "ui/interface.h"

namespace meander {

/// What commands work on.
struct PreviewTools {
  const Functions& gl;
  PreviewState& state;
  PreviewPictures& pictures;
  const Session& session;
  std::uint64_t generation = 0;  // the newest that was asked for
  const ClipboardAccess& clipboard;
};

/// Opens what was dropped or chosen, by its type: a .toml scene takes the place of the scene; a mesh that of
/// the first translucent object, material and light kept; an .hdr picture becomes the surround, any other
/// picture B of the comparison, or with `as_surround` the surround too. Errors: Error.
void open_file(PreviewTools& tools, const std::string& path, bool as_surround);

/// Writes the scene under its own name; under NAME-look.toml beside it when that is a mesh, or when comments
/// within would be lost. Errors: Error.
void save_scene(PreviewTools& tools);
void save_scene_as(PreviewTools& tools, const std::string& path);

/// Writes the live picture: .exr linear with its variance, .png as it is shown. Errors: Error.
void save_picture(PreviewTools& tools, const std::string& path);

/// The selected material in another renderer's terms, to the clipboard. Errors: Error.
void copy_material(PreviewTools& tools, std::size_t renderer);

/// Lists a folder for the interface.
[[nodiscard]] BrowserModel list_folder(const std::string& folder);

}  // namespace meander
