// What the storm does in a step.
#include <doctest/doctest.h>

#include <algorithm>

#include "app/storm.h"
#include "core/error.h"
#include "medium/presets.h"

namespace meander {

void Storm::send(InputKind kind, double x, double y, int code, bool down, Modifiers modifiers) {
  InputEvent event;
  event.kind = kind;
  event.x = x;
  event.y = y;
  event.code = code;
  event.down = down;
  event.modifiers = modifiers;
  previewer_.feed(event);
}

void Storm::resize(int width, int height) {
  target_ = std::make_unique<Framebuffer>(context_.functions(), width, height);
  width_ = width;
  height_ = height;
  send(InputKind::redraw, 0, 0);
}

std::string Storm::rgb(double low, double high) {
  std::string text = "[";
  for (int c = 0; c < 3; ++c) text += (c > 0 ? ", " : "") + std::to_string(number(low, high));
  return text + "]";
}

std::string Storm::a_material_edit() {
  constexpr std::array<std::string_view, 3> kBoundaries{"matched", "diffuse", "dielectric"};
  constexpr std::array<std::string_view, 3> kLocks{"look", "sigma_t", "sigma_s_reduced"};
  const std::string path = "material." + previewer_.state().material + '.';
  switch (whole(0, 9)) {
    case 0:
      return path + "albedo=" + rgb(0, 1);
    case 1:
      return path + "mean_free_path=" + rgb(0.01, 0.4);
    case 2:
      return path + "g=" + std::to_string(number(-1.1, 1.1));
    case 3:
      return path + "boundary=" + one_of(kBoundaries);
    case 4:
      return path + "ior=" + std::to_string(number(0.9, 2));
    case 5:
      return path + "roughness=" + std::to_string(number(0, 1));
    case 6:
      return path + "preset=" + std::string(presets()[static_cast<std::size_t>(whole(0, 9))].name);
    case 7:
      return path + "sigma_s=" + rgb(0.5, 20);
    case 8:
      return path + "g_lock=" + one_of(kLocks);
    default:
      return path + "color=" + rgb(-0.05, 1.02);
  }
}

std::string Storm::an_edit() {
  switch (whole(0, 7)) {
    case 0:
      return "film.width=" + std::to_string(whole(24, 96));
    case 1:
      return "film.height=" + std::to_string(whole(16, 64));
    case 2:
      return "display.exposure=" + std::to_string(number(-2, 2));
    case 3:
      return "light.key.radiance=" + rgb(0, 40);
    case 4:
      return "camera.vertical_fov=" + std::to_string(number(10, 80));
    default:
      return a_material_edit();
  }
}

void Storm::edit() {
  const std::string text = an_edit();
  CAPTURE(text);
  try {
    previewer_.apply(text);
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    ++refused;
  }
}

Command Storm::a_command() {
  using enum CommandKind;
  constexpr std::array<int, 4> kScales{100, 50, 25, 100};
  const auto i = static_cast<std::size_t>(whole(0, 3));
  Command command{rig, static_cast<std::int64_t>(i), 0, {}, {}};
  switch (whole(0, 11)) {
    case 0:
      return {environment, whole(0, 2), 0, {}, {}};
    case 1:
      return {environment, 3, 0, {}, folder_.at(i < 2 ? "light.exr" : "missing.hdr")};
    case 2:
      return {render_scale, kScales[i], 0, {}, {}};
    case 3:
      return {set_region, 0, 0, {whole(0, 9), whole(0, 9), whole(10, 120), whole(10, 80)}, {}};
    case 4:
      return {region_only, whole(0, 1), 0, {}, {}};
    case 5:
      return {threads, whole(0, 3), 0, {}, {}};  // 0: all
    case 6:
      return {estimator, whole(0, 1), 0, {}, {}};
    case 7:
      return {camera_view, whole(0, 5), 0, {}, {}};
    case 8:
      return {save_picture, 0, 0, {}, folder_.at(i < 2 ? "out.exr" : "out.png")};
    case 9:
      return {i < 2 ? set_a : set_b, whole(-1, 3), 0, {}, {}};
    case 10:
      return {drop_snapshot, whole(0, 5), 0, {}, {}};
    default:
      return command;
  }
}

// Any key of the table but the last rows of it: Escape ends the previewer, and the file dialogs stay shut, so
// that no later click in them leaves the folder.
void Storm::key() {
  const auto rows = key_table();
  const KeyRow& row = rows[static_cast<std::size_t>(whole(0, static_cast<int>(rows.size()) - 1))];
  if (!row.chord || row.command == CommandKind::quit) return;
  const int code = whole(row.code, row.last_code);
  send(InputKind::key, 0, 0, code, true, row.modifiers);
  if (row.repeats && whole(0, 1) == 0) send(InputKind::key, 0, 0, code, true, row.modifiers);
  frame();
  send(InputKind::key, 0, 0, code, false, row.modifiers);
}

void Storm::click(int times) {
  // Twice only over the panel, where nothing opens a file.
  const double x = times == 1 ? number(0, width_) : number(std::max(width_ - 280, 0), width_);
  const double y = times == 1 ? number(0, height_) : number(60, std::max(height_, 61));
  send(InputKind::move, x, y);
  frame();
  Modifiers modifiers;
  modifiers.control = whole(0, 5) == 0;
  for (int i = 0; i < times; ++i) {
    send(InputKind::button, x, y, whole(0, 9) == 0 ? 1 : 0, true, modifiers);
    frame();
    for (const int button : {0, 1}) send(InputKind::button, x, y, button, false, modifiers);
  }
  if (!modifiers.control) return;
  frame();  // a number, where a field took the click
  for (const char c : std::to_string(number(-2, 2))) {
    InputEvent event;
    event.kind = InputKind::text;
    event.character = static_cast<char32_t>(c);
    previewer_.feed(event);
  }
  for (const bool down : {true, false}) send(InputKind::key, 0, 0, key::kEnter, down);
}

void Storm::drag() {
  double x = number(0, width_);
  double y = number(0, height_);
  const int button = whole(0, 2);
  Modifiers modifiers;
  modifiers.shift = whole(0, 2) == 0;
  const bool light = whole(0, 3) == 0;
  if (light) send(InputKind::key, 0, 0, 'L', true);
  send(InputKind::move, x, y);
  frame();
  send(InputKind::button, x, y, button, true, modifiers);
  for (int i = whole(1, 8); i > 0; --i) {
    x += number(-60, 60);
    y += number(-60, 60);
    send(InputKind::move, x, y);
    if (whole(0, 1) == 0) frame();
    if (whole(0, 15) == 0) undo_run();
  }
  send(InputKind::button, x, y, button, false, modifiers);
  if (light) send(InputKind::key, 0, 0, 'L', false);
}

void Storm::wheel() {
  send(InputKind::move, number(0, width_), number(0, height_));
  frame();
  send(InputKind::scroll, 0, whole(-3, 3));
}

void Storm::drop() {
  constexpr std::array<std::string_view, 9> kFiles{"other.toml", "broken.toml", "notes.txt",
                                                   "empty.ply",  "tetra.obj",   "open.obj",
                                                   "light.exr",  "scene.toml",  "missing.ply"};
  InputEvent event;
  event.kind = InputKind::drop;
  event.x = number(0, width_);
  event.y = number(0, height_);
  event.paths = {folder_.at(one_of(kFiles))};
  if (whole(0, 3) == 0) event.paths.push_back(folder_.at(one_of(kFiles)));
  previewer_.feed(event);
}

void Storm::undo_run() {
  const CommandKind kind = whole(0, 2) == 0 ? CommandKind::redo : CommandKind::undo;
  for (int i = whole(1, 12); i > 0; --i) previewer_.carry_out({kind, 0, 0, {}, {}});
}

void Storm::step() {
  const int kind = whole(0, 19);
  if (kind < 6) {
    edit();
  } else if (kind < 9) {
    key();
  } else if (kind < 11) {
    drag();
  } else if (kind < 14) {
    click(whole(1, 2));
  } else if (kind == 14) {
    wheel();
  } else if (kind == 15) {
    drop();
  } else if (kind == 16) {
    undo_run();
  } else if (kind == 17) {
    const bool large = whole(0, 9) == 0;
    resize(whole(64, large ? 1600 : 700), whole(64, large ? 900 : 500));
  } else {
    previewer_.carry_out(a_command());
  }
  frame();
  // Shuts a dialog; with none open it would end the previewer, which is not asked here.
  for (const bool down : {true, false}) send(InputKind::key, 0, 0, key::kEscape, down);
  frame();
  if (whole(0, 2) == 0) await_picture();
}

}  // namespace meander
