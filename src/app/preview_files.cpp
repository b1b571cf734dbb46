#include "app/preview_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <span>

#include "app/run_stats.h"
#include "core/error.h"
#include "display/capture.h"
#include "io/image_file.h"
#include "io/material_export.h"
#include "math/color.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

bool is_one_of(const std::string& extension, std::span<const std::string_view> known) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

constexpr std::array<std::string_view, 4> kMeshes{".ply", ".obj", ".glb", ".stl"};
constexpr std::array<std::string_view, 6> kPictures{".exr", ".hdr", ".pfm", ".png", ".tif", ".tiff"};

// The first object with a medium is what a dropped mesh takes the place of.
std::string subject_of(const Scene& scene) {
  for (const Object& object : scene.objects)
    if (std::holds_alternative<TranslucentMaterial>(scene.materials[object.material].kind) &&
        !std::holds_alternative<SlabShape>(object.shape))
      return object.name;
  throw Error(Fault::input, "the scene has no translucent object whose place the mesh could take");
}

Image linear_picture(const std::string& path) {
  LoadedImage loaded = read_image(path);
  const Image& from = loaded.image;
  Image linear(from.width, from.height, 3);
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = from.at(x, y)[from.channels >= 3 ? c : 0];
        linear.at(x, y)[c] = loaded.encoded ? static_cast<float>(decode_srgb(value)) : value;
      }
    }
  }
  return linear;
}

void open_scene(PreviewTools& tools, const std::string& path) {
  tools.state.change(tools.state.history.now().open_another(path));
  tools.state.settle();
  tools.state.tell(MessageKind::note, "opened " + file_name(path));
}

void compare_with(PreviewTools& tools, const std::string& path) {
  tools.pictures.keep(file_name(path), linear_picture(path));
  PreviewLook& look = tools.state.look;
  look.b = static_cast<int>(tools.pictures.snapshots().size()) - 1;
  if (look.comparison == Comparison::none) look.comparison = Comparison::wipe;
  tools.state.tell(MessageKind::note, file_name(path) + " is B; drag the line to compare");
}

// Comments below the first block would not survive being written.
bool has_inner_comments(const std::string& path) {
  std::ifstream stream(path);
  bool content = false;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string::npos) continue;
    const bool comment = line[start] == '#';
    if (comment && content) return true;
    if (!comment) content = true;
    if (!comment && line.find(" #") != std::string::npos) return true;
  }
  return false;
}

void write_scene(PreviewTools& tools, const std::string& path) {
  const std::string text = tools.state.history.now().text_for(path);
  write_file(path, std::as_bytes(std::span(text)));
}

FilmPlanes planes_of(const Rendering& rendering) { return resolve_planes(rendering.film, nullptr); }

}  // namespace

void open_file(PreviewTools& tools, const std::string& path, bool as_surround) {
  std::error_code unknown;
  if (fs::is_directory(path, unknown))
    throw Error(Fault::input, "'" + path + "' is a folder: choose a file in it");
  const std::string extension = lower_extension(path);
  if (extension == ".toml") return open_scene(tools, path);
  SceneDocument document = tools.state.history.now();
  if (is_one_of(extension, kMeshes)) {
    document.set_object_mesh(subject_of(*tools.state.scene), path);
    tools.state.change(std::move(document));
    tools.state.tell(MessageKind::note,
                     file_name(path) + " took the object's place; material and light stay");
    return;
  }
  if (!is_one_of(extension, kPictures))
    throw Error(Fault::input, "'" + path +
                                  "' is of no type that is read here: a scene is .toml, a mesh .ply .obj " +
                                  ".glb .stl, a picture .exr .hdr .pfm .png .tif");
  if (extension != ".hdr" && !as_surround) return compare_with(tools, path);
  document.set_environment_image(path);
  tools.state.change(std::move(document));
  tools.state.tell(MessageKind::note, file_name(path) + " is the surround; L and Shift with a drag turns it");
}

void save_scene(PreviewTools& tools) {
  const std::string own = tools.state.history.now().path();
  if (lower_extension(own) == ".toml" && !has_inner_comments(own)) return save_scene_as(tools, own);
  fs::path path = own;
  path.replace_filename(path.stem().string() + "-look.toml");
  write_scene(tools, path.string());
  tools.state.settle();
  tools.state.tell(MessageKind::note, "saved " + path.string());
}

void save_scene_as(PreviewTools& tools, const std::string& path) {
  constexpr std::array<std::string_view, 1> kToml{".toml"};
  check_writable(path, kToml);
  write_scene(tools, path);
  SceneDocument moved = tools.state.history.now();
  if (moved.path() != path) {
    moved.move_to(path);
    tools.state.change(std::move(moved));
  }
  tools.state.settle();
  if (path == tools.state.asked.path) tools.state.asked = {};
  tools.state.tell(MessageKind::note, "saved " + path);
}

void save_picture(PreviewTools& tools, const std::string& path) {
  constexpr std::array<std::string_view, 2> kTypes{".exr", ".png"};
  check_writable(path, kTypes);
  const auto rendering = tools.session.rendering(tools.generation);
  const auto& frame = tools.pictures.newest();
  if (!rendering || !frame)
    throw Error(Fault::input, "there is no picture of full resolution yet: wait for its first sample");
  Job job;
  job.scene = frame->scene;
  job.seed = tools.state.settings.seed;
  const ImageAttributes attributes = image_attributes(job, *rendering);
  if (lower_extension(path) == ".exr") {
    const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
    write_exr(path, resolve(rendering->film), channels, attributes,
              {frame->area.x0, frame->area.y0, frame->film_width, frame->film_height});
  } else {
    const Display& display = tools.state.scene->display;
    ViewOptions options;
    options.exposure = static_cast<float>(display.exposure);
    options.tone = display.tone;
    write_png(path, draw_frame(tools.gl, planes_of(*rendering), options), attributes);
  }
  tools.state.tell(MessageKind::note,
                   "saved " + path + ", " + std::to_string(rendering->spp) + " samples a pixel");
}

void copy_material(PreviewTools& tools, std::size_t renderer) {
  const Scene& scene = *tools.state.scene;
  for (const Material& material : scene.materials) {
    const auto* translucent = std::get_if<TranslucentMaterial>(&material.kind);
    if (!translucent || material.name != tools.state.material) continue;
    const ExportedMaterial exported = export_material(
        *translucent, material.name, static_cast<Renderer>(renderer), scene.millimetres_per_unit);
    tools.clipboard.set(exported.text);
    tools.state.tell(exported.notes.empty() ? MessageKind::note : MessageKind::warning,
                     "copied for " + std::string(kRendererNames[renderer]), exported.notes);
    return;
  }
  throw Error(Fault::input,
              "'" + tools.state.material + "' is not translucent: there is nothing to carry over");
}

BrowserModel list_folder(const std::string& folder) {
  BrowserModel model;
  std::error_code failed;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(folder, failed), failed);
  model.folder = absolute.string();
  for (fs::directory_iterator entry(absolute, fs::directory_options::skip_permission_denied, failed), end;
       !failed && entry != end; entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (name.empty() || name[0] == '.') continue;
    std::error_code unknown;
    const bool is_folder = entry->is_directory(unknown);
    const std::string extension = lower_extension(name);
    if (!is_folder && extension != ".toml" && !is_one_of(extension, kMeshes) &&
        !is_one_of(extension, kPictures))
      continue;
    const std::uintmax_t bytes = is_folder ? 0 : entry->file_size(unknown);
    model.entries.push_back({name, is_folder, unknown ? 0 : bytes});
  }
  if (failed) model.error = model.folder + ": " + failed.message();
  std::sort(model.entries.begin(), model.entries.end(), [](const BrowserEntry& a, const BrowserEntry& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
  return model;
}

}  // namespace meander
