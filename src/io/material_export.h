// Translucent materials in other renderers' terms.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace meander {

enum class Renderer { cycles, arnold, renderman, openpbr, mitsuba, pbrt };

/// The name of each, as it is typed, and the file type of what is written for it; in the order of Renderer.
inline constexpr std::array<std::string_view, 6> kRendererNames{"cycles",  "arnold",  "renderman",
                                                                "openpbr", "mitsuba", "pbrt"};
inline constexpr std::array<std::string_view, 6> kRendererExtensions{".py",   ".ass", ".rib",
                                                                     ".mtlx", ".xml", ".pbrt"};

/// A document in the renderer's own language. `notes` are what it cannot say of the material, one line each,
/// none where all is carried; they are comments in the text, too.
struct ExportedMaterial {
  std::string text;
  std::vector<std::string> notes;
};

struct NamedMaterial {
  std::string name;
  TranslucentMaterial material;
};

/// A whole document of one material or several, in ASCII. The renderer's own meaning of its radius, colour
/// and g gives the material's sigma_t, single-scattering albedo and g, within the nine digits written, except
/// where a note says otherwise. Lengths are written in scene units (in millimetres where the renderer has a
/// unit of its own), `millimetres_per_unit` > 0. cycles is Python for Blender, arnold .ass, renderman RIB,
/// openpbr MaterialX, mitsuba XML for Mitsuba 3, pbrt a scene file for pbrt-v4. Any name does: what the
/// language does not allow is replaced in identifiers, which are unique in the document, and in comments.
/// With several materials each note begins with the name of its own.
[[nodiscard]] ExportedMaterial export_materials(std::span<const NamedMaterial> materials, Renderer renderer,
                                                double millimetres_per_unit);

[[nodiscard]] ExportedMaterial export_material(const TranslucentMaterial& material, const std::string& name,
                                               Renderer renderer, double millimetres_per_unit);

}  // namespace meander
