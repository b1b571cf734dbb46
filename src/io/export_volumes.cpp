// The renderers that take a medium by its coefficients: Mitsuba 3 (documentation of 3.5, plugins homogeneous,
// hg, null, dielectric, roughdielectric) and pbrt-v4 (pbrt.org/fileformat-v4: Media, Materials). Both measure
// lengths in scene units, and both take the GGX width itself where ours is its root.
#include <algorithm>

#include "io/export_dialects.h"
#include "io/export_text.h"
#include "medium/coefficients.h"

namespace meander {
namespace {

// Where facets reflect once only, as in both.
void note_roughness(const TranslucentMaterial& material, std::vector<std::string>& notes) {
  if (material.roughness > 0)
    notes.push_back("what a rough boundary (roughness " + short_text(material.roughness) +
                    ") reflects between its facets is lost there; here nothing is");
}

double ggx_width(const TranslucentMaterial& material) { return material.roughness * material.roughness; }

std::string xml_float(const std::string& name, double value) {
  return "<float name=\"" + name + "\" value=\"" + number_text(value) + "\" />\n";
}

std::string xml_rgb(const std::string& name, const DVec3& value) {
  return "<rgb name=\"" + name + "\" value=\"" + triple_text(value, ", ") + "\" />\n";
}

// A diffuse boundary becomes the smooth dielectric of its index, or none where it has no step.
std::string mitsuba_boundary(const ExportTask& task) {
  const TranslucentMaterial& material = task.material;
  const bool rough = material.roughness > 0;
  const std::string type = !has_index_step(material) ? "null" : rough ? "roughdielectric" : "dielectric";
  std::string code = "  <bsdf type=\"" + type + "\" id=\"" + task.identifier + "_boundary\">\n";
  if (has_index_step(material))
    code += "    " + xml_float("int_ior", material.ior) + "    " + xml_float("ext_ior", 1);
  if (has_index_step(material) && rough)
    code +=
        "    <string name=\"distribution\" value=\"ggx\" />\n    " + xml_float("alpha", ggx_width(material));
  return code + "  </bsdf>\n";
}

std::string pbrt_boundary(const TranslucentMaterial& material) {
  if (material.boundary == Boundary::diffuse)
    return "    Material \"diffusetransmission\" \"rgb reflectance\" [ 0 0 0 ] \"rgb transmittance\" [ 1 1 1 "
           "]\n";
  if (material.boundary == Boundary::matched) return "    Material \"interface\"\n";
  return "    Material \"dielectric\" \"float eta\" [ " + number_text(material.ior) +
         " ]\n        \"float roughness\" [ " + number_text(ggx_width(material)) +
         " ] \"bool remaproughness\" [ false ]\n";
}

}  // namespace

ExportPiece mitsuba_piece(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  const DVec3 sigma_t(material.medium.sigma_t);
  // An rgb has to be in [0, 1].
  const double largest = std::max({sigma_t.x, sigma_t.y, sigma_t.z});
  const double scale = largest > 0 ? largest : 1;
  piece.remarks = {
      "sigma_t is scale x sigma_t, per scene unit. Within a shape: a ref to the boundary, and one named",
      "interior to the medium. Integrator: volpathmis."};
  if (material.boundary == Boundary::diffuse)
    piece.notes.push_back(has_index_step(material) ? "a diffuse boundary: Mitsuba has none around a medium; "
                                                     "a smooth dielectric of the same ior stands "
                                                     "for it"
                                                   : "a diffuse boundary: Mitsuba has none around a medium; "
                                                     "light enters and leaves straight through");
  note_roughness(material, piece.notes);
  piece.code = "  <medium type=\"homogeneous\" id=\"" + task.identifier + "_medium\">\n    " +
               xml_float("scale", scale) + "    " + xml_rgb("sigma_t", sigma_t / scale) + "    " +
               xml_rgb("albedo", DVec3(material.medium.albedo));
  piece.code +=
      "    <phase type=\"hg\">\n      " + xml_float("g", double{material.medium.g}) + "    </phase>\n";
  // Shadow rays do not pass a dielectric.
  if (has_index_step(material)) piece.code += "    <boolean name=\"sample_emitters\" value=\"false\" />\n";
  piece.code += "  </medium>\n" + mitsuba_boundary(task);
  return piece;
}

ExportPiece pbrt_piece(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  const Coefficients medium = coefficients_of(material.medium);
  piece.remarks = {
      "After WorldBegin, with the shape in its place. Integrator \"volpath\", whose \"integer maxdepth\" of "
      "5",
      "ends walks: raise it. sigma_a and sigma_s are per scene unit."};
  if (material.boundary == Boundary::diffuse && has_index_step(material))
    piece.notes.push_back("the diffuse boundary has no index of refraction there (ior " +
                          short_text(material.ior) + "): nothing is reflected outside or back inside");
  if (!is_grey(material.medium.sigma_t) || !is_grey(material.medium.albedo))
    piece.notes.push_back(
        "RGB transport: pbrt renders with smooth spectra that it makes of the coefficients");
  note_roughness(material, piece.notes);
  piece.code =
      "AttributeBegin\n    MakeNamedMedium \"" + task.identifier + "\" \"string type\" \"homogeneous\"\n";
  piece.code += "        \"rgb sigma_a\" [ " + triple_text(medium.sigma_a, " ") + " ]\n";
  piece.code += "        \"rgb sigma_s\" [ " + triple_text(medium.sigma_s, " ") + " ]\n";
  piece.code += "        \"float g\" [ " + number_text(medium.g) + " ]\n";
  piece.code += "    MediumInterface \"" + task.identifier + "\" \"\"\n" + pbrt_boundary(material);
  piece.code += "    # Shape\nAttributeEnd\n";
  return piece;
}

}  // namespace meander
