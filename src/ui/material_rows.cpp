#include "ui/material_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};
constexpr std::array<std::string_view, 3> kInversions{"exact", "Chiang 2016", "van de Hulst"};
constexpr std::array<std::string_view, 3> kInversionWords{"exact", "chiang", "van_de_hulst"};
constexpr double kShortest = 1e-3;  // of the thickness
constexpr double kLongest = 10;

double largest_of(const DVec3& v) { return std::max({v.x, v.y, v.z}); }

double rounded(double value, int digits) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, digits - 1 - static_cast<int>(std::floor(std::log10(value))));
  return std::round(value * scale) / scale;
}

// Which lengths of the material are shown, and under which key they are changed.
struct Lengths {
  const char* key;
  const char* label;
  DVec3 now;  // scene units
  DVec3 original;
  DVec3 scale{1};  // by which the key's value is multiplied
};

Lengths lengths_of(const MaterialModel& model, Parametrisation shown) {
  const MaterialDescription& now = model.now;
  const MaterialDescription& original = model.original;
  if (shown == Parametrisation::albedo)
    return {"mean_free_path", "Mean free path", now.mean_free_path, original.mean_free_path};
  const bool chiang = now.inversion == Inversion::chiang;
  return {"radius", chiang ? "Radius" : "Mean free path", now.radius * now.radius_scale,
          original.radius * original.radius_scale, now.radius_scale};
}

SliderSpec length_spec(const MaterialModel& model, const Lengths& lengths) {
  SliderSpec spec;
  spec.label = lengths.label;
  const double thickness = std::max(model.thickness * model.millimetres_per_unit, 1e-9);
  spec.map = {Spacing::logarithmic, kShortest * thickness, kLongest * thickness, nullptr};
  spec.typed_low = 1e-9;
  spec.typed_high = 1e9;
  spec.tooltip =
      "Mean distance between two events, 1/σₜ: from a thousandth of the object's thickness to ten "
      "times. Beside it the thickness in mean free paths";
  return spec;
}

std::string thickness_text(const MaterialModel& model, double length) {
  return "τ " + significant(model.thickness / length, 3);
}

void edit_lengths(const Ui& ui, const MaterialModel& model, const Lengths& lengths, const DVec3& value) {
  DVec3 key_value = value / lengths.scale;
  for (int c = 0; c < 3; ++c) key_value[c] = rounded(key_value[c], 6);
  ui.edit(edit_text(material_path(model, lengths.key), key_value));
}

// One slider that moves all three.
void linked_lengths(const Ui& ui, const MaterialModel& model, const Lengths& lengths) {
  const double unit = model.millimetres_per_unit;
  const double now = largest_of(lengths.now);
  SliderSpec spec = length_spec(model, lengths);
  spec.id = "##length";
  spec.reset = unit * largest_of(lengths.original);
  spec.text = significant(unit * now, 3) + " mm";
  spec.start = significant(unit * now, 6);
  spec.aside = thickness_text(model, now);
  if (const auto length = slider(ui, spec, unit * now))
    edit_lengths(ui, model, lengths,
                 scaled_to(*length == spec.reset ? lengths.original : lengths.now, *length / unit));
}

void separate_lengths(const Ui& ui, const MaterialModel& model, const Lengths& lengths) {
  const double unit = model.millimetres_per_unit;
  for (int c = 0; c < 3; ++c) {
    SliderSpec spec = length_spec(model, lengths);
    const auto channel = static_cast<std::size_t>(c);
    spec.label = c == 0 ? std::string(lengths.label) : std::string();
    spec.id = std::string("##length") + kChannels[channel];
    spec.channel = kChannels[channel];
    spec.reset = unit * lengths.original[c];
    spec.text = significant(unit * lengths.now[c], 3) + " mm";
    spec.start = significant(unit * lengths.now[c], 6);
    spec.aside = thickness_text(model, lengths.now[c]);
    if (const auto length = slider(ui, spec, unit * lengths.now[c])) {
      DVec3 value = lengths.now;
      value[c] = *length / unit;
      edit_lengths(ui, model, lengths, value);
    }
  }
}

void ratio_row(const Ui& ui, const Lengths& lengths) {
  const Row row =
      begin_row("R : G : B", Effect::none, "Linked: one slider scales all three, and their ratios stay");
  ImGui::SetCursorScreenPos(row.low);
  const bool linked = ui.state.lengths_linked;
  if (icon_button("##link", linked ? Icon::link : Icon::unlink,
                  linked ? "Ratios are held: press to move each channel" : "Press to hold the ratios",
                  {true, linked, 24, kRowHeight}))
    ui.state.lengths_linked = !linked;
  const DVec3 ratio = lengths.now / std::max(largest_of(lengths.now), 1e-300);
  const std::string text =
      significant(ratio.x, 3) + " : " + significant(ratio.y, 3) + " : " + significant(ratio.z, 3);
  draw_text(plain_font(), {row.low.x + 32, row.low.y + 3}, kDimColor, text);
  end_row(row);
}

void length_rows(const Ui& ui, const MaterialModel& model, Parametrisation shown) {
  const Lengths lengths = lengths_of(model, shown);
  if (ui.state.lengths_linked)
    linked_lengths(ui, model, lengths);
  else
    separate_lengths(ui, model, lengths);
  ratio_row(ui, lengths);
}

// A swatch with its numbers.
void numbers(const Row& row, const DVec3& color, const std::string& after) {
  const float x = row.low.x + 50;
  draw_text(small_font(), {x, row.low.y + 4}, kTextColor, triple_text(color, 3));
  const float width = text_width(small_font(), after);
  if (x + text_width(small_font(), triple_text(color, 3)) + 6 > row.high.x - width) return;  // no room
  draw_text(small_font(), {row.high.x - width, row.low.y + 4}, kDimColor, after);
}

Row swatch_box(const Row& row) { return {row.low, {row.low.x + 42, row.high.y}, row.next}; }

void asked_and_delivered(const Ui& ui, const MaterialModel& model) {
  const MaterialDescription& now = model.now;
  const Row asked =
      begin_row("Surface colour", Effect::restart,
                "The colour asked for: the diffuse albedo of a half-space of the material under "
                "uniform light");
  if (const auto color = color_button("color", swatch_box(asked), now.color, model.original.color))
    ui.edit(edit_text(material_path(model, "color"), *color));
  numbers(asked, now.color, hex_text(now.color));
  end_row(asked);
  const Row got =
      begin_row("delivered", Effect::none,
                "The colour that a half-space of the material really shows, and how far off it is");
  const Row box = swatch_box(got);
  swatch(box.low, box.high, now.delivered);
  const DVec3 difference = glm::abs(now.delivered - now.color);
  const double delta = largest_of(difference);
  numbers(got, now.delivered, "Δ " + (delta < 5e-5 ? std::string("0") : significant(delta, 2)));
  end_row(got);
}

// The map of the last g and surface, made anew only when nothing is being dragged: it takes milliseconds.
const ColorMap& color_map(const Ui& ui, const MaterialDescription& now) {
  KeptColorMap& kept = ui.state.color_map;
  const bool same = kept.g == now.g && kept.surface == now.surface;
  if (!same && !ImGui::IsAnyItemActive()) kept = {now.g, now.surface, ColorMap(now.g, now.surface)};
  return kept.map;
}

SliderSpec sigma_spec(const MaterialModel& model) {
  SliderSpec spec;
  const double thickness = std::max(model.thickness * model.millimetres_per_unit, 1e-9);
  spec.map = {Spacing::logarithmic, 1e-5 / thickness, 1e3 / thickness, nullptr};
  spec.typed_low = 0;
  spec.typed_high = 1e9;
  return spec;
}

void sigma_row(const Ui& ui, const MaterialModel& model, int channel, bool scattering) {
  const DVec3& now = scattering ? model.now.sigma_s : model.now.sigma_a;
  const DVec3& original = scattering ? model.original.sigma_s : model.original.sigma_a;
  const char* key = scattering ? "sigma_s" : "sigma_a";
  SliderSpec spec = sigma_spec(model);
  if (channel == 0) spec.label = scattering ? "Scattering σₛ" : "Absorption σₐ";
  spec.tooltip =
      scattering ? "Scattering coefficient per millimetre" : "Absorption coefficient per millimetre";
  spec.id = std::string("##") + key + kChannels[static_cast<std::size_t>(channel)];
  spec.channel = kChannels[static_cast<std::size_t>(channel)];
  spec.reset = original[channel];
  spec.text = significant(now[channel], 4) + " /mm";
  spec.start = significant(now[channel], 6);
  const auto sigma = slider(ui, spec, now[channel]);
  if (!sigma) return;
  DVec3 value = now;
  value[channel] = *sigma;
  ui.edit(edit_text(material_path(model, key), value));
}

}  // namespace

DVec3 scaled_to(const DVec3& lengths, double largest) {
  const double now = largest_of(lengths);
  if (!(now > 0) || !std::isfinite(now)) return DVec3(largest);
  DVec3 scaled = lengths * (largest / now);
  for (int c = 0; c < 3; ++c) scaled[c] = rounded(scaled[c], 6);
  return scaled;
}

void color_rows(const Ui& ui, const MaterialModel& model) {
  asked_and_delivered(ui, model);
  const Row row =
      begin_row("Inversion", Effect::restart,
                "How a colour becomes a single-scattering albedo: exactly, for this g and boundary, "
                "or by a fit of the literature");
  if (const auto picked = choice(row, "##inversion", kInversions, static_cast<int>(model.now.inversion)))
    ui.edit(edit_text(material_path(model, "inversion"), kInversionWords[static_cast<std::size_t>(*picked)]));
  length_rows(ui, model, Parametrisation::color);
}

void albedo_rows(const Ui& ui, const MaterialModel& model) {
  const ColorMap& map = color_map(ui, model.now);
  const Row head = begin_row("Surface colour", Effect::none,
                             "The colour that a half-space with this single-scattering albedo shows");
  const Row box = swatch_box(head);
  swatch(box.low, box.high, model.now.delivered);
  numbers(head, model.now.delivered, hex_text(model.now.delivered));
  end_row(head);
  draw_text(plain_font(), ImGui::GetCursorScreenPos(), kDimColor, "Single-scattering albedo α");
  ImGui::Dummy({1, kTextSize + 1});
  for (int c = 0; c < 3; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    const double now = model.now.albedo[c];
    SliderSpec spec;
    spec.id = std::string("##albedo") + kChannels[channel];
    spec.map = {Spacing::color, 0, 1, &map};
    spec.channel = kChannels[channel];
    spec.reset = model.original.albedo[c];
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5f", now);
    spec.text = text.data();
    std::snprintf(text.data(), text.size(), "%.9g", now);
    spec.start = text.data();
    spec.aside = "1−α " + significant(1 - now, 2);
    spec.tooltip = "Spaced by the colour that it delivers";
    if (const auto albedo = slider(ui, spec, now)) {
      DVec3 value = model.now.albedo;
      value[c] = *albedo;
      ui.edit(edit_text(material_path(model, "albedo"), value));
    }
  }
  length_rows(ui, model, Parametrisation::albedo);
}

void sigma_rows(const Ui& ui, const MaterialModel& model) {
  for (const bool scattering : {true, false})
    for (int c = 0; c < 3; ++c) sigma_row(ui, model, c, scattering);
}

}  // namespace meander
