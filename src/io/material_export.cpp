#include "io/material_export.h"

#include <cassert>
#include <set>

#include "io/export_dialects.h"
#include "io/export_text.h"

namespace meander {
namespace {

bool is_xml(Renderer renderer) { return renderer == Renderer::openpbr || renderer == Renderer::mitsuba; }

std::string comment(Renderer renderer, std::string_view text) {
  return is_xml(renderer) ? xml_comment(text) : hash_comment(text);
}

ExportPiece piece_of(Renderer renderer, const ExportTask& task) {
  switch (renderer) {
    case Renderer::cycles:
      return cycles_piece(task);
    case Renderer::arnold:
      return arnold_piece(task);
    case Renderer::renderman:
      return renderman_piece(task);
    case Renderer::openpbr:
      return openpbr_piece(task);
    case Renderer::mitsuba:
      return mitsuba_piece(task);
    case Renderer::pbrt:
      break;
  }
  return pbrt_piece(task);
}

std::string opening(Renderer renderer) {
  const std::string declaration = "<?xml version=\"1.0\"?>\n";
  if (renderer == Renderer::openpbr)
    return declaration + "<materialx version=\"1.39\" colorspace=\"lin_rec709\">\n";
  if (renderer == Renderer::mitsuba) return declaration + "<scene version=\"3.0.0\">\n";
  return {};
}

std::string closing(Renderer renderer) {
  if (renderer == Renderer::openpbr) return "</materialx>\n";
  return renderer == Renderer::mitsuba ? "</scene>\n" : "";
}

std::string heading(Renderer renderer, double millimetres_per_unit) {
  std::string text =
      comment(renderer, "Translucent materials, written by meander. Colours are linear Rec. 709.");
  text += comment(renderer, "Lengths are in the scene's units, of " + number_text(millimetres_per_unit) +
                                " mm each, unless a line says otherwise.");
  return renderer == Renderer::cycles ? text + "import bpy\n" : text;
}

// The identifier, and its surface's, unlike any before.
std::string unique_identifier(const std::string& name, std::set<std::string>& taken) {
  const std::string base = identifier_of(name);
  std::string identifier = base;
  const auto is_taken = [&] { return taken.contains(identifier) || taken.contains(identifier + "_surface"); };
  for (int i = 2; is_taken(); ++i) identifier = base + "_" + std::to_string(i);
  taken.insert({identifier, identifier + "_surface"});
  return identifier;
}

TranslucentMaterial simplified(TranslucentMaterial material) {
  if (material.boundary != Boundary::dielectric) material.roughness = 0;
  if (material.boundary == Boundary::dielectric && material.ior == 1) {
    material.boundary = Boundary::matched;
    material.roughness = 0;
  }
  return material;
}

}  // namespace

DVec3 mean_free_paths(const DVec3& sigma_t, std::vector<std::string>& notes) {
  DVec3 paths(kLongestPath);
  bool cut = false;
  for (int c = 0; c < 3; ++c) {
    cut |= !(sigma_t[c] * kLongestPath > 1);
    if (sigma_t[c] * kLongestPath > 1) paths[c] = 1 / sigma_t[c];
  }
  if (cut)
    notes.push_back("a channel without extinction: a mean free path of 1e9 stands for an infinite one");
  return paths;
}

DVec3 surface_color(const TranslucentMaterial& material) {
  return color_of(DVec3(material.medium.albedo), double{material.medium.g},
                  {material.boundary, material.ior});
}

DVec3 matched_color(const TranslucentMaterial& material) {
  return color_of(DVec3(material.medium.albedo), double{material.medium.g});
}

bool has_index_step(const TranslucentMaterial& material) {
  return material.boundary != Boundary::matched && material.ior > 1;
}

ExportedMaterial export_materials(std::span<const NamedMaterial> materials, Renderer renderer,
                                  double millimetres_per_unit) {
  assert(millimetres_per_unit > 0);
  ExportedMaterial result;
  std::string& text = result.text;
  text = opening(renderer) + heading(renderer, millimetres_per_unit);
  std::set<std::string> taken;
  for (const NamedMaterial& entry : materials) {
    const ExportPiece piece = piece_of(
        renderer,
        {simplified(entry.material), entry.name, unique_identifier(entry.name, taken), millimetres_per_unit});
    text += '\n' + comment(renderer, "Material " + entry.name);
    for (const std::string& remark : piece.remarks) text += comment(renderer, remark);
    for (const std::string& note : piece.notes) {
      text += comment(renderer, "Note: " + note);
      result.notes.push_back((materials.size() > 1 ? entry.name + ": " : "") + note);
    }
    text += piece.code;
  }
  text += closing(renderer);
  return result;
}

ExportedMaterial export_material(const TranslucentMaterial& material, const std::string& name,
                                 Renderer renderer, double millimetres_per_unit) {
  const NamedMaterial entry{name, material};
  return export_materials({&entry, 1}, renderer, millimetres_per_unit);
}

}  // namespace meander
