// Environment images through the scene file: which keys, which pictures, and what is refused.
#include "io/environment_file.h"

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "io/image_file.h"
#include "io/scene_file.h"
#include "support/temporary_folder.h"

using namespace meander;

namespace {

namespace fs = std::filesystem;

// A folder with pictures, gone with the test.
struct Folder {
  TemporaryFolder files;
  Folder() { fs::create_directory(files.path() / "sky"); }

  [[nodiscard]] std::string file(const std::string& name) const { return files.at(name); }

  [[nodiscard]] Environment load(const std::string& keys, const std::vector<std::string>& edits = {}) const {
    files.write("scene.toml", "[environment]\n" + keys);
    return load_scene(file("scene.toml"), edits).scene.environment;
  }

  // The message without the folder.
  [[nodiscard]] std::string error_of(const std::string& keys) const {
    try {
      (void)load(keys);
    } catch (const Error& error) {
      CHECK(error.exit_code() == 2);
      const std::string message = error.what();
      CHECK(message.find('\n') == std::string::npos);
      return message.starts_with(files.path().string()) ? message.substr(files.path().string().size() + 1)
                                                        : message;
    }
    return "no error";
  }
};

// Texel (x, y) has the red x + 1 and the green y + 1.
Image numbered(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<float>(x + 1);
      if (channels > 1) image.at(x, y)[1] = static_cast<float>(y + 1);
    }
  return image;
}

const std::array<std::string, 3> kRgb{"R", "G", "B"};

}  // namespace

TEST_CASE("an environment image is found beside the scene, turned and scaled as asked") {
  const Folder folder;
  write_exr(folder.file("sky/a.exr"), numbered(9, 5, 3), kRgb, {});
  const Environment plain = folder.load("image = \"sky/a.exr\"\n");
  REQUIRE(plain.image);
  CHECK(plain.visible);
  CHECK(plain.image->radiance({0, 0, -1}) == Rgb(5, 3, 0));
  CHECK(plain.image->radiance({1, 0, 0}) == Rgb(7, 3, 0));
  CHECK(plain.image->radiance({0, 1, 0}).y == 1);
  const Environment turned =
      folder.load("image = \"sky/a.exr\"\nrotation = 90\nscale = 2\nvisible = false\n");
  CHECK(turned.image->radiance({-1, 0, 0}) == Rgb(10, 6, 0));
  CHECK_FALSE(turned.visible);
  const Environment edited = folder.load("image = \"sky/a.exr\"\n", {"environment.rotation=90"});
  CHECK(edited.image->radiance({-1, 0, 0}) == Rgb(5, 3, 0));
  const Environment by_edit = folder.load("", {"environment.image=sky/a.exr"});
  CHECK(by_edit.image->radiance({0, 0, -1}) == Rgb(5, 3, 0));
  CHECK_FALSE(folder.load("radiance = 1\n").image);
}

TEST_CASE("a Radiance picture lights a scene") {
  const Folder folder;
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  const std::array<unsigned char, 8> pixels{128, 64, 32, 129, 128, 128, 128, 132};
  std::ofstream(folder.file("a.hdr"), std::ios::binary)
      << header << std::string(pixels.begin(), pixels.end());
  const Environment environment = folder.load("image = \"a.hdr\"\n");
  CHECK(environment.image->radiance({-1, 0, 0}) == Rgb(1, Real(0.5), Real(0.25)));
  CHECK(environment.image->radiance({1, 0, 0}) == Rgb(8));
}

TEST_CASE("channels are found by name") {
  const Folder folder;
  Image image(1, 1, 4);
  image.values = {7, 3, 2, 1};
  const std::array<std::string, 4> names{"depth", "B", "G", "R"};
  write_exr(folder.file("a.exr"), image, names, {});
  CHECK(folder.load("image = \"a.exr\"\n").image->radiance({0, 1, 0}) == Rgb(1, 2, 3));
}

TEST_CASE("keys that contradict each other are refused") {
  const Folder folder;
  write_exr(folder.file("a.exr"), numbered(2, 1, 3), kRgb, {});
  CHECK(folder.error_of("image = \"a.exr\"\nradiance = 1\n") ==
        "scene.toml:3:12: an environment has radiance or image, not both");
  CHECK(folder.error_of("radiance = 1\nrotation = 3\n") ==
        "scene.toml:3:12: 'rotation' belongs to an image or a sky; [environment] has none");
  CHECK(folder.error_of("scale = 3\n") ==
        "scene.toml:2:9: 'scale' belongs to an image or a sky; [environment] has none");
  CHECK(folder.error_of("image = \"a.exr\"\nscale = -1\n") ==
        "scene.toml:3:9: 'scale' is -1, but must be 0 or more");
  CHECK(folder.error_of("image = 3\n") == "scene.toml:2:9: 'image' must be text in quotes, not a number");
  CHECK(folder.error_of("imgae = \"a.exr\"\n") ==
        "scene.toml:2:1: unknown key 'imgae' in [environment]; did you mean 'image'?");
}

TEST_CASE("pictures that are no environment are refused by name") {
  const Folder folder;
  CHECK(folder.error_of("image = \"none.exr\"\n") ==
        "cannot read " + folder.file("none.exr") + ": No such file or directory");
  write_png(folder.file("a.png"), Image8(4, 2), {});
  CHECK(folder.error_of("image = \"a.png\"\n").starts_with("a.png: is display-encoded"));
  write_exr(folder.file("crop.exr"), numbered(4, 2, 3), kRgb, {}, {0, 2, 4, 4});
  CHECK(folder.error_of("image = \"crop.exr\"\n").starts_with("crop.exr: its data window"));
  const std::array<std::string, 1> grey{"Y"};
  write_exr(folder.file("grey.exr"), numbered(4, 2, 1), grey, {});
  CHECK(folder.error_of("image = \"grey.exr\"\n") ==
        "grey.exr: has no channel R; an environment needs R, G and B");
  Image bad = numbered(4, 2, 3);
  bad.at(3, 1)[2] = std::numeric_limits<float>::quiet_NaN();
  write_exr(folder.file("nan.exr"), bad, kRgb, {});
  CHECK(folder.error_of("image = \"nan.exr\"\n").starts_with("nan.exr: pixel (3, 1) is [4, 2, nan], but"));
  bad.at(3, 1)[2] = -1;
  write_exr(folder.file("dark.exr"), bad, kRgb, {});
  CHECK(folder.error_of("image = \"dark.exr\"\n").starts_with("dark.exr: pixel (3, 1) is [4, 2, -1], but"));
}
