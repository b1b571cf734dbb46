#include <algorithm>
#include <array>
#include <cmath>

#include "scene/light_rigs.h"
#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr double kStops = 10;  // the slider goes from -kStops to kStops
constexpr double kTypedStops = 30;
constexpr double kDark = 1e-9;  // of a light that is off
constexpr std::array<Tick, 1> kUnity{{{0.0, "1"}}};
constexpr std::array<Tick, 3> kAngles{{{-90, ""}, {0, ""}, {90, ""}}};

double largest_of(const DVec3& v) { return std::max({v.x, v.y, v.z}); }

// Strength and tint of a colour of any strength; the tint's largest channel is 1.
double stops_of(const DVec3& value) { return std::log2(std::max(largest_of(value), kDark)); }
DVec3 tint_of(const DVec3& value) {
  const double largest = largest_of(value);
  return largest > 0 ? value / largest : DVec3(1);
}

DVec3 of_strength(const DVec3& tint, double stops) {
  DVec3 value = tint * std::exp2(stops);
  for (int c = 0; c < 3; ++c)
    if (value[c] > 0) {
      const double scale = std::pow(10.0, 5 - static_cast<int>(std::floor(std::log10(value[c]))));
      value[c] = std::round(value[c] * scale) / scale;
    }
  return value;
}

SliderSpec stops_spec(const std::string& label, double now, double reset) {
  SliderSpec spec;
  spec.label = label;
  spec.id = "##stops" + label;
  spec.map = {Spacing::linear, -kStops, kStops, nullptr};
  spec.ticks = kUnity;
  spec.origin = 0;
  spec.reset = reset;
  spec.typed_low = -kTypedStops;
  spec.typed_high = kTypedStops;
  spec.text = now < -kTypedStops + 1 ? "off" : signed_text(now, 2) + " stops";
  spec.start = std::to_string(std::round(1e4 * now) / 1e4);
  spec.tooltip = "Strength in stops relative to 1: one stop more is twice the light";
  return spec;
}

// Strength, colour, and whether the camera sees it, in one line.
void light_row(const Ui& ui, const LightItem& light) {
  const std::string path = "light." + light.name + '.';
  const std::string about = light.kind + " light";
  ImGui::PushID(light.name.c_str());
  const Row row = begin_row(light.name, Effect::restart, about.c_str());
  const float eye = 24;
  const float color = 26;
  const double stops = stops_of(light.value);
  SliderSpec spec = stops_spec(light.name, stops, stops_of(light.original));
  const float end = row.high.x - eye - color - 8;
  if (const auto changed = bare_slider(ui, spec, stops, {row.low, {end, row.high.y}}))
    ui.edit(edit_text(path + light.key, of_strength(tint_of(light.value), *changed)));
  const Row box{{end + 4, row.low.y}, {end + 4 + color, row.high.y}, row.next};
  if (const auto tint = color_button("tint", box, tint_of(light.value), tint_of(light.original)))
    ui.edit(edit_text(path + light.key, of_strength(tint_of(*tint), stops)));
  ImGui::SetCursorScreenPos({row.high.x - eye, row.low.y});
  const char* tooltip = !light.can_be_seen ? "Lights without a surface cannot be seen"
                        : light.visible    ? "Seen by the camera: press to hide"
                                           : "Hidden from the camera: press to show";
  if (icon_button("eye", light.visible ? Icon::eye : Icon::eye_shut, tooltip,
                  {light.can_be_seen, false, eye, kRowHeight}))
    ui.edit(edit_text(path + "visible", !light.visible));
  end_row(row);
  ImGui::PopID();
}

void environment_strength(const Ui& ui, const EnvironmentItem& now, const EnvironmentItem& original) {
  const bool constant = now.kind == EnvironmentKind::constant;
  const double stops = stops_of(constant ? now.radiance : DVec3(now.scale));
  const bool same_kind = now.kind == original.kind;
  const double reset = !same_kind ? 0 : stops_of(constant ? original.radiance : DVec3(original.scale));
  SliderSpec spec = stops_spec("Strength", stops, reset);
  if (!constant) {
    if (const auto changed = slider(ui, spec, stops))
      ui.edit(edit_text("environment.scale", of_strength(DVec3(1), *changed).x));
    return;
  }
  const Row row = begin_row("Strength", Effect::restart, spec.tooltip);
  const float color = 26;
  const float end = row.high.x - color - 4;
  if (const auto changed = bare_slider(ui, spec, stops, {row.low, {end, row.high.y}}))
    ui.edit(edit_text("environment.radiance", of_strength(tint_of(now.radiance), *changed)));
  const Row box{{end + 4, row.low.y}, {end + 4 + color, row.high.y}, row.next};
  if (const auto tint = color_button("sky tint", box, tint_of(now.radiance), tint_of(original.radiance)))
    ui.edit(edit_text("environment.radiance", of_strength(tint_of(*tint), std::max(stops, -kStops))));
  end_row(row);
}

void rotation_row(const Ui& ui, const EnvironmentItem& now, const EnvironmentItem& original) {
  SliderSpec spec;
  spec.label = "Rotation";
  spec.id = "##rotation";
  spec.map = {Spacing::linear, -180, 180, nullptr};
  spec.ticks = kAngles;
  spec.origin = 0;
  spec.reset = original.rotation;
  spec.typed_low = -360;
  spec.typed_high = 360;
  const double turned = std::remainder(now.rotation, 360.0);
  spec.text = significant(std::round(10 * turned) / 10, 4) + "°";
  spec.start = significant(turned, 6);
  spec.tooltip = "About the vertical; Shift + L + drag in the picture does the same";
  if (const auto changed = slider(ui, spec, turned)) ui.edit(edit_text("environment.rotation", *changed));
}

void environment_rows(const Ui& ui, const LightModel& model) {
  const EnvironmentItem& now = model.environment;
  const Row row =
      begin_row("Environment", Effect::restart, "What surrounds the scene; drop an HDR picture to use it");
  if (const auto picked = choice(row, "##environment", kEnvironmentNames, static_cast<int>(now.kind))) {
    if (static_cast<EnvironmentKind>(*picked) == EnvironmentKind::image && now.kind != EnvironmentKind::image)
      ui.command(CommandKind::open_browser);
    else
      ui.command(CommandKind::environment, *picked);
  }
  environment_strength(ui, now, model.original);
  if (now.kind != EnvironmentKind::constant) rotation_row(ui, now, model.original);
  const Row background = begin_row("Background", Effect::restart, "Whether the camera sees the environment");
  constexpr std::array<std::string_view, 2> kShown{"hidden", "shown"};
  if (const auto shown = segmented(background, "background", kShown, now.visible ? 1 : 0))
    ui.edit(edit_text("environment.visible", *shown == 1));
}

}  // namespace

void light_panel(const Ui& ui, const LightModel& model) {
  const Row row = begin_wide_row(Effect::restart);
  if (const auto rig = segmented(row, "rigs", kRigNames, -1)) ui.command(CommandKind::rig, *rig);
  for (const LightItem& light : model.lights) light_row(ui, light);
  environment_rows(ui, model);
}

}  // namespace meander
