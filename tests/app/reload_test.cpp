// A scene that changes while it is reloaded: what is read is a scene or an error, and in the end the last
// one.
#include <doctest/doctest.h>

#include <atomic>

#include "app/file_watch.h"
#include "app/preview_desk.h"

using namespace meander;

namespace {

constexpr int kVersions = 60;

std::string scene_text(int version) {
  return "[camera]\nlook_from = [0, 0, 5]\n\n[[material]]\nname = \"wax\"\nalbedo = 0.5\nmean_free_path = " +
         std::to_string(1000 + version) +
         "\n\n[[object]]\nname = \"body\"\nmesh = \"body.obj\"\nmaterial = \"wax\"\n";
}

std::string mesh_text(int version) {
  return "v 0 0 0\nv " + std::to_string(1000 + version) +
         " 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

// As an editor without care does it: the old file is cut to nothing, and the new one comes piece by piece.
void write_slowly(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  for (std::size_t at = 0; at < text.size(); at += 1 + text.size() / 3) {
    out << text.substr(at, 1 + text.size() / 3) << std::flush;
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
}

double size_of_body(const Scene& scene) {
  return bounds_of(*std::get<std::shared_ptr<const Mesh>>(scene.objects.at(0).shape)).high.x;
}

}  // namespace

TEST_CASE("a scene and a mesh that change while they are reloaded end as what was written last") {
  const Folder folder;
  folder.write("scene.toml", scene_text(0));
  folder.write("body.obj", mesh_text(0));
  const std::string path = folder.at("scene.toml");
  SceneDocument document = SceneDocument::open(path);
  FileWatch watch;
  watch.watch(document.watched_files());
  REQUIRE(document.watched_files().size() == 2);
  std::atomic<bool> written{false};
  std::thread writer([&] {
    for (int version = 1; version <= kVersions; ++version) {
      write_slowly(folder.at("body.obj"), mesh_text(version));
      write_slowly(path, scene_text(version));
      // Two writings of one size at one time of the file system's clock would be the same to any reader.
      if (version % 10 == 9) std::this_thread::sleep_for(std::chrono::milliseconds(35));
    }
    written = true;
  });
  int reloads = 0;
  // Without the patience of the watch as well, so that many a file is read half.
  const auto reload = [&] {
    try {
      SceneDocument fresh = document.reopened();
      (void)fresh.scene();
      document = std::move(fresh);
      ++reloads;
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
  };
  while (!written) {
    (void)watch.changed();
    reload();
  }
  writer.join();
  std::this_thread::sleep_for(std::chrono::milliseconds(40));
  if (!watch.changed().empty()) reload();
  CHECK(reloads > 0);
  const Scene scene = document.reopened().scene().scene;
  CHECK(size_of_body(scene) == 1000 + kVersions);
  CHECK(std::get<TranslucentMaterial>(scene.materials.at(0).kind).medium.sigma_t.x ==
        doctest::Approx(1.0 / (1000 + kVersions)));
}
