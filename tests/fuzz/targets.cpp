#include "fuzz/targets.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/error.h"
#include "io/image_file.h"
#include "io/material_export.h"
#include "io/mesh_file.h"
#include "io/scene_document.h"

namespace meander {
namespace {


void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

void require_sound(const Error& error) {
  const std::string line = error.what();
  require(error.exit_code() == 2,
          "an input's error has exit code 2, not " + std::to_string(error.exit_code()) + ": " + line);
  const bool printable = std::none_of(line.begin(), line.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f;
  });
  require(printable, "an error is one printable line: " + line);
}

void require_sound(const Mesh& mesh) {
  const auto within = [](const std::vector<Triangle>& triangles, std::size_t count) {
    return std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
      return std::max({t[0], t[1], t[2]}) < count;
    });
  };
  require(!mesh.triangles.empty(), "a mesh has a triangle");
  require(within(mesh.triangles, mesh.positions.size()), "a mesh's triangles have corners");
  require(within(mesh.normal_triangles, mesh.normals.size()), "a mesh's corners have normals");
  for (const DVec3& p : mesh.positions)
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "a mesh is finite");
}

// Size as one digit, so that messages and not numbers tell inputs apart.
std::string magnitude(std::size_t count) {
  return std::to_string(count < 2 ? count : std::llround(std::log2(count)));
}

std::string try_mesh(std::string_view extension, const FuzzFolder& folder, std::string_view bytes) {
  const std::string path = folder.write("input." + std::string(extension), bytes);
  const MeshFile file = load_mesh(path, false);
  require_sound(file.mesh);
  return "mesh " + magnitude(file.mesh.positions.size()) + ' ' + magnitude(file.mesh.triangles.size()) + ' ' +
         magnitude(file.mesh.normals.size()) + ' ' + magnitude(file.report.open_edges) + ' ' +
         magnitude(file.report.dropped_triangles) + (file.report.flipped ? " flipped" : "");
}

std::string_view picture_name(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return "input.exr";
  if (bytes.starts_with("\x89PNG"sv)) return "input.png";
  if (bytes.starts_with("PF"sv) || bytes.starts_with("Pf"sv)) return "input.pfm";
  if (bytes.starts_with("II"sv) || bytes.starts_with("MM"sv)) return "input.tif";
  return "input.hdr";
}

std::string try_image(const FuzzFolder& folder, std::string_view bytes) {
  const std::string_view name = picture_name(bytes);
  const LoadedImage loaded = read_image(folder.write(name, bytes));
  const Image& image = loaded.image;
  const std::size_t count = image.values.size();
  require(image.width > 0 && image.height > 0 && image.channels > 0, "a picture has pixels");
  require(count == static_cast<std::size_t>(image.width) * image.height * image.channels,
          "a picture has all of its values");
  require(loaded.channels.size() == static_cast<std::size_t>(image.channels), "channels have names");
  return std::string(name) + ' ' + magnitude(static_cast<std::size_t>(image.width)) + ' ' +
         magnitude(static_cast<std::size_t>(image.height)) + ' ' +
         magnitude(static_cast<std::size_t>(image.channels)) + ' ' +
         magnitude(loaded.attributes.text.size()) + ' ' + magnitude(loaded.attributes.integers.size());
}

void export_everywhere(const Scene& scene) {
  std::vector<NamedMaterial> materials;
  for (const Material& material : scene.materials) {
    if (const auto* translucent = std::get_if<TranslucentMaterial>(&material.kind))
      materials.push_back({material.name, *translucent});
  }
  if (materials.empty()) return;
  for (std::size_t r = 0; r < kRendererNames.size(); ++r)
    (void)export_materials(materials, static_cast<Renderer>(r), scene.millimetres_per_unit);
}

std::vector<std::string> edits_in(std::string_view text) {
  constexpr std::string_view kMark = "# --set ";
  std::vector<std::string> edits;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line) && edits.size() < 4;)
    if (line.starts_with(kMark)) edits.push_back(line.substr(kMark.size()));
  return edits;
}

std::string try_scene(const FuzzFolder& folder, std::string_view bytes) {
  SceneDocument document = folder.read_scene(bytes);
  std::string outcome;
  for (const std::string& edit : edits_in(bytes)) {
    try {
      document.apply(edit);
      outcome += "edited ";
    } catch (const Error& error) {
      require_sound(error);
      outcome += "refused ";
    }
  }
  const std::string text = document.text();
  const std::string again = folder.read_scene(text).text();
  require(again == text, "a scene's text reads back the same");
  const Scene scene = document.scene().scene;
  export_everywhere(scene);
  return outcome + "scene " + magnitude(scene.lights.size()) + ' ' + magnitude(scene.materials.size()) + ' ' +
         magnitude(scene.objects.size());
}

std::string try_reader(FuzzTarget target, const FuzzFolder& folder, std::string_view bytes) {
  if (target == FuzzTarget::scene) return try_scene(folder, bytes);
  if (target == FuzzTarget::image) return try_image(folder, bytes);
  return try_mesh(kFuzzTargetNames[static_cast<std::size_t>(target)], folder, bytes);
}

}  // namespace

std::optional<FuzzTarget> fuzz_target_of(std::string_view name) {
  const auto found = std::find(kFuzzTargetNames.begin(), kFuzzTargetNames.end(), name);
  if (found == kFuzzTargetNames.end()) return std::nullopt;
  return static_cast<FuzzTarget>(found - kFuzzTargetNames.begin());
}

FuzzFolder::FuzzFolder() {
  (void)write("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  Image light(4, 2, 3);
  std::fill(light.values.begin(), light.values.end(), 0.5f);
  const std::array<std::string, 3> names{"R", "G", "B"};
  write_exr(at("light.exr"), light, names, {});
  first_scene_ = SceneDocument::from_text("", at("input.toml"));
}

SceneDocument FuzzFolder::read_scene(std::string_view text) const {
  (void)write("input.toml", text);
  return first_scene_->reopened();
}

FuzzOutcome try_input(FuzzTarget target, const FuzzFolder& folder, std::string_view bytes) {
  try {
    return {true, try_reader(target, folder, bytes)};
  } catch (const Error& error) {
    require_sound(error);
    return {false, error.what()};
  }
}

double processor_seconds() {
  double seconds = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

}  // namespace meander
