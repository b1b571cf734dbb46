// One material in each renderer's language: the pieces of which material_export.h makes a document.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace meander {

/// A material to be written. A dielectric boundary without an index step is no interface, and arrives as
/// matched. `identifier` is for the languages that name things by one; no other material has it, or it with
/// `_surface` added.
struct ExportTask {
  TranslucentMaterial material;
  std::string name;
  std::string identifier;
  double millimetres_per_unit = 1;
};

/// `remarks` say how the numbers are meant, `notes` what is not carried: one line each, not yet comments.
struct ExportPiece {
  std::vector<std::string> remarks;
  std::vector<std::string> notes;
  std::string code;
};

[[nodiscard]] ExportPiece cycles_piece(const ExportTask& task);
[[nodiscard]] ExportPiece arnold_piece(const ExportTask& task);
[[nodiscard]] ExportPiece renderman_piece(const ExportTask& task);
[[nodiscard]] ExportPiece openpbr_piece(const ExportTask& task);
[[nodiscard]] ExportPiece mitsuba_piece(const ExportTask& task);
[[nodiscard]] ExportPiece pbrt_piece(const ExportTask& task);

/// The mean free path that stands for an infinite one, in scene units.
inline constexpr double kLongestPath = 1e9;

/// 1 / sigma_t, kLongestPath at most; a note where it stands for an infinite one.
[[nodiscard]] DVec3 mean_free_paths(const DVec3& sigma_t, std::vector<std::string>& notes);

/// The diffuse albedo of a half-space of the material under its own boundary (ColorMap).
[[nodiscard]] DVec3 surface_color(const TranslucentMaterial& material);
/// What the same medium would show if nothing were reflected back inside.
[[nodiscard]] DVec3 matched_color(const TranslucentMaterial& material);

/// Whether light inside is reflected back at the boundary.
[[nodiscard]] bool has_index_step(const TranslucentMaterial& material);

}  // namespace meander
