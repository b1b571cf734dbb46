// Which files are opened as a scene is read: the kernel tells of every one in the folders watched, whoever
// opens it.
#include <doctest/doctest.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include "core/error.h"
#include "io/image_file.h"
#include "io/mesh_samples.h"
#include "io/scene_file.h"
#include "support/temporary_folder.h"

namespace meander {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// scene/ holds the scene, outside/ what it may not lead to; the working directory is elsewhere/, where files
// of the same names lie in wait.
class Planted {
 public:
  Planted() : started_in_(fs::current_path()) {
    for (const char* folder : {"scene", "scene/parts", "outside", "elsewhere"})
      fs::create_directory(root_.path() / folder);
    for (const char* secret : {"secret.mtl", "secret.png", "secret.bin"}) {
      write(std::string("outside/") + secret, "secret");
      write(std::string("scene/") + secret, "secret");
    }
    for (const char* decoy : {"box.obj", "box.ply", "box.glb"})
      write(std::string("elsewhere/") + decoy, "decoy");
    fs::current_path(root_.path() / "elsewhere");
  }
  Planted(const Planted&) = delete;
  Planted& operator=(const Planted&) = delete;
  ~Planted() { fs::current_path(started_in_); }

  [[nodiscard]] std::string at(const std::string& name) const { return root_.at(name); }
  void write(const std::string& name, const std::string& bytes) const { root_.write(name, bytes); }
  void write_scene(const std::string& mesh) const {
    write("scene/scene.toml",
          "[[material]]\nname = \"wax\"\npreset = \"marble\"\n[[object]]\nmaterial = \"wax\"\nmesh = '" +
              mesh + "'\n");
  }

 private:
  fs::path started_in_;
  TemporaryFolder root_;
};

// Names of the files, from the root, that are opened from its making until they are asked for.
class Recorder {
 public:
  explicit Recorder(const Planted& planted) : queue_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    REQUIRE(queue_ >= 0);
    for (const char* folder : {"scene", "scene/parts", "outside", "elsewhere"}) {
      const int watch = inotify_add_watch(queue_, planted.at(folder).c_str(), IN_OPEN);
      REQUIRE(watch >= 0);
      folders_[watch] = folder;
    }
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder() { close(queue_); }

  [[nodiscard]] Names opened() {
    Names names;
    alignas(inotify_event) std::array<char, 1 << 16> buffer{};
    for (ssize_t got = 0; (got = read(queue_, buffer.data(), buffer.size())) > 0;) {
      for (ssize_t at = 0; at < got;) {
        const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
        if ((event->mask & IN_ISDIR) == 0) names.insert(folders_[event->wd] + '/' + event->name);
        at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      }
    }
    return names;
  }

 private:
  int queue_;
  std::map<int, std::string> folders_;
};

std::string error_of_scene(const Planted& planted) {
  try {
    (void)load_scene(planted.at("scene/scene.toml"), {});
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    return error.what();
  }
  return "";
}

// What reading the scene opens; whether it can be read is not asked.
Names opened_with(const Planted& planted, const std::string& mesh) {
  planted.write_scene(mesh);
  Recorder recorder(planted);
  (void)error_of_scene(planted);
  return recorder.opened();
}

std::string glb_that_names(const std::string& uri) {
  std::string binary;
  for (int k = 0; k < 3; ++k) append(binary, box_corner(1 << k));
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],
"images":[{"uri":")" +
      uri + R"("}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":1,"byteLength":36}],"buffers":[{"byteLength":36},{"byteLength":36,"uri":")" +
      uri + R"("}]})";
  return glb_of(json, binary);
}

}  // namespace

TEST_CASE("the recorder sees what is opened, also by a child") {
  const Planted planted;
  Recorder recorder(planted);
  std::ifstream(planted.at("outside/secret.bin")).get();
  CHECK(recorder.opened() == Names{"outside/secret.bin"});
  CHECK(std::system(("cat '" + planted.at("scene/secret.png") + "' > /dev/null").c_str()) == 0);
  CHECK(recorder.opened() == Names{"scene/secret.png"});
  CHECK(recorder.opened().empty());
}

TEST_CASE("what a mesh names is not opened") {
  const Planted planted;
  for (const std::string& name :
       {std::string("secret.mtl"), std::string("../outside/secret.mtl"), planted.at("outside/secret.mtl")}) {
    CAPTURE(name);
    planted.write("scene/box.obj", "mtllib " + name + "\n" + obj());
    CHECK(opened_with(planted, "box.obj") == Names{"scene/scene.toml", "scene/box.obj"});
    CHECK(error_of_scene(planted).empty());
    std::string ply = ascii_ply();
    planted.write("scene/box.ply", ply.insert(ply.find("element"), "comment TextureFile " + name + "\n"));
    CHECK(opened_with(planted, "box.ply") == Names{"scene/scene.toml", "scene/box.ply"});
    CHECK(error_of_scene(planted).empty());
  }
  for (const std::string& uri :
       {std::string("secret.bin"), std::string("../outside/secret.bin"), planted.at("outside/secret.bin"),
        "file://" + planted.at("outside/secret.bin")}) {
    CAPTURE(uri);
    planted.write("scene/box.glb", glb_that_names(uri));
    CHECK(opened_with(planted, "box.glb") == Names{"scene/scene.toml", "scene/box.glb"});
    CHECK_FALSE(error_of_scene(planted).empty());  // a buffer is missing
  }
}

TEST_CASE("a name in a scene is relative to the scene, and may be any path") {
  const Planted planted;
  planted.write("scene/box.obj", obj());
  planted.write("scene/parts/box.obj", obj());
  planted.write("outside/box.obj", obj());
  fs::create_symlink(planted.at("outside/box.obj"), planted.at("scene/link.obj"));
  const std::array<std::array<std::string, 2>, 5> named{{{"box.obj", "scene/box.obj"},
                                                         {"parts/box.obj", "scene/parts/box.obj"},
                                                         {"../outside/box.obj", "outside/box.obj"},
                                                         {planted.at("outside/box.obj"), "outside/box.obj"},
                                                         {"link.obj", "outside/box.obj"}}};
  for (const auto& [name, file] : named) {
    CAPTURE(name);
    Names opened = opened_with(planted, name);
    opened.erase("scene/link.obj");  // some kernels tell of the link too
    CHECK(opened == Names{"scene/scene.toml", file});
    CHECK(error_of_scene(planted).empty());
  }
  fs::remove(planted.at("scene/box.obj"));
  CHECK(opened_with(planted, "box.obj") == Names{"scene/scene.toml"});  // not that of the working directory
  CHECK(error_of_scene(planted).find("cannot open: No such file") != std::string::npos);
}

TEST_CASE("an environment is the one file that is named") {
  const Planted planted;
  Image light(4, 2, 3);
  for (float& value : light.values) value = 1;
  const std::array<std::string, 3> channels{"R", "G", "B"};
  write_exr(planted.at("outside/sky.exr"), light, channels, {});
  planted.write("scene/scene.toml", "[environment]\nimage = \"../outside/sky.exr\"\n");
  Recorder recorder(planted);
  CHECK(error_of_scene(planted).empty());
  CHECK(recorder.opened() == Names{"scene/scene.toml", "outside/sky.exr"});
}

TEST_CASE("links that lead to no regular file are refused, and a scene that is far too large") {
  const Planted planted;
  fs::create_symlink("/dev/zero", planted.at("scene/zero.obj"));
  fs::create_symlink("/dev/zero", planted.at("scene/zero.exr"));
  fs::create_symlink(planted.at("scene"), planted.at("scene/folder.obj"));
  REQUIRE(mkfifo(planted.at("scene/pipe.obj").c_str(), 0600) == 0);
  const auto error_with = [&](const std::string& mesh) {
    planted.write_scene(mesh);
    return error_of_scene(planted);
  };
  CHECK(error_with("zero.obj").ends_with("zero.obj: is not a regular file"));
  CHECK(error_with("pipe.obj").ends_with("pipe.obj: is not a regular file"));
  CHECK(error_with("folder.obj").find("is a directory") != std::string::npos);
  planted.write("scene/scene.toml", "[environment]\nimage = \"zero.exr\"\n");
  CHECK(error_of_scene(planted).ends_with("zero.exr: it is not a regular file"));
  planted.write("scene/scene.toml", "# a scene\n");
  fs::resize_file(planted.at("scene/scene.toml"), std::uintmax_t{5} << 30);
  CHECK(error_of_scene(planted).find("is larger than 16 MiB") != std::string::npos);
}

}  // namespace meander
