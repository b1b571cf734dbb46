#include "io/file_stamp.h"

#include <chrono>

#include "io/document_support.h"

namespace meander {
namespace {

using namespace std::chrono_literals;

void set_age(const std::string& file, std::chrono::milliseconds age) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - age);
}

// Another text in the same file, of the same size and time: as of two writes within a step of the clock.
void overwrite(const Folder& folder, const char* name, const std::string& text) {
  const std::string path = folder.at(name);
  const auto time = fs::last_write_time(path);
  REQUIRE(fs::file_size(path) == text.size());
  folder.write(name, text);
  fs::last_write_time(path, time);
}

}  // namespace

TEST_CASE("a file that was written just now has no stamp to rely on") {
  const Folder folder;
  const std::string path = folder.at("a.toml");
  CHECK_FALSE(stamp_of(path).is_there());
  CHECK(stamp_of(path) == FileStamp{path});
  folder.write("a.toml", "four");
  set_age(path, 31ms);
  CHECK(is_settled(stamp_of(path)));
  CHECK(stamp_before_reading(path) == stamp_of(path));
  CHECK(stamp_of(path).bytes == 4);
  set_age(path, 0ms);
  FileStamp now{path, fs::file_time_type::clock::now(), 4};
  CHECK_FALSE(is_settled(now));
  now.time += 1h;  // another machine's
  CHECK(is_settled(now));
}

TEST_CASE("what is written after a mesh was read is read, in the same step of the clock too") {
  const Folder folder;
  folder.write("scene.toml",
               "[[material]]\nname = \"a\"\nalbedo = 0.5\nmean_free_path = 1\n"
               "[[object]]\nname = \"body\"\nmesh = \"body.obj\"\nmaterial = \"a\"\n");
  const auto size_of_body = [](const SceneDocument& document) {
    return bounds_of(*mesh_of(document.scene().scene, "body")).high.x;
  };
  folder.write("body.obj", tetrahedron(1));
  const SceneDocument document = SceneDocument::open(folder.at("scene.toml"));
  bool in_time = false;  // it was read before it had settled
  for (int i = 0; i < 100 && !in_time; ++i) {
    set_age(folder.at("body.obj"), 0ms);
    CHECK(size_of_body(document) == 1);
    in_time = !document.watched_files().at(1).is_there();
    if (!in_time) continue;
    overwrite(folder, "body.obj", tetrahedron(2));
    CHECK(size_of_body(document) == 2);
    set_age(folder.at("body.obj"), 100ms);
    CHECK(mesh_of(document.scene().scene, "body") == mesh_of(document.scene().scene, "body"));
    CHECK(stamp_of(folder.at("body.obj")) == document.watched_files().at(1));
  }
  CHECK(in_time);
}

TEST_CASE("a document knows its files as they were before they were read") {
  const Folder folder;
  folder.write("body.obj", tetrahedron(1));
  folder.write("scene.toml",
               "[[material]]\nname = \"a\"\nalbedo = 0.5\nmean_free_path = 1\n"
               "[[object]]\nmesh = \"body.obj\"\nmaterial = \"a\"\n");
  for (const char* name : {"body.obj", "scene.toml"}) set_age(folder.at(name), 2000ms);
  SceneDocument document = SceneDocument::open(folder.at("scene.toml"));
  document.apply("film.width=9");
  const auto read = document.watched_files();
  REQUIRE(read.size() == 2);
  for (const FileStamp& file : read) CHECK(stamp_of(file.path) == file);
  for (const FileStamp& file : read) set_age(file.path, 1000ms);
  CHECK(document.watched_files().front() == read.front());
  for (const FileStamp& file : document.watched_files()) CHECK_FALSE(stamp_of(file.path) == file);
  (void)document.scene();  // reads the mesh
  CHECK(stamp_of(read[1].path) == document.watched_files()[1]);
  document.move_to(folder.at("new.toml"));
  CHECK(document.watched_files().front() == FileStamp{folder.at("new.toml")});
}

TEST_CASE("a scene file that cannot be read for what it names still names it") {
  const Folder folder;
  const std::string text = "[[material]]\nname = \"a\"\nalbedo = 0.5\nmean_free_path = 1\n";
  folder.write("scene.toml", text);
  const SceneDocument document = SceneDocument::open(folder.at("scene.toml"));
  folder.write("scene.toml", text + "[[object]]\nmesh = \"none.obj\"\nmaterial = \"a\"\n");
  CHECK_THROWS_AS((void)document.reopened(), Error);
  REQUIRE(document.reopened_files().size() == 2);
  CHECK(document.reopened_files()[1].path == folder.at("none.obj"));
  folder.write("scene.toml", "[camera\n");
  CHECK(document.reopened_files().empty());
}

}  // namespace meander
