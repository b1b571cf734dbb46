// A real window against the off-screen context: the same drawing gives the same pixels. Needs a display.
#include "gl/window.h"

#include <doctest/doctest.h>
#include <dlfcn.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "display/film_view.h"
#include "display/interface_view.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "gl/state.h"

namespace meander {
namespace {

constexpr Extent kSize{700, 500};

Image ramp(int width, int height) {
  Image image(width, height, 3);
  const float steps = static_cast<float>(image.values.size());
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float t = static_cast<float>(i) / steps;
    image.values[i] = 1.25f * t * t * t;
  }
  return image;
}

// The file that the code at an address came from.
std::string library_of(const void* address) {
  Dl_info info{};
  return dladdr(address, &info) != 0 ? info.dli_fname : "";
}

int largest_difference(const Image8& a, const Image8& b) {
  REQUIRE(a.rgb.size() == b.rgb.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
  return largest;
}

}  // namespace

TEST_CASE("a window has its functions from the system's OpenGL, the off-screen context from Mesa's library") {
  const Window window(kSize, "window");
  const Functions& gl = window.functions();
  CHECK(integer(gl, GL_MAJOR_VERSION) * 10 + integer(gl, GL_MINOR_VERSION) >= 33);
  CHECK(library_of(reinterpret_cast<const void*>(gl.draw_arrays)).find("OSMesa") == std::string::npos);
  window.bind();
  clear(gl, 0.6f);
  const Image8 frame = read_pixels(gl, kSize.width, kSize.height);
  CHECK(std::ranges::all_of(frame.rgb, [](std::uint8_t level) { return level == 153; }));
}

}  // namespace meander
