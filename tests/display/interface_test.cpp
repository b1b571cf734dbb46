// The interface's vertices as pixels: a real Dear ImGui context, drawn off-screen.
#include "display/interface_view.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "gl/state.h"

namespace meander {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 150;
using Level = std::array<int, 3>;

// One ImGui context, its font in the view.
struct Interface {
  ImGuiContext* context = ImGui::CreateContext();
  explicit Interface(InterfaceView& view, float scale = 1) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {kWidth / scale, kHeight / scale};
    io.DisplayFramebufferScale = {scale, scale};
    io.DeltaTime = 1.0f / 60;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    io.Fonts->SetTexID(view.upload_font(width, height, pixels));
  }
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  ~Interface() { ImGui::DestroyContext(context); }
};

template <typename Draw>
Image8 drawn(const Functions& gl, const InterfaceView& view, Draw draw) {
  const Framebuffer target(gl, kWidth, kHeight);
  target.bind(kWidth, kHeight);
  clear(gl, 0.0f);
  ImGui::NewFrame();
  draw();
  ImGui::Render();
  view.draw(*ImGui::GetDrawData(), kWidth, kHeight);
  CHECK(gl.get_error() == GL_NO_ERROR);
  return target.read(kWidth, kHeight);
}

Level level_at(const Image8& frame, int x, int y) {
  const std::uint8_t* at = frame.at(x, y);
  return {at[0], at[1], at[2]};
}

// Pixels of that level within x0 <= x < x1, y0 <= y < y1.
int count(const Image8& frame, const Level& level, const std::array<int, 4>& box) {
  int found = 0;
  for (int y = box[1]; y < box[3]; ++y) {
    for (int x = box[0]; x < box[2]; ++x) found += level_at(frame, x, y) == level;
  }
  return found;
}

constexpr Level kBlack{0, 0, 0};
constexpr std::array<int, 4> kAll{0, 0, kWidth, kHeight};

}  // namespace

TEST_CASE("a filled rectangle covers its pixels, in its colour, and no other") {
  for (int round = 0; round < 2; ++round) {  // one context after another
    const Offscreen context(1, 1);
    InterfaceView view(context.functions());
    const Interface interface(view);
    const Image8 frame = drawn(context.functions(), view, [] {
      ImGui::GetForegroundDrawList()->AddRectFilled({20, 30}, {60, 40}, IM_COL32(10, 200, 30, 255));
    });
    CHECK(count(frame, {10, 200, 30}, {20, 30, 60, 40}) == 400);
    CHECK(count(frame, kBlack, kAll) == kWidth * kHeight - 400);
  }
}

TEST_CASE("what is half transparent is blended as encoded values") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view);
  const Image8 frame = drawn(context.functions(), view, [] {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.AddRectFilled({0, 0}, {50, 50}, IM_COL32(200, 100, 0, 255));
    list.AddRectFilled({0, 0}, {50, 50}, IM_COL32(0, 100, 200, 51));  // a fifth
  });
  const Level mixed = level_at(frame, 25, 25);
  CHECK(std::abs(mixed[0] - 160) <= 1);
  CHECK(mixed[1] == 100);
  CHECK(std::abs(mixed[2] - 40) <= 1);
}

TEST_CASE("nothing is drawn outside the clip rectangle") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view);
  const Image8 frame = drawn(context.functions(), view, [] {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.PushClipRect({10, 20}, {40, 25});
    list.AddRectFilled({0, 0}, {100, 100}, IM_COL32_WHITE);
    list.PopClipRect();
  });
  CHECK(count(frame, {255, 255, 255}, {10, 20, 40, 25}) == 150);
  CHECK(count(frame, kBlack, kAll) == kWidth * kHeight - 150);
}

TEST_CASE("points become pixels by the framebuffer's scale, clipping too") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view, 2);
  const Image8 frame = drawn(context.functions(), view, [] {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.PushClipRect({0, 0}, {30, 100});
    list.AddRectFilled({20, 10}, {40, 20}, IM_COL32_WHITE);
    list.PopClipRect();
  });
  CHECK(count(frame, {255, 255, 255}, {40, 20, 60, 40}) == 400);
  CHECK(count(frame, kBlack, kAll) == kWidth * kHeight - 400);
}

TEST_CASE("a picture is drawn where it is put, the right way up") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view);
  Image8 quarters(2, 2);
  quarters.rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0};
  Picture picture(context.functions());
  picture.upload(quarters);
  const Image8 frame = drawn(context.functions(), view, [&] {
    ImGui::GetForegroundDrawList()->AddImage(InterfaceView::texture_id(picture), {100, 50}, {140, 90});
  });
  CHECK(level_at(frame, 102, 52) == Level{255, 0, 0});
  CHECK(level_at(frame, 137, 52) == Level{0, 255, 0});
  CHECK(level_at(frame, 102, 87) == Level{0, 0, 255});
  CHECK(level_at(frame, 137, 87) == Level{255, 255, 0});
  CHECK(level_at(frame, 99, 52) == kBlack);
}

TEST_CASE("a window with text has light pixels on its background, inside its frame alone") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view);
  const auto window = [](const char* text) {
    ImGui::SetNextWindowPos({20, 20});
    ImGui::SetNextWindowSize({120, 80});
    ImGui::Begin("title", nullptr, ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextUnformatted(text);
    ImGui::End();
  };
  drawn(context.functions(), view, [&] { window("mmmm"); });  // the first frame of a window only measures it
  const Image8 frame = drawn(context.functions(), view, [&] { window("mmmm"); });
  const Image8 other = drawn(context.functions(), view, [&] { window("iiii"); });
  CHECK(count(frame, kBlack, {20, 20, 140, 100}) < 16);  // the corners
  CHECK(count(frame, kBlack, kAll) >= kWidth * kHeight - 120 * 80);
  CHECK(frame.rgb != other.rgb);
  int light = 0;
  for (int y = 42; y < 60; ++y) {
    for (int x = 20; x < 100; ++x) light += level_at(frame, x, y)[0] > 200;
  }
  CHECK(light > 20);
}

TEST_CASE("meshes of more vertices than an index can count are whole") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view);
  const Image8 frame = drawn(context.functions(), view, [] {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    for (int i = 0; i < kWidth * kHeight; ++i) {  // 120000 vertices
      const auto x = static_cast<float>(i % kWidth);
      const auto y = static_cast<float>(i / kWidth);
      list.AddRectFilled({x, y}, {x + 1, y + 1}, IM_COL32(i % 251, i % 241, 255, 255));
    }
  });
  int wrong = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    wrong += level_at(frame, i % kWidth, i / kWidth) != Level{i % 251, i % 241, 255};
  }
  CHECK(wrong == 0);
}

TEST_CASE("the interface's shader is kept when its new text does not compile") {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  const Interface interface(view);
  setenv("MEANDER_SHADERS", MEANDER_SOURCE_DIR "/tests/display/broken", 1);
  std::string message;
  try {
    view.reload();
  } catch (const Error& error) {
    message = error.what();
  }
  unsetenv("MEANDER_SHADERS");
  CHECK(message.find("tests/display/broken/interface.frag does not compile: ") != std::string::npos);
  const Image8 frame = drawn(context.functions(), view, [] {
    ImGui::GetForegroundDrawList()->AddRectFilled({0, 0}, {10, 10}, IM_COL32_WHITE);
  });
  CHECK(count(frame, {255, 255, 255}, kAll) == 100);
  view.reload();
}

}  // namespace meander
