// OpenPBR, as MaterialX. The specification, version 1.1, section Subsurface: subsurface_radius x
// subsurface_radius_scale is the mean free path 1 / sigma_t whatever g, in the scene's length unit; the
// boundary is the dielectric one of specular_ior and specular_roughness; the albedo comes of
// subsurface_color by a map that is left to the renderer, van de Hulst's being the one that is written down.
#include <algorithm>
#include <cmath>

#include "io/export_dialects.h"
#include "io/export_text.h"
#include "medium/renderer_colors.h"

namespace meander {
namespace {

// An error of the albedo that deserves a note.
constexpr double kUnreached = 1e-5;

std::string input(const std::string& name, const std::string& type, const std::string& value) {
  return "    <input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\" />\n";
}

std::string input(const std::string& name, double value) { return input(name, "float", number_text(value)); }

std::string input(const std::string& name, const DVec3& value) {
  return input(name, "color3", triple_text(value, ", "));
}

void note_boundary(const TranslucentMaterial& material, std::vector<std::string>& notes) {
  if (has_index_step(material))
    notes.push_back("the map from subsurface_color knows no interface (ior " + short_text(material.ior) +
                    "): a renderer with a map that does makes another single-scattering albedo of it. Here a "
                    "half-space shows " +
                    short_text(surface_color(material)));
  if (material.boundary == Boundary::diffuse)
    notes.push_back("a diffuse boundary: OpenPBR has a smooth dielectric one of the same ior " +
                    short_text(material.ior));
}

}  // namespace

ExportPiece openpbr_piece(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  const Medium& medium = material.medium;
  const double g{medium.g};
  const DVec3 radius = mean_free_paths(DVec3(medium.sigma_t), piece.notes);
  const double longest = std::max({radius.x, radius.y, radius.z});
  DVec3 color(0);
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    const double albedo{medium.albedo[c]};
    color[c] = openpbr_color(albedo, g);
    worst = std::max(worst, std::abs(openpbr_albedo(color[c], g) - albedo));
  }
  if (worst > kUnreached)
    piece.notes.push_back("the map does not reach so low a single-scattering albedo: it is too large by " +
                          short_text(worst));
  note_boundary(material, piece.notes);
  piece.remarks = {
      "subsurface_color is what van de Hulst's map, as OpenPBR 1.1 writes it, turns into our "
      "single-scattering albedo;",
      "radius x radius_scale is the mean free path 1 / sigma_t."};
  const std::string surface = task.identifier + "_surface";
  piece.code = "  <open_pbr_surface name=\"" + surface + "\" type=\"surfaceshader\">\n";
  piece.code += input("specular_weight", has_index_step(material) ? 1.0 : 0.0);
  piece.code += input("specular_roughness", material.roughness);
  piece.code += input("specular_ior", material.ior);
  piece.code += input("subsurface_weight", 1.0);
  piece.code += input("subsurface_color", color);
  piece.code += input("subsurface_radius", longest);
  piece.code += input("subsurface_radius_scale", radius / longest);
  piece.code += input("subsurface_scatter_anisotropy", g);
  piece.code += "  </open_pbr_surface>\n";
  piece.code += "  <surfacematerial name=\"" + task.identifier + "\" type=\"material\">\n";
  piece.code += "    <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"" + surface + "\" />\n";
  piece.code += "  </surfacematerial>\n";
  return piece;
}

}  // namespace meander
