// The verb convert.
#include <algorithm>
#include <iostream>
#include <memory>

#include "app/command_line.h"
#include "core/error.h"
#include "io/material_export.h"
#include "io/output_file.h"
#include "io/scene_file.h"

namespace meander {
namespace {

struct ConvertOptions {
  std::string scene;
  std::string renderer;
  std::optional<std::string> material;
  std::string output;
  std::vector<std::string> edits;
};

[[noreturn]] void refuse_name(const std::string& what, const std::string& name,
                              std::span<const std::string_view> known) {
  const std::string nearest = nearest_name(name, known);
  throw Error(Fault::input,
              "there is no " + what + " '" + name + "'; " +
                  (nearest.empty() ? "known: " + list_names(known) : "did you mean '" + nearest + "'?"));
}

Renderer renderer_of(const std::string& name) {
  const auto found = std::ranges::find(kRendererNames, name);
  if (found == kRendererNames.end()) refuse_name("renderer", name, kRendererNames);
  return static_cast<Renderer>(found - kRendererNames.begin());
}

std::vector<NamedMaterial> translucent_materials(const Scene& scene) {
  std::vector<NamedMaterial> found;
  for (const Material& material : scene.materials)
    if (const auto* translucent = std::get_if<TranslucentMaterial>(&material.kind))
      found.push_back({material.name, *translucent});
  if (found.empty())
    throw Error(Place{scene.name, 0, 0}, "has no translucent material, and no other can be converted");
  return found;
}

std::vector<NamedMaterial> choose(const Scene& scene, const std::optional<std::string>& name) {
  std::vector<NamedMaterial> all = translucent_materials(scene);
  if (!name) return all;
  std::vector<std::string_view> names;
  for (const NamedMaterial& material : all) {
    if (material.name == *name) return {material};
    names.push_back(material.name);
  }
  const bool opaque =
      std::ranges::any_of(scene.materials, [&](const Material& material) { return material.name == *name; });
  if (opaque)
    throw Error(Fault::input, "the material '" + *name + "' is not translucent, or has a radius of 0; " +
                                  "translucent: " + list_names(names));
  refuse_name("translucent material", *name, names);
}

int run_convert(const ConvertOptions& options) {
  const Renderer renderer = renderer_of(options.renderer);
  const std::array<std::string_view, 1> extension{kRendererExtensions[static_cast<std::size_t>(renderer)]};
  if (!options.output.empty()) check_writable(options.output, extension);
  const SceneFile file = load_scene(options.scene, options.edits);
  refuse_overwriting("--output", options.output, file.files);
  const Scene& scene = file.scene;
  const std::vector<NamedMaterial> materials = choose(scene, options.material);
  const std::string text = export_materials(materials, renderer, scene.millimetres_per_unit).text;
  if (options.output.empty())
    std::cout << text;
  else
    write_file(options.output, std::as_bytes(std::span(text)));
  return 0;
}

}  // namespace

void add_convert_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("convert", "write the translucent materials of a scene in another renderer's terms");
  const auto o = std::make_shared<ConvertOptions>();
  verb->add_option("SCENE", o->scene, "scene file (.toml) or mesh")->required()->check(file_name());
  verb->add_option("--to", o->renderer, list_names(kRendererNames))->required();
  verb->add_option("--material", o->material, "this one alone (all translucent ones)");
  verb->add_option("-o,--output", o->output, "file to write (standard output)")->check(file_name());
  verb->add_option("--set", o->edits, "PATH=VALUE: any scene value, such as material.wax.g=0.4 (repeatable)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->callback([o, &action] { action = [o] { return run_convert(*o); }; });
}

}  // namespace meander
