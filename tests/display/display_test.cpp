// What a film looks like on a display: the drawn frame against the formula on the CPU, pixel by pixel.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include "core/error.h"
#include "display/capture.h"
#include "display/shaders.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "math/color.h"
#include "support/temporary_folder.h"

namespace meander {
namespace {


// Every pixel and channel its own value, from black over the knee of the curve to beyond white.
Image ramp(int width, int height, int channels) {
  Image image(width, height, channels);
  const float steps = static_cast<float>(image.values.size());
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float t = static_cast<float>(i) / steps;
    image.values[i] = 1.25f * t * t * t;
  }
  return image;
}

int expected_level(float linear, float exposure) {
  const double x = std::clamp(static_cast<double>(linear) * std::exp2(exposure), 0.0, 1.0);
  return static_cast<int>(std::lround(255.0 * static_cast<double>(encode_srgb(static_cast<Real>(x)))));
}

// The whole of a film, pixel for pixel.
Stage whole(const Image& film) {
  return {
      {0, 0, static_cast<float>(film.width), static_cast<float>(film.height)}, film.width, film.height, {}};
}

struct Difference {
  int largest = 0;
  std::size_t differing = 0;
};

Difference difference(const Image8& frame, const Image& linear, float exposure) {
  Difference found;
  for (int y = 0; y < linear.height; ++y) {
    for (int x = 0; x < linear.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int off = std::abs(frame.at(x, y)[c] - expected_level(linear.at(x, y)[c], exposure));
        found.largest = std::max(found.largest, off);
        found.differing += off != 0;
      }
    }
  }
  return found;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK(error.exit_code() == 3);
    return error.what();
  }
  return "";
}

// A folder that goes away with the test, and MEANDER_SHADERS pointing at it as long as it lives.
struct ShaderFolder {
  TemporaryFolder files;
  ShaderFolder() { setenv("MEANDER_SHADERS", files.path().c_str(), 1); }
  ShaderFolder(const ShaderFolder&) = delete;
  ShaderFolder& operator=(const ShaderFolder&) = delete;
  ~ShaderFolder() { unsetenv("MEANDER_SHADERS"); }
};

}  // namespace

TEST_CASE("a frame equals the sRGB formula within one level, at every size") {
  const int sizes[][2] = {{1, 1}, {3, 2}, {2, 3}, {960, 540}};
  for (const auto& size : sizes) {
    CAPTURE(size[0]);
    const Image film = ramp(size[0], size[1], 3);
    const Image8 frame = capture_frame(film, {});
    REQUIRE(frame.width == size[0]);
    REQUIRE(frame.height == size[1]);
    REQUIRE(frame.rgb.size() == film.values.size());
    const Difference off = difference(frame, film, 0);
    CHECK(off.largest <= 1);
    CHECK(static_cast<double>(off.differing) <= 1e-4 * static_cast<double>(frame.rgb.size()));
  }
}

TEST_CASE("the middle of every one of the 256 levels draws as that level") {
  Image film(256, 1, 3);
  for (int level = 0; level < 256; ++level) {
    std::fill_n(film.at(level, 0), 3, static_cast<float>(decode_srgb(static_cast<Real>(level) / 255)));
  }
  const Image8 frame = capture_frame(film, {});
  for (int level = 0; level < 256; ++level) CHECK(frame.at(level, 0)[1] == level);
}

TEST_CASE("films wider or higher than a tile have no seams") {
  for (const auto& [width, height] : {std::pair{2051, 3}, std::pair{3, 2051}}) {
    const Image film = ramp(width, height, 3);
    CHECK(difference(capture_frame(film, {}), film, 0).largest <= 1);
  }
}

TEST_CASE("the longest side a film may have can be captured") {
  const Image film = ramp(16384, 2, 3);
  CHECK(difference(capture_frame(film, {}), film, 0).largest <= 1);
}

TEST_CASE("channels beyond the third are not drawn") {
  Image wide = ramp(7, 5, 6);
  Image plain(7, 5, 3);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) std::copy_n(wide.at(x, y), 3, plain.at(x, y));
  }
  CHECK(capture_frame(wide, {}).rgb == capture_frame(plain, {}).rgb);
}

TEST_CASE("row 0 of the film is the top row of the frame, and red is its first channel") {
  Image film(2, 3, 3);
  film.at(0, 0)[0] = 1;
  film.at(1, 0)[1] = 1;
  film.at(0, 2)[2] = 1;
  const Image8 frame = capture_frame(film, {});
  const std::vector<std::uint8_t> expected = {255, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0};
  CHECK(frame.rgb == expected);
}

TEST_CASE("one stop of exposure doubles the film") {
  Image film = ramp(64, 48, 3);
  const Image8 exposed = capture_frame(film, {.exposure = 1});
  CHECK(difference(exposed, film, 1).largest <= 1);
  const Image8 dark = capture_frame(film, {.exposure = -2.5f});
  CHECK(difference(dark, film, -2.5f).largest <= 1);
  for (float& value : film.values) value *= 2;
  CHECK(exposed.rgb == capture_frame(film, {}).rgb);
  CHECK(dark.rgb != exposed.rgb);
}

TEST_CASE("NaN and negative values show black, infinity shows white, at any exposure") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Image film(3, 1, 3);
  film.values = {nan, infinity, 0.5f, -nan, -infinity, -1.0f, 0.0f, 1e30f, 1e-30f};
  const int half = expected_level(0.5f, 0);
  const std::vector<std::uint8_t> expected = {0, 255, static_cast<std::uint8_t>(half), 0, 0, 0, 0, 255, 0};
  CHECK(capture_frame(film, {}).rgb == expected);
  const std::vector<std::uint8_t> bright = {0, 255, 255, 0, 0, 0, 0, 255, 255};
  CHECK(capture_frame(film, {.exposure = 1000}).rgb == bright);
  const std::vector<std::uint8_t> dark = {0, 255, 0, 0, 0, 0, 0, 0, 0};
  CHECK(capture_frame(film, {.exposure = -1000}).rgb == dark);
}

TEST_CASE("the same film gives the same bytes again") {
  const Image film = ramp(333, 217, 3);
  CHECK(capture_frame(film, {.exposure = 0.3f}).rgb == capture_frame(film, {.exposure = 0.3f}).rgb);
}

TEST_CASE("a view draws correctly in one context after another, and after other state was left on") {
  const Image film = ramp(31, 17, 3);
  for (int round = 0; round < 2; ++round) {
    const Offscreen context(40, 30);
    const Functions& gl = context.functions();
    CHECK(integer(gl, GL_MAJOR_VERSION) * 10 + integer(gl, GL_MINOR_VERSION) >= 33);
    FilmView view(gl);
    FilmTextures textures(gl);
    const Framebuffer target(gl, 40, 30);
    textures.show(ramp(5, 5, 3), 1);
    textures.show(film, 1);  // of another size: not the same, whatever the version says
    target.bind(film.width, film.height);
    for (const GLenum state : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_SCISSOR_TEST}) gl.enable(state);
    gl.scissor(0, 0, 1, 1);
    view.draw(textures, {}, whole(film));
    view.draw(textures, {}, whole(film));
    CHECK(gl.get_error() == GL_NO_ERROR);
    CHECK(difference(target.read(film.width, film.height), film, 0).largest <= 1);
    CHECK(gl.get_error() == GL_NO_ERROR);
  }
}

TEST_CASE("two contexts alive at once keep their own pictures") {
  const Image film = ramp(8, 8, 3);
  const Image black(8, 8, 3);
  Offscreen first(8, 8);
  FilmView first_view(first.functions());
  FilmTextures first_textures(first.functions());
  first_textures.show(film, 1);
  const Framebuffer first_target(first.functions(), 8, 8);
  {
    Offscreen second(8, 8);
    FilmView second_view(second.functions());
    FilmTextures second_textures(second.functions());
    second_textures.show(black, 1);
    const Framebuffer second_target(second.functions(), 8, 8);
    second_target.bind(8, 8);
    second_view.draw(second_textures, {}, whole(black));
    first.make_current();
    first_target.bind(8, 8);
    first_view.draw(first_textures, {}, whole(film));
    second.make_current();
    CHECK(difference(second_target.read(8, 8), black, 0).largest == 0);
  }
  first.make_current();
  CHECK(difference(first_target.read(8, 8), film, 0).largest <= 1);
}

TEST_CASE("an upload beyond the texture limit and a buffer beyond Mesa's are clear errors") {
  const Offscreen context(1, 1);
  FilmTextures textures(context.functions());
  const int limit = integer(context.functions(), GL_MAX_TEXTURE_SIZE);
  const Image wide(limit + 1, 1, 3);
  const std::string upload = message_of([&] { textures.show(wide, 1); });
  CHECK(upload.find(std::to_string(limit + 1) + " x 1") != std::string::npos);
  const std::string buffer = message_of([] { Offscreen(1000000, 1); });
  CHECK(buffer.find("1000000 x 1") != std::string::npos);
}

TEST_CASE("a GL mistake is reported once, with what was being done") {
  const Offscreen context(1, 1);
  const Functions& gl = context.functions();
  gl.disable(0xffff);
  const std::string message = message_of([&] { expect_no_error(gl, "testing"); });
  CHECK(message == "OpenGL: invalid enum while testing");
  CHECK(gl.get_error() == GL_NO_ERROR);
}

TEST_CASE("a shader that does not compile is one line with its file name") {
  const ShaderFolder folder;
  std::ofstream(folder.files.path() / "film.frag") << "#version 330 core\nvoid main() {\n  nonsense;\n}\n";
  const Offscreen context(1, 1);
  const std::string message = message_of([&] { FilmView view(context.functions()); });
  CHECK(message.find((folder.files.path() / "film.frag").string() + " does not compile: ") == 0);
  CHECK(message.find("nonsense") != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("shaders that do not fit together are one line with both file names") {
  const ShaderFolder folder;
  std::ofstream(folder.files.path() / "film.vert") << "#version 330 core\nout vec3 shared_value;\n"
                                                      "void main() { shared_value = gl_Position.xyz; }\n";
  std::ofstream(folder.files.path() / "film.frag")
      << "#version 330 core\nin vec2 shared_value;\nout vec4 color;\n"
         "void main() { color = shared_value.xyxy; }\n";
  const Offscreen context(1, 1);
  const std::string message = message_of([&] { FilmView view(context.functions()); });
  CHECK(message.find("film.vert") != std::string::npos);
  CHECK(message.find("film.frag do not link: ") != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("MEANDER_SHADERS comes first, the source tree last, and a missing shader names every place") {
  const ShaderFolder folder;
  CHECK(shader_source("film.frag").name == MEANDER_SOURCE_DIR "/shaders/film.frag");
  std::ofstream(folder.files.path() / "film.frag") << "mine";
  CHECK(shader_source("film.frag").text == "mine");
  const std::string message = message_of([] { (void)shader_source("none.frag"); });
  CHECK(message.find("none.frag") != std::string::npos);
  CHECK(message.find(folder.files.path().string()) != std::string::npos);
  CHECK(message.find("share/meander/shaders") != std::string::npos);
  CHECK(message.find(MEANDER_SOURCE_DIR "/shaders") != std::string::npos);
}

}  // namespace meander
