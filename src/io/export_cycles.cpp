// Cycles, by Blender's Python. The names are those of Blender 4.0 and later (docs.blender.org/api/4.2:
// ShaderNodeBsdfPrincipled, ShaderNodeVolumeScatter, ShaderNodeVolumeAbsorption). What the numbers mean is in
// no manual; it was read in the public source of Blender 4.2, intern/cycles/kernel: closure/bssrdf.h (radius
// / 4 pi, g cut to [0, 0.9], ior to [1.01, 3.8]) and integrator/subsurface_random_walk.h (sigma_t = 1 /
// (radius (1 - g)), the albedo cut to [0.2, 0.999999], 256 steps, isotropic after the ninth scattering).
#include <algorithm>
#include <cmath>

#include "io/export_dialects.h"
#include "io/export_text.h"
#include "medium/renderer_colors.h"
#include "medium/similarity.h"

namespace meander {
namespace {

constexpr double kLeastWalkedAlbedo = 0.2;
constexpr double kLargestIndex = 3.8;
constexpr int kWalkLimit = 256;
constexpr int kVolumeLimit = 1024;         // the largest that Blender lets volume_bounces be
constexpr double kLeftAtLimit = 0.01;      // what of a walk's weight may be left at its limit without a note
constexpr double kLargestVolumeG = 0.999;  // closure/volume.h

std::string set_input(const std::string& node, const std::string& input, const std::string& value) {
  return node + ".inputs[\"" + input + "\"].default_value = " + value + '\n';
}

std::string rgba(const DVec3& color) { return "(" + triple_text(color, ", ") + ", 1)"; }

std::string new_material(const std::string& name) {
  return "material = bpy.data.materials.new(" + python_string(name) +
         ")\n"
         "material.use_nodes = True\n"
         "nodes = material.node_tree.nodes\n"
         "links = material.node_tree.links\n"
         "nodes.clear()\n"
         "output = nodes.new(\"ShaderNodeOutputMaterial\")\n";
}

// Whether a walk that never leaves still carries something after so many scatterings.
bool outlives(const DVec3& albedo, int scatterings) {
  return std::pow(std::max({albedo.x, albedo.y, albedo.z}), scatterings) > kLeftAtLimit;
}

// A volume node of one colour and density, which stand for their product.
std::string volume_node(const std::string& node, const std::string& type, const DVec3& color,
                        double density) {
  return node + " = nodes.new(\"" + type + "\")\n" + set_input(node, "Color", rgba(color)) +
         set_input(node, "Density", number_text(density));
}

ExportPiece volume(const ExportTask& task) {
  ExportPiece piece;
  const Coefficients medium = coefficients_of(task.material.medium);
  const double g = std::clamp(medium.g, -kLargestVolumeG, kLargestVolumeG);
  if (g != medium.g)
    piece.notes.push_back("g " + short_text(medium.g) + ": Cycles cuts it to " + short_text(g));
  if (outlives(albedo_of(medium), kVolumeLimit))
    piece.notes.push_back(
        "Cycles ends a path after 1024 scatterings, and with it the light it still carries");
  piece.remarks = {
      "A matched boundary is no surface: a volume alone, sigma_s = Color x Density of the scatter",
      "node, sigma_a = (1 - Color) x Density of the absorption node, Anisotropy = g. Cycles' own limit of",
      "volume bounces is 0; the last two lines raise the scene's."};
  // A density of zero takes any colour.
  const auto largest_of = [](const DVec3& v) { return std::max({v.x, v.y, v.z}); };
  const double scattering = largest_of(medium.sigma_s);
  const double absorption = largest_of(medium.sigma_a);
  const DVec3 scatter_color = scattering > 0 ? medium.sigma_s / scattering : DVec3(0);
  const DVec3 absorption_color = absorption > 0 ? 1.0 - medium.sigma_a / absorption : DVec3(0);
  piece.code = new_material(task.name);
  piece.code += volume_node("scatter", "ShaderNodeVolumeScatter", scatter_color, scattering);
  piece.code += set_input("scatter", "Anisotropy", number_text(g));
  piece.code += volume_node("absorption", "ShaderNodeVolumeAbsorption", absorption_color, absorption);
  piece.code +=
      "volume = nodes.new(\"ShaderNodeAddShader\")\n"
      "links.new(scatter.outputs[\"Volume\"], volume.inputs[0])\n"
      "links.new(absorption.outputs[\"Volume\"], volume.inputs[1])\n"
      "links.new(volume.outputs[\"Shader\"], output.inputs[\"Volume\"])\n"
      "cycles = bpy.context.scene.cycles\n"
      "cycles.max_bounces = max(cycles.max_bounces, 1024)\n"
      "cycles.volume_bounces = max(cycles.volume_bounces, 1024)\n";
  return piece;
}

// The medium as the walk can have it: a g that it would cut is exchanged for one that it takes.
Coefficients walkable(const Coefficients& medium, std::vector<std::string>& notes) {
  const double g = std::clamp(medium.g, kCyclesLeastG, kCyclesLargestG);
  if (g == medium.g) return medium;
  notes.push_back("g " + short_text(medium.g) + ": Cycles takes 0 to 0.9; a similar medium of g " +
                  short_text(g) + " with the same sigma_a and sigma_s (1 - g) stands for it");
  return unreduced(reduced(medium), g);
}

void note_boundary(const TranslucentMaterial& material, std::vector<std::string>& notes) {
  if (has_index_step(material))
    notes.push_back("no light is reflected back inside (ior " + short_text(material.ior) +
                    "): a half-space shows " + short_text(matched_color(material)) + " there and " +
                    short_text(surface_color(material)) +
                    " here. A Glass BSDF around a scattering volume would reflect it, at the price of noise");
  if (material.boundary == Boundary::dielectric)
    notes.push_back("light leaves the body cosine-distributed, not refracted");
  if (material.boundary == Boundary::diffuse)
    notes.push_back("light enters the body refracted, not cosine-distributed");
  if (material.ior > kLargestIndex)
    notes.push_back("ior " + short_text(material.ior) + ": the entering light is refracted by 3.8");
}

void note_walk(const DVec3& albedo, double g, std::vector<std::string>& notes) {
  const double least = std::min({albedo.x, albedo.y, albedo.z});
  const double largest = std::max({albedo.x, albedo.y, albedo.z});
  if (largest > kCyclesLargestAlbedo)
    notes.push_back("a single-scattering albedo above 0.999999 is cut there");
  if (least < kLeastWalkedAlbedo)
    notes.push_back(
        "a single-scattering albedo below 0.2 is walked as 0.2, right for one scattering, too bright beyond");
  if (outlives(albedo, kWalkLimit))
    notes.push_back("Cycles ends a walk after 256 steps, and with it the light it still carries");
  if (g != 0) notes.push_back("Cycles walks isotropically, by similarity, after nine scatterings");
}

ExportPiece subsurface(const ExportTask& task) {
  ExportPiece piece;
  const TranslucentMaterial& material = task.material;
  const Coefficients medium = walkable(coefficients_of(material.medium), piece.notes);
  const DVec3 albedo = albedo_of(medium);
  note_boundary(material, piece.notes);
  note_walk(albedo, medium.g, piece.notes);
  DVec3 color(0);
  for (int c = 0; c < 3; ++c) color[c] = cycles_color(albedo[c], medium.g);
  const DVec3 radius =
      4 * glm::pi<double>() / (1 - medium.g) * mean_free_paths(sigma_t_of(medium), piece.notes);
  const double scale = std::max({radius.x, radius.y, radius.z});
  piece.remarks = {
      "Base Color is not the look but what Cycles' inversion (Wrenninge et al. 2017) turns into our",
      "single-scattering albedo; Radius x Scale = 4 pi / (sigma_t (1 - g)). RANDOM_WALK takes the radius as "
      "it is,",
      "RANDOM_WALK_SKIN would rescale it by the colour. Blender 5.2 calls it RANDOM_WALK_LEGACY."};
  const std::string ior = number_text(material.ior);
  piece.code = new_material(task.name);
  piece.code +=
      "shader = nodes.new(\"ShaderNodeBsdfPrincipled\")\n"
      "methods = shader.bl_rna.properties[\"subsurface_method\"].enum_items.keys()\n"
      "legacy = \"RANDOM_WALK_LEGACY\" in methods\n"
      "shader.subsurface_method = \"RANDOM_WALK_LEGACY\" if legacy else \"RANDOM_WALK\"\n";
  piece.code += set_input("shader", "Base Color", rgba(color));
  piece.code += set_input("shader", "Roughness", number_text(material.roughness));
  piece.code += set_input("shader", "IOR", ior);
  piece.code += set_input("shader", "Subsurface Weight", "1");
  piece.code += set_input("shader", "Subsurface Radius", "(" + triple_text(radius / scale, ", ") + ")");
  piece.code += set_input("shader", "Subsurface Scale", number_text(scale));
  piece.code += set_input("shader", "Subsurface IOR", ior);
  piece.code += set_input("shader", "Subsurface Anisotropy", number_text(medium.g));
  piece.code += "links.new(shader.outputs[\"BSDF\"], output.inputs[\"Surface\"])\n";
  return piece;
}

}  // namespace

ExportPiece cycles_piece(const ExportTask& task) {
  // A matched boundary scatters nothing at the surface, which no subsurface walk of Cycles can do, since its
  // light leaves cosine-distributed: only a volume is the same medium. With an interface the Principled BSDF
  // is what artists tune and what converges; what it loses is said.
  return task.material.boundary == Boundary::matched ? volume(task) : subsurface(task);
}

}  // namespace meander
