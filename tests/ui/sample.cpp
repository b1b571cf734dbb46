#include "ui/sample.h"

#include <cmath>

#include "medium/coefficients.h"

namespace meander {
namespace {

MaterialDescription wax() {
  MaterialDescription now;
  now.name = "wax";
  now.given = Parametrisation::color;
  now.color = {0.92, 0.66, 0.36};
  now.delivered = {0.92, 0.66, 0.36};
  now.radius = {0.15, 0.085, 0.05};
  now.surface = {Boundary::diffuse, 1};
  const Coefficients c = coefficients_from_color(now.color, now.radius, 0, Inversion::exact, now.surface);
  now.sigma_s = c.sigma_s;
  now.sigma_a = c.sigma_a;
  now.albedo = albedo_of(c);
  now.mean_free_path = now.radius;
  for (int i = 0; i < 3; ++i)
    now.diffusion_length[i] = 1 / std::sqrt(3 * c.sigma_a[i] * (c.sigma_a[i] + c.sigma_s[i]));
  return now;
}

StatisticsModel converging() {
  StatisticsModel statistics;
  statistics.spp = 128;
  statistics.seconds = 6.2;
  statistics.noise = 0.018;
  statistics.walks_per_second = 3.21e6;
  statistics.steps_per_second = 48.7e6;
  statistics.mean_scatterings = 15.2;
  statistics.walks = 19'900'000;
  statistics.kernel = "chromatic, isotropic, diffuse, area lights";
  statistics.estimator = "implicit";
  for (std::uint64_t spp = 1; spp <= 128; spp *= 2) {
    const double seconds = 6.2 * static_cast<double>(spp) / 128;
    const double wobble = 1 + 0.08 * std::sin(static_cast<double>(spp));
    statistics.history.push_back({seconds, spp, 0.018 * std::sqrt(6.2 / seconds) * wobble});
  }
  statistics.history.back().noise = 0.018;
  return statistics;
}

LightModel lights() {
  LightModel light;
  light.lights.push_back({"back", "rectangle", "radiance", {44, 38, 30}, {44, 38, 30}, false, true});
  light.lights.push_back({"key", "rectangle", "radiance", {2.6, 2.8, 3.2}, {2.6, 2.8, 3.2}, false, true});
  light.environment.radiance = {0.09, 0.11, 0.15};
  light.original = light.environment;
  return light;
}

}  // namespace

UiModel sample_model() {
  UiModel model;
  model.toolbar.scene_name = "wax_knot.toml";
  model.toolbar.can_undo = true;
  model.toolbar.renderers = {"cycles", "arnold", "renderman", "openpbr", "mitsuba", "pbrt"};
  model.material.names = {"wax"};
  model.material.now = model.material.original = wax();
  model.material.thickness = 0.62;
  model.material.millimetres_per_unit = 10;
  model.material.now.sigma_s /= 10;
  model.material.now.sigma_a /= 10;
  model.material.original = model.material.now;
  model.light = lights();
  model.render.estimators = {"analog", "implicit"};
  model.render.estimator = 1;
  model.render.available_threads = 2;
  model.statistics = converging();
  model.view.names = {"image",  "noise",   "samples",   "scatterings",
                      "length", "normals", "luminance", "clipping"};
  model.overlay.points_per_mm = 20;
  model.overlay.mean_free_path_mm = 1.5;
  model.overlay.diffusion_length_mm = 5.4;
  return model;
}

UiModel busy_model() {
  UiModel model = sample_model();
  model.toolbar.modified = true;
  model.material.names = {"wax", "jade", "milk in a very long name of a glass"};
  for (int i = 0; i < 5; ++i)
    model.snapshots.items.push_back({0, 96, 54, i == 2 ? "softer, warmer, thinner" : "wax", true});
  model.snapshots.items.push_back({0, 96, 54, "photo.png", false});
  model.snapshots.b = 5;
  model.view.view = 1;
  model.view.comparison = CompareMode::wipe;
  model.overlay.legend = LegendModel{"noise", 0.001, 1, true};
  model.overlay.title_a = "live";
  model.overlay.title_b = "photo.png";
  model.overlay.region = PixelBox{300, 200, 420, 280};
  model.overlay.pixel_tooltip = true;
  model.statistics.rectangle =
      RectangleReading{{300, 200, 420, 280}, {0.412, 0.287, 0.151}, {0.003, 0.0021, 0.0012}};
  model.statistics.pixel = PixelReading{512, 300, {0.4, 0.31, 0.2}, {0.012, 0.01, 0.008}, 128, 14.7, 22.4};
  model.statistics.leaked_walks = 12;
  model.messages.push_back(
      {1, MessageKind::note, "Copied as Cycles", {"roughness of the surface is left out"}, 1});
  model.messages.push_back(
      {2, MessageKind::error, "wax_knot.toml:31:1: unknown key 'colour'; did you mean 'color'?", {}, 1});
  return model;
}

TestWindow::TestWindow(int width, int height, float scale) : shape{width, height, scale}, interface(scale) {
  (void)interface.font();
}

Layout TestWindow::layout() const { return layout_of(shape.width(), shape.height(), state.hidden); }

UiActions TestWindow::frame(const std::vector<InputEvent>& events) {
  for (const InputEvent& event : events) interface.feed(event);
  UiActions all;
  do {
    interface.begin_frame(shape);
    const UiActions actions = draw_interface(model, state, layout());
    drawn = interface.end_frame();
    ++frames;
    all.edits.insert(all.edits.end(), actions.edits.begin(), actions.edits.end());
    all.commands.insert(all.commands.end(), actions.commands.begin(), actions.commands.end());
    all.gesture_started |= actions.gesture_started;
    all.gesture_ended |= actions.gesture_ended;
    all.gesture_resumed |= actions.gesture_resumed;
  } while (interface.pending());
  return all;
}

InputEvent move_to(float x, float y, bool shift) {
  InputEvent event;
  event.kind = InputKind::move;
  event.x = static_cast<double>(x);
  event.y = static_cast<double>(y);
  event.modifiers.shift = shift;
  return event;
}

InputEvent button(float x, float y, bool down, Modifiers modifiers) {
  InputEvent event = move_to(x, y);
  event.kind = InputKind::button;
  event.down = down;
  event.modifiers = modifiers;
  return event;
}

InputEvent press_key(int code, Modifiers modifiers) {
  InputEvent event;
  event.kind = InputKind::key;
  event.code = code;
  event.down = true;
  event.modifiers = modifiers;
  return event;
}

InputEvent release_key(int code, Modifiers modifiers) {
  InputEvent event = press_key(code, modifiers);
  event.down = false;
  return event;
}

InputEvent type_character(char32_t character) {
  InputEvent event;
  event.kind = InputKind::text;
  event.character = character;
  return event;
}

}  // namespace meander
