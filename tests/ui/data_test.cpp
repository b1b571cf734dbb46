// What the interface computes without drawing: regions, keys, maps, text, edits.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "io/scene_document.h"
#include "ui/bars.h"
#include "ui/dialogs.h"
#include "ui/keys.h"
#include "ui/layout.h"
#include "ui/material_rows.h"
#include "ui/overlays.h"
#include "ui/panels.h"
#include "ui/sample.h"
#include "ui/slider_map.h"
#include "ui/text.h"

namespace meander {
namespace {

bool overlap(const Area& a, const Area& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

float size_of(const Area& area) { return area.width * area.height; }

std::optional<Command> command(int code, Modifiers modifiers = {}) {
  HeldKeys held;
  return command_of(press_key(code, modifiers), held);
}

constexpr Modifiers kShift{true, false, false, false};
constexpr Modifiers kControl{false, true, false, false};
constexpr Modifiers kBoth{true, true, false, false};

}  // namespace

TEST_CASE("the regions tile the window at every size") {
  for (const auto& [width, height] :
       std::vector<std::pair<float, float>>{{960, 540}, {1280, 720}, {1920, 1080}, {640, 400}, {853, 600}}) {
    const Layout layout = layout_of(width, height, false);
    const std::array areas{layout.toolbar,   layout.image,  layout.strip,
                           layout.sparkline, layout.status, layout.panel};
    float covered = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      CHECK(areas[i].x >= 0);
      CHECK(areas[i].y >= 0);
      CHECK(areas[i].x + areas[i].width <= width);
      CHECK(areas[i].y + areas[i].height <= height);
      covered += size_of(areas[i]);
      for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(overlap(areas[i], areas[j]));
    }
    CHECK(covered == doctest::Approx(width * height));
    CHECK(size_of(layout.image) > 0.4f * width * height);
    CHECK(layout.panel.width >= 280);
    CHECK((layout.strip.height > 0) == (height >= 480));
  }
}

TEST_CASE("without an interface the image has the window") {
  const Layout layout = layout_of(1280, 720, true);
  CHECK(layout.image == Area{0, 0, 1280, 720});
  CHECK(size_of(layout.toolbar) + size_of(layout.panel) + size_of(layout.status) + size_of(layout.strip) ==
        0);
}

TEST_CASE("a place in the window and a film pixel lead to one another") {
  OverlayModel overlay;
  overlay.film = {100, 50, 480, 270};
  overlay.film_width = 960;
  overlay.film_height = 540;
  const auto point = film_point(overlay, 340, 185);
  CHECK(point[0] == doctest::Approx(480));
  CHECK(point[1] == doctest::Approx(270));
  const Area area = window_area(overlay, {480, 270, 490, 280});
  CHECK(area == Area{340, 185, 5, 5});
}

TEST_CASE("keys do what they are known for elsewhere") {
  CHECK(command('F')->kind == CommandKind::frame);
  CHECK(command('R')->kind == CommandKind::reset_camera);
  CHECK(command('H')->kind == CommandKind::help);
  CHECK(command(key::kF1)->kind == CommandKind::help);
  CHECK(command('/', kShift)->kind == CommandKind::help);
  CHECK(command(key::kTab)->kind == CommandKind::hide_interface);
  CHECK(command('B', kControl)->kind == CommandKind::hide_interface);
  CHECK(command(key::kSpace)->kind == CommandKind::pause);
  CHECK(command('E')->value == 0.5);
  CHECK(command('E', kShift)->value == -0.5);
  CHECK(command('C')->kind == CommandKind::copy_camera);
  CHECK(command('K')->kind == CommandKind::snapshot);
  CHECK(command(key::kF12)->kind == CommandKind::snapshot);
  CHECK(command(key::kF5)->kind == CommandKind::reload);
  CHECK(command('R', kControl)->kind == CommandKind::reload);
  CHECK(command('S', kControl)->kind == CommandKind::save);
  CHECK(command('O', kControl)->kind == CommandKind::open_browser);
  CHECK(command('Z', kControl)->kind == CommandKind::undo);
  CHECK(command('Z', kBoth)->kind == CommandKind::redo);
  CHECK(command('Y', kControl)->kind == CommandKind::redo);
  CHECK(command('W')->kind == CommandKind::wipe);
  CHECK(command('D')->kind == CommandKind::difference);
  CHECK(command('X')->kind == CommandKind::select_region);
  CHECK(command(key::kEscape)->kind == CommandKind::quit);
  for (int i = 0; i < 8; ++i) CHECK(*command('1' + i) == Command{CommandKind::view, i, 0, {}, {}});
  for (int i = 0; i < 9; ++i)
    CHECK(*command('1' + i, kControl) == Command{CommandKind::restore, i, 0, {}, {}});
  CHECK_FALSE(command('9'));
  CHECK_FALSE(command('L'));
  CHECK_FALSE(command('F', kControl));
}

TEST_CASE("no chord is in the table twice, and every command is in the help") {
  std::set<std::array<int, 4>> chords;
  std::set<CommandKind> told;
  for (const KeyRow& row : key_table()) {
    CHECK(row.keys.empty() == row.meaning.empty());
    if (!row.chord) continue;
    for (int code = row.code; code <= row.last_code; ++code)
      CHECK(chords.insert({code, row.modifiers.shift, row.modifiers.control, row.modifiers.alt}).second);
    if (!row.keys.empty()) told.insert(row.command);
  }
  for (const KeyRow& row : key_table())
    if (row.chord) CHECK(told.contains(row.command));
}

TEST_CASE("a held key repeats only where that is of use") {
  HeldKeys held;
  CHECK(command_of(press_key(key::kSpace), held));
  CHECK_FALSE(command_of(press_key(key::kSpace), held));
  CHECK_FALSE(command_of(release_key(key::kSpace), held));
  CHECK(command_of(press_key(key::kSpace), held));
  CHECK(command_of(press_key('Z', kControl), held));
  CHECK(command_of(press_key('Z', kControl), held));
  InputEvent lost;
  lost.kind = InputKind::focus;  // its release was never seen
  CHECK_FALSE(command_of(lost, held));
  CHECK(command_of(press_key(key::kSpace), held));
  CHECK_FALSE(command_of(press_key(-1), held));
  CHECK_FALSE(command_of(press_key(100000), held));
}

TEST_CASE("Escape closes what is open, one at a time, then the window") {
  UiState state;
  state.help = true;
  state.browser = BrowserUse::open;
  const Command escape{CommandKind::quit, 0, 0, {}, {}};
  CHECK(carry_out(state, escape));
  CHECK(state.browser == BrowserUse::closed);
  CHECK(state.help);
  CHECK(carry_out(state, escape));
  CHECK_FALSE(state.help);
  CHECK_FALSE(carry_out(state, escape));
  CHECK_FALSE(carry_out(state, {CommandKind::undo, 0, 0, {}, {}}));
}

TEST_CASE("slider places and values lead to one another, with exact ends") {
  const ColorMap map(0.3, {Boundary::dielectric, 1.4});
  for (const SliderMap& slider :
       {SliderMap{Spacing::linear, -0.95, 0.95, nullptr},
        SliderMap{Spacing::logarithmic, 6.2e-3, 62, nullptr}, SliderMap{Spacing::color, 0, 1, &map}}) {
    CHECK(value_at(slider, 0) == slider.low);
    CHECK(value_at(slider, 1) == slider.high);
    CHECK(place_of(slider, slider.low) == doctest::Approx(0));
    CHECK(place_of(slider, slider.high) == doctest::Approx(1));
    CHECK(place_of(slider, slider.low - 1) == doctest::Approx(0));
    CHECK(place_of(slider, slider.high + 1) == doctest::Approx(1));
    double before = slider.low;
    for (int i = 1; i <= 50; ++i) {
      const double value = value_at(slider, i / 50.0);
      CHECK(value > before);
      CHECK(place_of(slider, value) == doctest::Approx(i / 50.0).epsilon(1e-6));
      before = value;
    }
  }
}

TEST_CASE("the albedo slider is spaced by the colour that it delivers") {
  const ColorMap map(0);
  const SliderMap slider{Spacing::color, 0, 1, &map};
  CHECK(value_at(slider, 0.5) == doctest::Approx(map.albedo(0.5)));
  CHECK(value_at(slider, 0.5) > 0.9);  // half the colour takes much scattering
}

TEST_CASE("a dragged value is caught by ticks and has no more digits than the pointer can tell") {
  const SliderMap slider{Spacing::linear, -0.95, 0.95, nullptr};
  const std::array<Tick, 1> notch{{{0, "isotropic"}}};
  CHECK(settled(slider, notch, 0.512, {0.02, 0.005}) == 0);
  const double value = settled(slider, notch, 0.7354321, {0.02, 0.005});
  CHECK(value == doctest::Approx(-0.95 + 1.9 * 0.7354321).epsilon(0.002));
  CHECK(std::abs(1e3 * value - std::round(1e3 * value)) < 1e-9);
  CHECK(settled(slider, notch, 1.4, {0.02, 0.005}) == 0.95);
  CHECK(settled(slider, notch, -0.4, {0.02, 0.005}) == -0.95);
}

TEST_CASE("typed numbers are clamped, and what is none is nothing") {
  CHECK(typed_number("0.99990", 0, 1) == 0.9999);
  CHECK(typed_number(" +0,5", 0, 1) == 0.5);
  CHECK(typed_number("7", 0, 1) == 1.0);
  CHECK(typed_number("1e-3", 0, 1) == 1e-3);
  for (const char* wrong : {"", "abc", "1.2.3", "nan", "inf", "0.5 mm"})
    CHECK_FALSE(typed_number(wrong, 0, 1));
}

TEST_CASE("numbers read well") {
  CHECK(significant(0.018, 2) == "0.018");
  CHECK(significant(1234.5, 3) == "1234");
  CHECK(significant(1.0 / 0.0, 3) == "∞");
  CHECK(percent_text(0.018) == "1.8 %");
  CHECK(short_percent(0.01) == "1 %");
  CHECK(duration_text(6.2) == "6.2 s");
  CHECK(duration_text(14.1) == "14 s");
  CHECK(duration_text(125) == "2 min 05 s");
  CHECK(duration_text(59.7) == "1 min 00 s");
  CHECK(duration_text(4320) == "1 h 12 min");
  CHECK(count_text(3.21e6) == "3.21 M");
  CHECK(count_text(128) == "128");
  CHECK(length_text(0.012) == "12 µm");
  CHECK(length_text(1.5) == "1.5 mm");
  CHECK(signed_text(-2.736, 2) == "−2.74");
  CHECK(signed_text(1e-9, 2) == "0.00");
  CHECK(hex_text({1, 0, 0.2140411}) == "#FF007F");
}

TEST_CASE("edits read back exactly") {
  CHECK(edit_text("material.wax.g", 0.1) == "material.wax.g=0.1");
  CHECK(edit_text("a.b", 1.0) == "a.b=1.0");
  CHECK(edit_text("a.b", DVec3(0.15, 1, 1e-7)) == "a.b=[0.15, 1.0, 1e-07]");
  CHECK(edit_text("a.b", std::string_view("matched")) == "a.b=\"matched\"");
  CHECK(edit_text("a.b", false) == "a.b=false");
}

TEST_CASE("the status line is as the design has it") {
  const UiModel model = sample_model();
  CHECK(status_text(model.statistics, 0.01, false) ==
        "128 spp · 6.2 s · noise 1.8 % · 1 % in 14 s · implicit");
  StatisticsModel fresh;
  CHECK(status_text(fresh, 0.01, true) == "0 spp · 0.0 s · paused");
}

TEST_CASE("the time to a noise follows the -1/2 law") {
  StatisticsModel model;
  CHECK_FALSE(seconds_to_noise(model, 0.01));
  model.seconds = 10;
  model.noise = 0.02;
  CHECK(*seconds_to_noise(model, 0.01) == doctest::Approx(30));
  CHECK(*seconds_to_noise(model, 0.05) == 0);
}

TEST_CASE("lengths are scaled with their ratios") {
  const DVec3 scaled = scaled_to({0.15, 0.085, 0.05}, 0.3);
  CHECK(scaled.x == doctest::Approx(0.3));
  CHECK(scaled.y == doctest::Approx(0.17));
  CHECK(scaled.z == doctest::Approx(0.1));
  CHECK(scaled_to(DVec3(0), 0.3) == DVec3(0.3));
}

TEST_CASE("legends have a tick each decade") {
  CHECK(legend_ticks(0.001, 1).size() == 4);
  CHECK(legend_ticks(2, 5) == std::vector<double>{2, 5});
}

TEST_CASE("paths of the browser") {
  CHECK(joined_path("/a/b", "c.toml") == "/a/b/c.toml");
  CHECK(joined_path("/", "c") == "/c");
  CHECK(joined_path("/a", "/x/y") == "/x/y");
  CHECK(parent_folder("/a/b/") == "/a");
  CHECK(parent_folder("/a") == "/");
  CHECK(parent_folder("/") == "/");
}

TEST_CASE("a document takes every change of boundary, one edit after the other") {
  const std::string scene = std::string(MEANDER_SOURCE_DIR) + "/scenes/wax_knot.toml";
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      SceneDocument document = SceneDocument::open(scene);
      MaterialModel model;
      const auto read = [&] { model.now = document.material("wax"); };
      const auto change = [&](int boundary) {
        read();
        for (const std::string& edit : boundary_edits(model, static_cast<Boundary>(boundary)))
          REQUIRE_NOTHROW(document.apply(edit));
        read();
        CHECK(model.now.surface.boundary == static_cast<Boundary>(boundary));
      };
      change(from);
      if (from == 2) document.apply("material.wax.roughness=0.3");
      change(to);
      if (to == 2) CHECK(model.now.surface.ior > 1);
    }
  }
}

}  // namespace meander
