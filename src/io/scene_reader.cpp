#include "io/scene_reader.h"

#include <array>
#include <filesystem>
#include <sstream>

#include "io/camera_file.h"
#include "io/document_state.h"
#include "io/light_file.h"
#include "io/material_file.h"

namespace meander {
namespace {

constexpr double kLargestSide = 16384;
constexpr Range kFilmSide{1, kLargestSide, false, false, "a whole number from 1 to 16384"};
constexpr Range kSize{1e-12, 1e12, false, false, "in [1e-12, 1e12]"};
constexpr Range kExposure{-50, 50, false, false, "in [-50, 50] stops"};
constexpr std::array<std::string_view, 2> kUpAxes{"y", "z"};
constexpr std::array<std::string_view, 4> kShapes{"sphere", "box", "slab", "torus_knot"};

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
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

Environment read_environment(TomlTable table, const std::string& scene_path, SceneCache& cache) {
  Environment environment;
  environment.radiance = Rgb(table.triple("radiance", kNotNegative, true).value_or(DVec3(0)));
  environment.visible = table.boolean("visible").value_or(true);
  const auto image = table.text("image");
  const auto sky = table.choice("sky", kSkyNames);
  const double rotation = table.number("rotation", kAnyNumber).value_or(0);
  const double scale = table.number("scale", kNotNegative).value_or(1);
  table.finish();
  if (image && sky) throw Error(table.place("sky"), "an environment has sky or image, not both");
  if ((image || sky) && table.has("radiance"))
    throw Error(table.place("radiance"),
                std::string("an environment has radiance or ") + (image ? "image" : "sky") + ", not both");
  for (const char* key : {"rotation", "scale"})
    if (!image && !sky && table.has(key))
      throw Error(table.place(key),
                  "'" + std::string(key) + "' belongs to an image or a sky; [environment] has none");
  if (image) environment.image = cache.picture(named_file(scene_path, *image), rotation, scale);
  if (sky) environment.image = cache.sky(static_cast<Sky>(*sky), rotation, scale);
  return environment;
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
  SceneReader(const toml::table& document, const std::string& path, SceneCache& cache)
      : path_(path), root_(document, path_, "the scene file"), cache_(cache) {}

  SceneFile read() {
    Scene& scene = file_.scene;
    scene.name = path_;
    if (auto table = root_.table("scene")) {
      scene.millimetres_per_unit = table->number("millimetres_per_unit", kPositive).value_or(1);
      table->finish();
    }
    if (auto table = root_.table("camera")) scene.camera = read_camera(*table);
    if (auto table = root_.table("film")) read_film(*table, scene.film);
    if (auto table = root_.table("display")) read_display(*table, scene.display);
    if (auto table = root_.table("environment")) scene.environment = read_environment(*table, path_, cache_);
    for (const toml::table* table : list("light"))
      scene.lights.push_back(read_light(TomlTable(*table, path_, "[[light]]"), scene.lights.size()));
    for (const toml::table* table : list("material")) read_named_material(*table);
    for (const toml::table* table : list("object")) read_object(TomlTable(*table, path_, "[[object]]"));
    root_.finish();
    cache_.trim(scene.objects.size());
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

  void read_named_material(const toml::table& raw) {
    TomlTable table(raw, path_, "[[material]]");
    const std::string name = table.required(table.text("name"), "name");
    for (const Material& other : file_.scene.materials)
      if (other.name == name)
        throw Error(table.place("name"), "there are two materials named '" + name + "'");
    Material material = read_material(table, {file_.scene.millimetres_per_unit, cache_.color_maps()});
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
    const std::string path = named_file(path_, *table.text("mesh"));
    const auto cached = load_named_mesh(path, z_up, table.place("mesh"));
    if (!kSize.contains(cached->size))
      throw Error(table.place("mesh"), path + " is " + short_number(cached->size) + " across, but must be " +
                                           std::string(kSize.text));
    const std::size_t open_edges = cached->report.open_edges;
    if (translucent && open_edges == 0 &&
        !(cached->volume > 1e-15 * cached->size * cached->size * cached->size))
      throw Error(table.place("mesh"), path + " encloses no volume, and cannot hold a medium");
    if (translucent && open_edges > 0) file_.warnings.push_back(open_edges_warning(path, open_edges));
    return cached->mesh;
  }

  // An error in the mesh file is one in the scene that names it; a bare mesh file is its own scene.
  std::shared_ptr<const CachedMesh> load_named_mesh(const std::string& path, bool z_up, const Place& place) {
    try {
      return cache_.mesh(path, z_up);
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
    if (shape == 3) object.shape = cache_.torus_knot();
    if (shape == kShapes.size()) object.shape = read_mesh(table, translucent);
    table.finish();
    file_.scene.objects.push_back(std::move(object));
  }

  std::string path_;
  TomlTable root_;
  SceneCache& cache_;
  SceneFile file_;
};

}  // namespace

SceneFile read_scene(const toml::table& document, const std::string& path, SceneCache& cache) {
  SceneFile file = SceneReader(document, path, cache).read();
  file.files = files_of(document, path);
  file.files.push_back(path);
  return file;
}

std::string named_file(const std::string& scene_path, const std::string& name) {
  return (std::filesystem::path(scene_path).parent_path() / name).string();
}

}  // namespace meander
