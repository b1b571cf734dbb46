#include "io/scene_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/environment_file.h"
#include "io/material_file.h"
#include "io/mesh_file.h"
#include "io/scene_edit.h"
#include "io/studio.h"

namespace meander {
namespace {

constexpr double kLargestSide = 16384;
constexpr Range kFilmSide{1, kLargestSide, false, false, "a whole number from 1 to 16384"};
constexpr Range kFieldOfView{0, 180, true, true, "greater than 0 and less than 180 degrees"};
constexpr Range kSize{1e-12, 1e12, false, false, "in [1e-12, 1e12]"};
constexpr Range kExposure{-50, 50, false, false, "in [-50, 50] stops"};
constexpr std::array<std::string_view, 2> kUpAxes{"y", "z"};
constexpr std::array<std::string_view, 4> kLightTypes{"rectangle", "sphere", "point", "directional"};
constexpr std::array<std::string_view, 4> kShapes{"sphere", "box", "slab", "torus_knot"};

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void read_camera(TomlTable table, Camera& camera) {
  camera.look_from = table.triple("look_from", kAnyNumber, false).value_or(camera.look_from);
  camera.look_at = table.triple("look_at", kAnyNumber, false).value_or(camera.look_at);
  camera.up = table.triple("up", kAnyNumber, false).value_or(camera.up);
  if (table.has("vertical_fov") && table.has("orthographic_height"))
    throw Error(table.place("orthographic_height"),
                "a camera has vertical_fov or orthographic_height, not both");
  camera.vertical_fov = table.number("vertical_fov", kFieldOfView).value_or(camera.vertical_fov);
  camera.orthographic_height = table.number("orthographic_height", kPositive);
  table.finish();
  const DVec3 view = camera.look_at - camera.look_from;
  if (!(glm::length(view) > 0)) throw Error(table.place("look_at"), "'look_at' must differ from 'look_from'");
  if (!(glm::length(glm::cross(glm::normalize(view), camera.up)) > 1e-9 * glm::length(camera.up)))
    throw Error(table.place("up"), "'up' must not be zero or parallel to the view");
}

void read_film(TomlTable table, FilmSize& film) {
  film.width = static_cast<int>(table.integer("width", kFilmSide).value_or(film.width));
  film.height = static_cast<int>(table.integer("height", kFilmSide).value_or(film.height));
  table.finish();
}

void read_display(TomlTable table, Display& display) {
  display.exposure = table.number("exposure", kExposure).value_or(display.exposure);
  if (const auto tone = table.choice("tone", kToneNames)) display.tone = static_cast<Tone>(*tone);
  table.finish();
}

// `scene_path` is what the image's path is relative to.
void read_environment(TomlTable table, const std::filesystem::path& scene_path, Environment& environment) {
  environment.radiance = Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(0)));
  environment.visible = table.boolean("visible").value_or(true);
  const auto image = table.text("image");
  const double rotation = table.number("rotation", kAnyNumber).value_or(0);
  const double scale = table.number("scale", kNotNegative).value_or(1);
  table.finish();
  if (image && table.has("radiance"))
    throw Error(table.place("radiance"), "an environment has radiance or image, not both");
  for (const char* key : {"rotation", "scale"})
    if (!image && table.has(key))
      throw Error(table.place(key), "'" + std::string(key) + "' belongs to an image; [environment] has none");
  if (image)
    environment.image = load_environment((scene_path.parent_path() / *image).string(), rotation, scale);
}

RectangleLight read_rectangle(TomlTable& table) {
  RectangleLight light;
  light.center = table.required(table.triple("center", kAnyNumber, false), "center");
  light.look_at = table.required(table.triple("look_at", kAnyNumber, false), "look_at");
  light.up = table.triple("up", kAnyNumber, false).value_or(light.up);
  light.width = table.number("width", kPositive).value_or(1);
  light.height = table.number("height", kPositive).value_or(1);
  light.radiance = Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(1)));
  const DVec3 view = light.look_at - light.center;
  if (!(glm::length(view) > 0)) throw Error(table.place("look_at"), "'look_at' must differ from 'center'");
  if (glm::length(glm::cross(glm::normalize(view), light.up)) > 1e-9 * glm::length(light.up)) return light;
  // A light that looks straight up or down is common; any horizontal then serves as its up.
  if (table.has("up"))
    throw Error(table.place("up"), "'up' must not be zero or parallel to the light's view");
  light.up = {0, 0, -1};
  return light;
}

Light read_light(TomlTable table, std::size_t index) {
  Light light;
  light.name = table.text("name").value_or("light" + std::to_string(index + 1));
  const std::size_t type = table.required(table.choice("type", kLightTypes), "type");
  light.visible = table.boolean("visible").value_or(false);
  if (type == 0) {
    light.shape = read_rectangle(table);
  } else if (type == 1) {
    SphereLight sphere;
    sphere.center = table.required(table.triple("center", kAnyNumber, false), "center");
    sphere.radius = table.number("radius", kPositive).value_or(1);
    sphere.radiance = Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(1)));
    light.shape = sphere;
  } else if (type == 2) {
    PointLight point;
    point.position = table.required(table.triple("position", kAnyNumber, false), "position");
    point.intensity = Rgb(table.triple("intensity", kNotNegative, true).value_or(DVec3(1)));
    light.shape = point;
  } else {
    DirectionalLight sun;
    sun.direction = table.required(table.triple("direction", kAnyNumber, false), "direction");
    sun.irradiance = Rgb(table.triple("irradiance", kNotNegative, true).value_or(DVec3(1)));
    if (!(glm::length(sun.direction) > 0))
      throw Error(table.place("direction"), "'direction' must not be zero");
    light.shape = sun;
  }
  table.finish();
  return light;
}

Transform read_transform(TomlTable& object) {
  Transform transform;
  auto table = object.table("transform");
  if (!table) return transform;
  transform.translate = table->triple("translate", kAnyNumber, false).value_or(transform.translate);
  transform.rotate = table->triple("rotate", kAnyNumber, false).value_or(transform.rotate);
  transform.scale = table->triple("scale", kPositive, true).value_or(transform.scale);
  for (int axis = 0; axis < 3; ++axis)
    if (!kSize.contains(transform.scale[axis]))
      throw Error(table->place("scale"), "'scale' is " + short_number(transform.scale[axis]) +
                                             ", but must be " + std::string(kSize.text));
  table->finish();
  return transform;
}

std::string open_edges_warning(const std::string& name, std::size_t count) {
  return name + ": " + std::to_string(count) +
         " open edges: the mesh is not closed, so walks that are lost through it are counted in leaked_walks";
}

class SceneReader {
 public:
  // `mesh` stands for the first mesh file that the scene names, already loaded.
  SceneReader(const toml::table& document, const std::string& path, std::optional<MeshFile> mesh)
      : path_(path), root_(document, path_, "the scene file"), mesh_(std::move(mesh)) {}

  SceneFile read() {
    Scene& scene = file_.scene;
    scene.name = path_;
    double millimetres_per_unit = 1;
    if (auto table = root_.table("scene")) {
      millimetres_per_unit = table->number("millimetres_per_unit", kPositive).value_or(1);
      table->finish();
    }
    if (auto table = root_.table("camera")) read_camera(*table, scene.camera);
    if (auto table = root_.table("film")) read_film(*table, scene.film);
    if (auto table = root_.table("display")) read_display(*table, scene.display);
    if (auto table = root_.table("environment")) read_environment(*table, path_, scene.environment);
    for (const toml::table* table : list("light"))
      scene.lights.push_back(read_light(TomlTable(*table, path_, "[[light]]"), scene.lights.size()));
    for (const toml::table* table : list("material")) read_named_material(*table, millimetres_per_unit);
    for (const toml::table* table : list("object")) read_object(TomlTable(*table, path_, "[[object]]"));
    root_.finish();
    return std::move(file_);
  }

 private:
  // The tables of `[[name]]`.
  std::vector<const toml::table*> list(std::string_view name) {
    std::vector<const toml::table*> tables;
    const toml::array* array = root_.tables(name);
    if (!array) return tables;
    for (const toml::node& element : *array) tables.push_back(element.as_table());
    return tables;
  }

  void read_named_material(const toml::table& raw, double millimetres_per_unit) {
    TomlTable table(raw, path_, "[[material]]");
    const std::string name = table.required(table.text("name"), "name");
    for (const Material& other : file_.scene.materials)
      if (other.name == name)
        throw Error(table.place("name"), "there are two materials named '" + name + "'");
    Material material = read_material(table, millimetres_per_unit);
    material.name = name;
    table.finish();
    file_.scene.materials.push_back(std::move(material));
  }

  std::size_t find_material(const std::string& name, const Place& place) const {
    std::vector<std::string_view> names;
    const auto& materials = file_.scene.materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (materials[i].name == name) return i;
      names.push_back(materials[i].name);
    }
    const std::string nearest = nearest_name(name, names);
    throw Error(
        place, "there is no material named '" + name + "'" +
                   (nearest.empty() ? "; known: " + list_names(names) : "; did you mean '" + nearest + "'?"));
  }

  std::shared_ptr<const Mesh> read_mesh(TomlTable& table, bool translucent) {
    const bool z_up = table.choice("up_axis", kUpAxes).value_or(0) == 1;
    const std::string name = *table.text("mesh");
    const std::filesystem::path path = std::filesystem::path(path_).parent_path() / name;
    MeshFile file = mesh_ ? std::move(*mesh_) : load_named_mesh(path.string(), z_up, table.place("mesh"));
    mesh_.reset();
    const Bounds bounds = bounds_of(file.mesh);
    const double size = glm::length(bounds.high - bounds.low);
    if (!kSize.contains(size))
      throw Error(table.place("mesh"), path.string() + " is " + short_number(size) + " across, but must be " +
                                           std::string(kSize.text));
    if (translucent && file.report.open_edges == 0 &&
        !(signed_volume(file.mesh) > 1e-15 * size * size * size))
      throw Error(table.place("mesh"), path.string() + " encloses no volume, and cannot hold a medium");
    if (translucent && file.report.open_edges > 0)
      file_.warnings.push_back(open_edges_warning(path.string(), file.report.open_edges));
    return std::make_shared<const Mesh>(std::move(file.mesh));
  }

  // An error in the mesh file is one in the scene that names it.
  static MeshFile load_named_mesh(const std::string& path, bool z_up, const Place& place) {
    try {
      return load_mesh(path, z_up);
    } catch (const Error& error) {
      if (error.exit_code() != static_cast<int>(Fault::input)) throw;
      throw Error(place, error.what());
    }
  }

  void read_object(TomlTable table) {
    Object object;
    object.name = table.text("name").value_or("object" + std::to_string(file_.scene.objects.size() + 1));
    const std::string material = table.required(table.text("material"), "material");
    object.material = find_material(material, table.place("material"));
    const bool translucent =
        std::holds_alternative<TranslucentMaterial>(file_.scene.materials[object.material].kind);
    object.transform = read_transform(table);
    if (table.has("shape") == table.has("mesh"))
      throw Error(table.place(), "[[object]] needs either 'shape' or 'mesh'");
    const std::size_t shape = table.choice("shape", kShapes).value_or(kShapes.size());
    if (shape == 0) object.shape = SphereShape{};
    if (shape == 1) object.shape = BoxShape{};
    if (shape == 2) object.shape = SlabShape{};
    if (shape == 3) object.shape = std::make_shared<const Mesh>(make_torus_knot());
    if (shape == kShapes.size()) object.shape = read_mesh(table, translucent);
    table.finish();
    file_.scene.objects.push_back(std::move(object));
  }

  std::string path_;
  TomlTable root_;
  std::optional<MeshFile> mesh_;
  SceneFile file_;
};

std::string read_text(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    throw Error(Place{path, 0, 0}, "is a folder, not a scene file");
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    throw Error(Place{path, 0, 0}, "is not a regular file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(Place{path, 0, 0}, "cannot open: No such file or directory");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

SceneFile load_scene(const std::string& path, std::span<const std::string> edits) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  std::optional<MeshFile> mesh;  // loaded once, for the studio's measures and for its object
  if (extension != ".toml") mesh = load_mesh(path, false);
  try {
    const std::string text =
        mesh ? studio_text(mesh->mesh, std::filesystem::path(path).filename().string()) : read_text(path);
    toml::table document = toml::parse(text, path);
    for (const std::string& edit : edits) apply_edit(document, edit, path);
    return SceneReader(document, path, std::move(mesh)).read();
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw Error(Place{path, static_cast<int>(begin.line), static_cast<int>(begin.column)},
                std::string(error.description()));
  }
}

}  // namespace meander
