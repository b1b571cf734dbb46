#include <doctest/doctest.h>

#include "app/preview_desk.h"
#include "io/image_file.h"
#include "io/material_export.h"

using namespace meander;

namespace {

constexpr const char* kOpenMesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("a mesh takes the object's place; material, light and camera stay, and it is one step of undo") {
  const Folder folder;
  folder.write("open.obj", kOpenMesh);
  Desk desk(kKnot);
  const SceneDocument before = desk.now();
  desk.carry_out(CommandKind::open, 0, folder.at("open.obj"));
  const Scene scene = desk.now().scene().scene;
  const Scene old = before.scene().scene;
  CHECK(std::holds_alternative<std::shared_ptr<const Mesh>>(scene.objects[0].shape));
  CHECK(desk.now().watched_files().size() == 2);
  CHECK(desk.now().material("wax").color == before.material("wax").color);
  CHECK(scene.lights.size() == old.lights.size());
  CHECK(scene.camera.look_from == old.camera.look_from);
  desk.carry_out(CommandKind::undo);
  CHECK(desk.now() == before);
}

TEST_CASE("pictures become B of a comparison, and skies the surround") {
  const Folder folder;
  Desk desk(kKnot);
  desk.carry_out(CommandKind::save_picture, 0, folder.at("a.exr"));
  desk.carry_out(CommandKind::open, 0, folder.at("a.exr"));
  CHECK(desk.state.look.b == 0);
  CHECK(desk.state.look.comparison == Comparison::wipe);
  CHECK(desk.now() == desk.state.original);
  PreviewTools tools = desk.tools();
  open_file(tools, folder.at("a.exr"), true);
  CHECK(desk.now().environment().image == folder.at("a.exr"));
  CHECK_THROWS_AS(desk.carry_out(CommandKind::restore, 0), Error);
}

TEST_CASE("what cannot be read leaves everything as it was") {
  const Folder folder;
  folder.write("broken.toml", "[camera\n");
  folder.write("empty.ply", "");
  folder.write("notes.txt", "nothing");
  folder.write("empty.png", "");
  folder.write("empty.hdr", "");
  Desk desk(kKnot);
  const SceneDocument before = desk.now();
  for (const char* name :
       {"broken.toml", "empty.ply", "notes.txt", "empty.png", "empty.hdr", "missing.stl"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(desk.carry_out(CommandKind::open, 0, folder.at(name)), Error);
    CHECK(desk.now() == before);
    CHECK(desk.pictures.snapshots().empty());
    CHECK_FALSE(desk.state.history.can_undo());
  }
}

TEST_CASE("a scene is saved under its own name, one with comments within beside it") {
  const Folder folder;
  const std::string text = "# a look\n" + SceneDocument::open(kKnot).text();
  folder.write("plain.toml", text);
  folder.write("noted.toml", text + "\n# a note at the end\n");
  Desk plain(folder.at("plain.toml"));
  plain.carry_out(CommandKind::save);
  CHECK(SceneDocument::open(folder.at("plain.toml")) == plain.now());
  CHECK(plain.now() == plain.state.original);
  Desk noted(folder.at("noted.toml"));
  const std::string before = contents(folder.at("noted.toml"));
  noted.carry_out(CommandKind::save);
  CHECK(contents(folder.at("noted.toml")) == before);
  CHECK(SceneDocument::open(folder.at("noted-look.toml")).text() == noted.now().text());
  CHECK_THROWS_AS(noted.carry_out(CommandKind::save_scene, 0, folder.at("x.txt")), Error);
  CHECK_THROWS_AS(noted.carry_out(CommandKind::save_scene, 0, folder.at("nowhere/x.toml")), Error);
}

TEST_CASE("a picture is saved linear with its variance, and as it is shown") {
  const Folder folder;
  Desk desk(kKnot);
  desk.carry_out(CommandKind::save_picture, 0, folder.at("a.exr"));
  desk.carry_out(CommandKind::save_picture, 0, folder.at("a.png"));
  const LoadedImage linear = read_image(folder.at("a.exr"));
  REQUIRE(linear.image.channels == 6);
  CHECK(linear.image.width == 32);
  CHECK(find_integer(linear.attributes, "meander/spp") == 4);
  const FilmPlanes& planes = desk.pictures.live()->planes;
  for (int c = 0; c < 3; ++c) CHECK(linear.image.at(9, 9)[c] == planes.radiance.at(9, 9)[c]);
  CHECK(read_image(folder.at("a.png")).image.height == 18);
  CHECK_THROWS_AS(desk.carry_out(CommandKind::save_picture, 0, folder.at("a.jpg")), Error);
}

TEST_CASE("every renderer's material goes to the clipboard, as convert writes it") {
  Desk desk(kKnot);
  for (std::size_t i = 0; i < kRendererNames.size(); ++i) {
    desk.copied.clear();
    desk.carry_out(CommandKind::copy_as, static_cast<std::int64_t>(i));
    const auto& wax = std::get<TranslucentMaterial>(desk.state.scene->materials[0].kind);
    CHECK(desk.copied == export_material(wax, "wax", static_cast<Renderer>(i), 1).text);
  }
  desk.carry_out(CommandKind::copy_camera);
  CHECK(desk.copied == camera_text(desk.state.scene->camera));
}

TEST_CASE("a folder is listed with folders first, and only what can be opened") {
  const Folder folder;
  for (const char* name : {"b.toml", "a.OBJ", "c.txt", ".hidden.toml", "z/inside.exr"})
    folder.write(name, "x");
  const BrowserModel model = list_folder(folder.at(""));
  REQUIRE(model.entries.size() == 3);
  CHECK(model.entries[0].name == "z");
  CHECK(model.entries[0].folder);
  CHECK(model.entries[1].name == "a.OBJ");
  CHECK(model.entries[2].bytes == 1);
  CHECK(model.error.empty());
  CHECK_FALSE(list_folder(folder.at("missing")).error.empty());
}

TEST_CASE("a snapshot brings its parameters back, and comparisons survive when one before them goes") {
  Desk desk(kKnot);
  const SceneDocument first = desk.now();
  desk.carry_out(CommandKind::snapshot);
  desk.carry_out(CommandKind::camera_view, 2);
  desk.render();
  desk.carry_out(CommandKind::snapshot);
  CHECK_FALSE(desk.now() == first);
  desk.carry_out(CommandKind::restore, 0);
  CHECK(desk.now() == first);
  desk.carry_out(CommandKind::set_b, 1);
  CHECK(desk.state.look.comparison == Comparison::wipe);
  desk.carry_out(CommandKind::drop_snapshot, 0);
  CHECK(desk.state.look.b == 0);
  desk.carry_out(CommandKind::drop_snapshot, 0);
  CHECK(desk.state.look.comparison == Comparison::none);
}
