// Arnold, as .ass text: the standard_surface shader of Arnold 7. The closure behind it takes a mean free
// path, a surface albedo and g (Arnold API reference, ai_shader_closure.h, AiClosureRandomWalkBSSRDF); what
// it makes of them inside is not published.
#include "io/export_dialects.h"
#include "io/export_text.h"

namespace meander {
namespace {

void note_boundary(const TranslucentMaterial& material, std::vector<std::string>& notes) {
  if (has_index_step(material))
    notes.push_back("no light is reflected back inside (ior " + short_text(material.ior) +
                    "): edges and thin parts differ, though the surface colour is the same");
  if (material.boundary == Boundary::dielectric)
    notes.push_back("light enters and leaves the body cosine-distributed, not refracted");
  if (material.boundary == Boundary::matched)
    notes.push_back("light enters and leaves the body cosine-distributed, not straight through");
}

}  // namespace

ExportPiece arnold_piece(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  const Medium& medium = material.medium;
  const DVec3 radius = mean_free_paths(DVec3(medium.sigma_t), piece.notes);
  piece.remarks = {
      "subsurface_radius is the mean free path 1 / sigma_t. subsurface_color is the surface colour,",
      "the diffuse albedo of a half-space."};
  piece.notes.push_back("the single-scattering albedo " + triple_text(DVec3(medium.albedo), " ") +
                        ": Arnold makes its own of the surface colour, in a way that is not published");
  if (medium.g != 0)
    piece.notes.push_back("whether Arnold takes the radius for the full or the reduced mean free path at g " +
                          short_text(double{medium.g}) + " is not published; this is the full one");
  note_boundary(material, piece.notes);
  const auto line = [&piece](const std::string& key, const std::string& value) {
    piece.code += " " + key + " " + value + '\n';
  };
  piece.code = "standard_surface\n{\n";
  line("name", task.identifier);
  line("base", "0");
  line("specular", has_index_step(material) ? "1" : "0");
  line("specular_color", "1 1 1");
  line("specular_roughness", number_text(material.roughness));
  line("specular_IOR", number_text(material.ior));
  line("subsurface", "1");
  line("subsurface_color", triple_text(surface_color(material), " "));
  line("subsurface_radius", triple_text(radius, " "));
  line("subsurface_scale", "1");
  line("subsurface_type", "\"randomwalk_v2\"");
  line("subsurface_anisotropy", number_text(double{medium.g}));
  piece.code += "}\n";
  return piece;
}

}  // namespace meander
