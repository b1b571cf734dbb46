// RenderMan, as RIB: PxrSurface. Its glass with an interior takes the single-scattering albedo and the
// extinction per scene unit as they are (rmanwiki.pixar.com, PxrSurface: Glass Parameters and Interior
// Parameters, RenderMan 23). Its subsurface lobe takes a surface colour and a diffuse mean free path in
// millimetres, 1 / sqrt(3 sigma_a (sigma_a + sigma_s')): the tables of REN22, Subsurface Scattering
// Parameters, are those of Jensen et al. 2001; unitLength, scene units per millimetre, is 0.1 for centimetres
// (RenderMan 20, PxrLMSubsurface).
#include <algorithm>
#include <cmath>

#include "io/export_dialects.h"
#include "io/export_text.h"
#include "medium/similarity.h"

namespace meander {
namespace {

// The least absorption, as a part of the reduced extinction, for which diffusion has a length.
constexpr double kLeastAbsorbed = 1e-6;

class Bxdf {
 public:
  explicit Bxdf(const std::string& identifier) : text_("Bxdf \"PxrSurface\" \"" + identifier + "\"\n") {}

  void add(const std::string& declaration, const std::string& value) {
    text_ += "    \"" + declaration + "\" [" + value + "]\n";
  }
  void add(const std::string& declaration, double value) { add(declaration, number_text(value)); }
  void add(const std::string& declaration, const DVec3& value) { add(declaration, triple_text(value, " ")); }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// Glass around a scattering interior: the same physics as ours.
ExportPiece interior(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  piece.remarks = {
      "Glass with an interior, which takes single-scattering albedo and extinction as they are: the "
      "subsurface lobe",
      "knows no reflection back inside. For PxrPathTracer; its limit of indirect bounces ends",
      "walks, so raise it."};
  if (material.roughness > 0)
    piece.notes.push_back("roughness " + short_text(material.roughness) +
                          " is written as it is: the width of the microfacets that PxrSurface makes of it is "
                          "not documented, ours is its square");
  Bxdf bxdf(task.identifier);
  bxdf.add("float diffuseGain", 0.0);
  bxdf.add("float refractionGain", 1.0);
  bxdf.add("float reflectionGain", 1.0);
  bxdf.add("float glassIor", material.ior);
  bxdf.add("float glassRoughness", material.roughness);
  bxdf.add("color ssAlbedo", DVec3(material.medium.albedo));
  bxdf.add("color extinction", DVec3(material.medium.sigma_t));
  bxdf.add("float g", double{material.medium.g});
  bxdf.add("int multiScatter", "1");
  piece.code = bxdf.text();
  return piece;
}

// In millimetres.
DVec3 diffuse_mean_free_path(const Medium& medium, double millimetres_per_unit,
                             std::vector<std::string>& notes) {
  const Coefficients isotropic = reduced(coefficients_of(medium));
  const DVec3 extinction = sigma_t_of(isotropic);
  bool white = false;
  DVec3 length(kLongestPath);
  for (int c = 0; c < 3; ++c) {
    const double absorbed = std::max(isotropic.sigma_a[c], kLeastAbsorbed * extinction[c]);
    white |= absorbed > isotropic.sigma_a[c];
    if (extinction[c] > 0)
      length[c] = std::min(kLongestPath, millimetres_per_unit / std::sqrt(3 * absorbed * extinction[c]));
  }
  if (white)
    notes.push_back("a channel that absorbs next to nothing has no finite diffuse mean free path: it is cut");
  return length;
}

ExportPiece subsurface(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  const Medium& medium = material.medium;
  piece.remarks = {
      "Path-traced subsurface: subsurfaceColor is the surface colour, Dmfp x DmfpColor the diffuse",
      "mean free path in mm, unitLength the scene units in a mm. subsurfaceType 5 is meant as exponential",
      "path tracing; its number is in no public page: check it."};
  piece.notes.push_back("sigma_t and the single-scattering albedo " + triple_text(DVec3(medium.albedo), " ") +
                        ": PxrSurface makes its own of colour and diffuse mean free path");
  const DVec3 length = diffuse_mean_free_path(medium, task.millimetres_per_unit, piece.notes);
  const double longest = std::max({length.x, length.y, length.z});
  const double g = std::max(double{medium.g}, 0.0);
  if (medium.g < 0)
    piece.notes.push_back("g " + short_text(double{medium.g}) + ": subsurfaceDirectionality starts at 0");
  if (has_index_step(material))
    piece.notes.push_back("no light is reflected back inside (ior " + short_text(material.ior) + ")");
  Bxdf bxdf(task.identifier);
  bxdf.add("float diffuseGain", 0.0);
  if (has_index_step(material)) {
    bxdf.add("int specularFresnelMode", "1");
    bxdf.add("color specularEdgeColor", DVec3(1));
    bxdf.add("color specularIor", DVec3(material.ior));
    bxdf.add("float specularRoughness", material.roughness);
  }
  bxdf.add("int subsurfaceType", "5");
  bxdf.add("float subsurfaceGain", 1.0);
  bxdf.add("color subsurfaceColor", surface_color(material));
  bxdf.add("float subsurfaceDmfp", longest);
  bxdf.add("color subsurfaceDmfpColor", length / longest);
  bxdf.add("float subsurfaceDirectionality", g);
  bxdf.add("float unitLength", 1 / task.millimetres_per_unit);
  piece.code = bxdf.text();
  return piece;
}

}  // namespace

ExportPiece renderman_piece(const ExportTask& task) {
  return task.material.boundary == Boundary::diffuse ? subsurface(task) : interior(task);
}

}  // namespace meander
