// Frames of the interface without pixels: what comes of what the user's hands do.
#include <doctest/doctest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.h"
#include "ui/sample.h"
#include "ui/text.h"

namespace meander {
namespace {

// The identifier of a control in a section of the panel.
ImGuiID panel_id(const char* section, const char* control) {
  const ImGuiWindow* panel = ImGui::FindWindowByName("panel");
  REQUIRE(panel != nullptr);
  return ImHashStr(control, 0, ImHashStr(section, 0, panel->ID));
}

ImGuiID window_id(const char* window, const char* control) {
  const ImGuiWindow* found = ImGui::FindWindowByName(window);
  REQUIRE(found != nullptr);
  return ImHashStr(control, 0, found->ID);
}

// A place where the pointer is over the control.
ImVec2 find_control(TestWindow& window, const Area& area, ImGuiID id) {
  for (float y = area.y + 4; y < area.y + area.height; y += 6) {
    for (float x = area.x + 4; x < area.x + area.width; x += 7) {
      window.frame({move_to(x, y)});
      if (ImGui::GetCurrentContext()->HoveredId == id) return {x, y};
    }
  }
  FAIL("there is no such control");
  return {};
}

UiActions click(TestWindow& window, const ImVec2& at, Modifiers modifiers = {}) {
  return window.frame({button(at.x, at.y, true, modifiers), button(at.x, at.y, false, modifiers)});
}

double first_number(const std::string& edit) {
  return std::stod(edit.substr(edit.find_first_of("-0123456789", edit.find('='))));
}

bool has_command(const UiActions& actions, CommandKind kind) {
  return std::any_of(actions.commands.begin(), actions.commands.end(),
                     [&](const Command& command) { return command.kind == kind; });
}

// So far apart that no two clicks are a double one.
void wait(TestWindow& window) {
  window.shape.seconds = 1;
  window.frame();
  window.shape.seconds = 1.0 / 60;
}

}  // namespace

TEST_CASE("a hidden interface draws nothing") {
  TestWindow window(1280, 720);
  window.model.overlay.region = PixelBox{10, 10, 50, 50};
  window.frame();
  CHECK(window.drawn->TotalVtxCount > 1000);
  const Area panel = window.layout().panel;
  CHECK(window.interface.wants_mouse(panel.x + 20, panel.y + 20));
  window.state.hidden = true;
  window.frame();
  window.frame();
  CHECK(window.drawn->TotalVtxCount == 0);
  CHECK_FALSE(window.interface.wants_mouse(panel.x + 20, panel.y + 20));
}

TEST_CASE("dragging a slider edits, in one gesture, and holds the ratios") {
  TestWindow window(1280, 720);
  window.frame();
  const ImVec2 at = find_control(window, window.layout().panel, panel_id("Material", "##length"));
  CHECK(window.interface.pointer_shape() == PointerShape::horizontal);
  CHECK(window.interface.wants_mouse(at.x, at.y));
  const UiActions pressed = window.frame({button(at.x + 20, at.y, true)});
  CHECK(pressed.gesture_started);
  CHECK_FALSE(pressed.gesture_ended);
  double last = 0;
  for (int i = 1; i <= 5; ++i) {
    const UiActions moved = window.frame({move_to(at.x + 20 + 8 * static_cast<float>(i), at.y)});
    REQUIRE(moved.edits.size() == 1);
    CHECK(moved.edits[0].starts_with("material.wax.radius=["));
    CHECK(first_number(moved.edits[0]) > last);
    CHECK_FALSE(moved.gesture_started);
    CHECK_FALSE(moved.gesture_ended);
    last = first_number(moved.edits[0]);
    const std::string middle = moved.edits[0].substr(moved.edits[0].find(',') + 1);
    CHECK(std::stod(middle) / last == doctest::Approx(0.085 / 0.15).epsilon(1e-4));
  }
  const UiActions still = window.frame();
  CHECK(still.edits.empty());
  const UiActions released = window.frame({button(at.x + 60, at.y, false)});
  CHECK(released.gesture_ended);
  CHECK(released.edits.empty());
}

TEST_CASE("Shift drags finer, and from where the slider is") {
  TestWindow window(1280, 720);
  window.frame();
  const ImVec2 at = find_control(window, window.layout().panel, panel_id("Material", "##g"));
  const auto dragged = [&](bool shift) {
    const Modifiers modifiers{shift, false, false, false};
    const float x = window.layout().panel.x + 204;  // near the middle
    window.frame({button(x, at.y, true, modifiers)});
    const UiActions moved = window.frame({move_to(x + 40, at.y, shift)});
    window.frame({button(x + 40, at.y, false, modifiers)});
    wait(window);
    REQUIRE(!moved.edits.empty());
    return first_number(moved.edits.back());
  };
  const double coarse = dragged(false);
  const double fine = dragged(true);
  CHECK(coarse > 0.3);
  CHECK(fine > 0.02);
  CHECK(fine < 0.06);
}

TEST_CASE("a double click resets to what the scene file has") {
  TestWindow window(1280, 720);
  window.model.material.now.g = 0.4;
  window.frame();
  const ImVec2 at = find_control(window, window.layout().panel, panel_id("Material", "##g"));
  CHECK_FALSE(click(window, at).gesture_resumed);
  const UiActions again = click(window, at);
  REQUIRE(!again.edits.empty());
  CHECK(again.edits.back() == "material.wax.g=0.0");
  CHECK(again.gesture_resumed);
}

TEST_CASE("two quick clicks on two sliders are no double click") {
  TestWindow window(1280, 720);
  window.model.material.now.g = 0.4;
  window.frame();
  const ImVec2 at = find_control(window, window.layout().panel, panel_id("Material", "##g"));
  window.state.drag.pressed = 0;
  window.frame({button(at.x, at.y, true), button(at.x, at.y, false)});
  window.state.drag.pressed = 1;  // as though the first had been on another, a few points away
  const UiActions second = click(window, at);
  CHECK_FALSE(second.gesture_resumed);
  CHECK(std::find(second.edits.begin(), second.edits.end(), "material.wax.g=0.0") == second.edits.end());
}

TEST_CASE("Ctrl and a click type a number, beyond the slider's ends, and Enter gives it") {
  TestWindow window(1280, 720);
  window.frame();
  const ImVec2 at = find_control(window, window.layout().panel, panel_id("Material", "##g"));
  UiActions actions = click(window, at, {false, true, false, false});
  window.frame({release_key(key::kLeftControl, {false, true, false, false})});
  CHECK(actions.edits.empty());
  CHECK(window.interface.wants_keyboard());
  for (const char c : std::string("0.9999"))
    actions = window.frame({type_character(static_cast<char32_t>(c))});
  CHECK(actions.edits.empty());  // not while typing
  actions = window.frame({press_key(key::kEnter), release_key(key::kEnter)});
  REQUIRE(actions.edits.size() == 1);
  CHECK(actions.edits[0] == "material.wax.g=0.9999");
  window.frame();
  CHECK_FALSE(window.interface.wants_keyboard());
}

TEST_CASE("Escape leaves a typed number alone; a click elsewhere takes it") {
  for (const bool escape : {true, false}) {
    TestWindow window(1280, 720);
    window.frame();
    const ImVec2 at = find_control(window, window.layout().panel, panel_id("Material", "##g"));
    click(window, at, {false, true, false, false});
    window.frame({release_key(key::kLeftControl, {false, true, false, false})});
    window.frame({type_character('0'), type_character('.')});
    window.frame({type_character('3')});
    UiActions actions;
    if (escape)
      actions = window.frame({press_key(key::kEscape), release_key(key::kEscape)});
    else
      actions = click(window, {200, 60});
    const UiActions after = window.frame();
    actions.edits.insert(actions.edits.end(), after.edits.begin(), after.edits.end());
    CHECK(actions.edits.size() == (escape ? 0 : 1));
  }
}

TEST_CASE("another parametrisation is chosen by writing one of its members") {
  TestWindow window(1280, 720);
  window.frame();
  const int second = 1;
  const ImGuiID button_row = panel_id("Material", "parametrisation");
  const ImGuiID albedo = ImHashStr("segment", 0, ImHashData(&second, sizeof second, button_row));
  const UiActions actions = click(window, find_control(window, window.layout().panel, albedo));
  REQUIRE(actions.edits.size() == 1);
  CHECK(actions.edits[0].starts_with("material.wax.albedo=["));
}

TEST_CASE("buttons say what was asked for, and those that cannot be used nothing") {
  TestWindow window(1280, 720);
  window.frame();
  const Area bar = window.layout().toolbar;
  CHECK(
      has_command(click(window, find_control(window, bar, window_id("toolbar", "undo"))), CommandKind::undo));
  CHECK_FALSE(
      has_command(click(window, find_control(window, bar, window_id("toolbar", "redo"))), CommandKind::redo));
  const UiActions pause = click(window, find_control(window, bar, window_id("toolbar", "pause")));
  CHECK(has_command(pause, CommandKind::pause));
  CHECK(pause.gesture_ended);
}

TEST_CASE("a rectangle is dragged in film pixels") {
  TestWindow window(1280, 720);
  window.model.overlay.film = {0, 38, 480, 270};  // half of 960 x 540
  window.model.overlay.selecting = true;
  window.frame();
  window.frame({move_to(50, 88)});
  window.frame({button(50, 88, true)});
  window.frame({move_to(100, 138)});
  const UiActions actions = window.frame({button(100, 138, false)});
  REQUIRE(actions.commands.size() == 1);
  CHECK(actions.commands[0].kind == CommandKind::set_region);
  CHECK(actions.commands[0].box == PixelBox{100, 100, 200, 200});
}

TEST_CASE("the wipe line is dragged, and the picture beside it is left to the camera") {
  TestWindow window(1280, 720);
  window.model.overlay.film = {0, 38, 900, 506};
  window.model.view.comparison = CompareMode::wipe;
  window.frame();
  CHECK(window.interface.wants_mouse(450, 250));
  CHECK_FALSE(window.interface.wants_mouse(200, 250));
  window.frame({move_to(450, 250)});
  window.frame({button(450, 250, true)});
  const UiActions actions = window.frame({move_to(675, 250)});
  REQUIRE(actions.commands.size() == 1);
  CHECK(actions.commands[0].kind == CommandKind::set_wipe);
  CHECK(actions.commands[0].value == doctest::Approx(0.75));
  CHECK(window.interface.wants_mouse(200, 250));  // while the line is held
  window.frame({button(675, 250, false)});
  CHECK_FALSE(window.interface.wants_mouse(200, 250));
}

TEST_CASE("messages are closed by their number") {
  TestWindow window(1280, 720);
  window.model.messages.push_back({77, MessageKind::error, "wrong", {}, 2});
  window.frame();
  window.frame();
  const ImVec2 at = find_control(window, window.layout().image, window_id("message 77", "dismiss"));
  const UiActions actions = click(window, at);
  REQUIRE(actions.commands.size() == 1);
  CHECK(actions.commands[0] == Command{CommandKind::dismiss, 77, 0, {}, {}});
}

TEST_CASE("Escape closes a list and not the window") {
  TestWindow window(1280, 720);
  window.frame();
  click(window, find_control(window, window.layout().panel, panel_id("Material", "##boundary")));
  window.frame();
  CHECK(window.interface.wants_keyboard());  // so that nobody asks what Escape means
  window.frame({press_key(key::kEscape), release_key(key::kEscape)});
  window.frame();
  CHECK_FALSE(window.interface.wants_keyboard());
}

TEST_CASE("a message that comes while the help is open lies under it, and its place is the help's") {
  TestWindow window(1280, 720);
  window.model.messages.clear();
  window.state.help = true;
  for (int i = 0; i < 3; ++i) window.frame();
  window.model.messages = {{91, MessageKind::note, "something happened", {}, 1}};
  for (int i = 0; i < 3; ++i) window.frame();
  const ImGuiWindow* toast = ImGui::FindWindowByName("message 91");
  const ImGuiWindow* help = ImGui::FindWindowByName("help");
  REQUIRE(toast);
  REQUIRE(help);
  const auto& windows = ImGui::GetCurrentContext()->Windows;
  CHECK(windows.back() == help);
  const ImRect shared = [&] {
    ImRect both = toast->Rect();
    both.ClipWith(help->Rect());
    return both;
  }();
  REQUIRE(shared.GetWidth() > 0);
  REQUIRE(shared.GetHeight() > 0);
  window.frame({move_to(shared.GetCenter().x, shared.GetCenter().y)});
  CHECK(ImGui::GetCurrentContext()->HoveredWindow == help);
  window.state.help = false;
  for (int i = 0; i < 2; ++i) window.frame();
  window.frame({move_to(shared.GetCenter().x, shared.GetCenter().y)});
  CHECK(ImGui::GetCurrentContext()->HoveredWindow == toast);
}

TEST_CASE("a list that is opened while the help is open lies over it") {
  TestWindow window(960, 540);
  window.model.messages.clear();
  window.state.help = true;
  for (int i = 0; i < 3; ++i) window.frame();
  click(window, find_control(window, window.layout().toolbar, window_id("toolbar", "##view")));
  for (int i = 0; i < 3; ++i) window.frame();
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  REQUIRE(context.OpenPopupStack.Size == 1);
  const ImGuiWindow* list = context.OpenPopupStack[0].Window;
  REQUIRE(list);
  ImRect shared = list->Rect();
  shared.ClipWith(ImGui::FindWindowByName("help")->Rect());
  REQUIRE(shared.GetHeight() > 0);
  window.frame({move_to(shared.GetCenter().x, shared.GetCenter().y)});
  CHECK(context.HoveredWindow == list);
}

TEST_CASE("two interfaces live side by side") {
  TestWindow first(1280, 720);
  TestWindow second(960, 540);
  first.frame();
  second.state.help = true;
  second.frame();
  first.frame();
  CHECK(first.drawn->DisplaySize.x == 1280);
  CHECK(second.drawn->DisplaySize.x == 960);
}

TEST_CASE("another scale makes another font, and the same layout") {
  TestWindow window(2560, 1440, 2);
  const int before = window.interface.font().height * window.interface.font().width;
  window.interface.set_font_texture(nullptr);
  window.frame();
  CHECK_FALSE(window.interface.font_changed());
  CHECK(window.drawn->DisplaySize.x == 1280);
  window.shape = {1280, 720, 1};
  window.frame();
  CHECK(window.interface.font_changed());
  CHECK(window.interface.font().height * window.interface.font().width < before);
  CHECK(window.drawn->DisplaySize.x == 1280);
}

TEST_CASE("a font that is none is an error that says so") {
  REQUIRE(setenv("MEANDER_FONT", MEANDER_SOURCE_DIR "/README.md", 1) == 0);
  CHECK_THROWS_WITH_AS(Interface(1), doctest::Contains("MEANDER_FONT"), Error);
  REQUIRE(unsetenv("MEANDER_FONT") == 0);
}

}  // namespace meander
