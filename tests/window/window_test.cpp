// A real window against the off-screen context: the same drawing gives the same pixels. Needs a display.
#include "gl/window.h"

#include <dlfcn.h>
#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "display/capture.h"
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

// A film, wiped against itself in another size, below an interface of one window; into what is bound.
void draw_frame_of_everything(const Functions& gl) {
  ImGuiContext* context = ImGui::CreateContext();
  {
    FilmView view(gl);
    InterfaceView interface(gl);
    FilmTextures film(gl);
    FilmTextures small(gl);
    film.show(ramp(320, 240), 1);
    small.show(ramp(100, 75), 1);
    clear(gl, 0.15f);
    view.draw_compared(film, small, {Comparison::wipe, 200}, {.exposure = 0.5f},
                       {{40.5f, 30, 320, 240}, kSize.width, kSize.height, {}});
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {static_cast<float>(kSize.width), static_cast<float>(kSize.height)};
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    io.Fonts->SetTexID(interface.upload_font(width, height, pixels));
    ImGui::NewFrame();
    ImGui::ShowDemoWindow();
    ImGui::Render();
    interface.draw(*ImGui::GetDrawData(), kSize.width, kSize.height);
  }
  ImGui::DestroyContext(context);
}

Image8 everything_off_screen() {
  Image8 frame;
  std::thread([&frame] {  // a context belongs to a thread: this one's goes with it
    const Offscreen context(1, 1);
    const Framebuffer target(context.functions(), kSize.width, kSize.height);
    target.bind(kSize.width, kSize.height);
    draw_frame_of_everything(context.functions());
    frame = target.read(kSize.width, kSize.height);
  })
      .join();
  return frame;
}

// Everything that happens within half a second.
std::vector<InputEvent> wait_for_events(Window& window) {
  std::vector<InputEvent> events;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
  while (std::chrono::steady_clock::now() < end) {
    for (InputEvent& event : window.poll(0.05)) events.push_back(std::move(event));
  }
  return events;
}

int run(const std::string& command) { return std::system(command.c_str()); }

bool happened(const std::vector<InputEvent>& events, const auto& what) {
  return std::ranges::any_of(events, what);
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

TEST_CASE(
    "a window shows what the off-screen context shows, while both are alive, one window after another") {
  const Image8 off_screen = everything_off_screen();
  CHECK(std::ranges::count(off_screen.rgb, 38) < static_cast<long>(off_screen.rgb.size() * 3 / 4));
  for (int round = 0; round < 2; ++round) {
    Window window(kSize, "window");
    CHECK(window.framebuffer_size() == kSize);
    window.bind();
    draw_frame_of_everything(window.functions());
    const Image8 before = read_pixels(window.functions(), kSize.width, kSize.height);
    CHECK(largest_difference(before, off_screen) <= 1);
    CHECK(largest_difference(everything_off_screen(), off_screen) == 0);
    window.bind();
    draw_frame_of_everything(window.functions());
    CHECK(largest_difference(read_pixels(window.functions(), kSize.width, kSize.height), off_screen) <= 1);
    window.swap();
    CHECK_FALSE(window.context_lost());
    CHECK(window.functions().get_error() == GL_NO_ERROR);
  }
}

TEST_CASE("a film is saved from a window in the window's own context") {
  const Window window(kSize, "window");
  FilmPlanes planes;
  planes.radiance = Image(1100, 5, 4);
  std::ranges::fill(planes.radiance.values, 0.5f);
  const Image8 frame = draw_frame(window.functions(), planes, {});
  CHECK(std::ranges::all_of(frame.rgb, [](std::uint8_t level) { return level == 188; }));
}

TEST_CASE("size, title, clipboard and closing go the way they are told") {
  Window window(kSize, "window");
  CHECK(window.size() == kSize);
  CHECK(window.content_scale() == doctest::Approx(1));
  window.set_size({900, 600});
  const auto events = wait_for_events(window);
  CHECK(happened(events, [](const InputEvent& e) { return e.kind == InputKind::redraw; }));
  CHECK(window.framebuffer_size() == Extent{900, 600});
  window.set_title("another");
  for (const Cursor cursor : {Cursor::hand, Cursor::text, Cursor::arrow}) window.set_cursor(cursor);
  window.set_clipboard("albedo = 0.9");
  CHECK(window.clipboard() == "albedo = 0.9");
  CHECK_FALSE(window.should_close());
  window.set_should_close(true);
  CHECK(window.should_close());
}

TEST_CASE("another thread ends a wait") {
  Window window(kSize, "window");
  (void)wait_for_events(window);
  const auto start = std::chrono::steady_clock::now();
  std::thread waker([&window] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    window.wake();
  });
  (void)window.poll(20);
  waker.join();
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
}

TEST_CASE("what a user does arrives as events") {
  if (run("command -v xdotool >/dev/null") != 0) {
    MESSAGE("no xdotool here: nobody to do anything");
    return;
  }
  Window window(kSize, "meander input test");
  const auto opening = wait_for_events(window);
  const std::string find = "xdotool search --name 'meander input test' ";
  const auto doing = [&](const std::string& what) {
    REQUIRE(run(find + what) == 0);
    return wait_for_events(window);
  };
  const auto focused = [](const InputEvent& e) { return e.kind == InputKind::focus && e.down; };
  const bool at_once = happened(opening, focused);
  CHECK((happened(doing("windowfocus"), focused) || at_once));
  CHECK(happened(doing("mousemove --window %1 120 80"),
                 [](const InputEvent& e) { return e.kind == InputKind::move && e.x == 120 && e.y == 80; }));
  const auto click = doing("keydown shift click 1 keyup shift");
  for (const bool down : {true, false}) {
    CHECK(happened(click, [down](const InputEvent& e) {
      return e.kind == InputKind::button && e.code == 0 && e.down == down &&
             e.modifiers == Modifiers{.shift = true};
    }));
  }
  CHECK(happened(doing("click 4"),
                 [](const InputEvent& e) { return e.kind == InputKind::scroll && e.y == 1; }));
  const auto typed = doing("key f");
  CHECK(happened(typed,
                 [](const InputEvent& e) { return e.kind == InputKind::key && e.code == 'F' && e.down; }));
  CHECK(
      happened(typed, [](const InputEvent& e) { return e.kind == InputKind::text && e.character == U'f'; }));
  const auto undo = doing("key ctrl+z");
  CHECK(happened(undo, [](const InputEvent& e) {
    return e.kind == InputKind::key && e.code == 'Z' && e.down && e.modifiers == Modifiers{.control = true};
  }));
  CHECK(happened(doing("key F12"),
                 [](const InputEvent& e) { return e.kind == InputKind::key && e.code == key::kF12; }));
}

}  // namespace meander
