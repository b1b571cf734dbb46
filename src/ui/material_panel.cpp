#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "medium/presets.h"
#include "scene/material_description.h"
#include "ui/material_rows.h"
#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 3> kParametrisations{"Colour", "Albedo", "σ"};
constexpr std::array<std::string_view, 3> kBoundaries{"index-matched", "Lambertian", "dielectric"};
constexpr std::array<std::string_view, 3> kBoundaryWords{"matched", "diffuse", "dielectric"};
constexpr std::array<std::string_view, 3> kLocks{"look", "σₜ", "σₛ′"};
constexpr std::array<std::string_view, 3> kLockWords{"look", "sigma_t", "sigma_s_reduced"};
constexpr std::array<Tick, 5> kIors{
    {{1.0, "matched"}, {1.33, "water"}, {1.4, "skin"}, {1.5, "wax, marble"}, {1.8, ""}}};
constexpr std::array<Tick, 1> kIsotropic{{{0.0, "isotropic"}}};
constexpr double kUsualIor = 1.5;

// Whether every word of the search is in the name, in either case.
bool matches(std::string_view name, std::string_view search) {
  const auto lower = [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
  const auto same = [&](char a, char b) { return lower(a) == lower(b); };
  const std::string shown = spaced(name);
  return std::search(shown.begin(), shown.end(), search.begin(), search.end(), same) != shown.end();
}

void preset_entry(const Ui& ui, const MaterialModel& model, const Preset& preset) {
  const bool chosen = model.now.preset == preset.name;
  if (ImGui::Selectable(spaced(preset.name).c_str(), chosen, ImGuiSelectableFlags_None, {0, kListLine})) {
    ui.edit(edit_text(material_path(model, "preset"), preset.name));
    ui.state.preset_search.clear();
  }
  const std::string about = std::string(preset.source) + "\nσₛ  " + triple_text(preset.sigma_s, 3) +
                            " /mm\nσₐ  " + triple_text(preset.sigma_a, 3) + " /mm\nior  " +
                            significant(preset.ior, 3);
  item_tooltip(about.c_str());
}

void preset_choice(const Ui& ui, const MaterialModel& model) {
  const Row row = begin_row("Preset", Effect::restart, "Measured materials, each with its source");
  const std::string shown = model.now.preset.empty() ? "choose …" : spaced(model.now.preset);
  if (begin_list(row, "##preset", shown)) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    std::array<char, 64> buffer{};
    ui.state.preset_search.copy(buffer.data(), buffer.size() - 1);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##search", "search", buffer.data(), buffer.size()))
      ui.state.preset_search = buffer.data();
    for (const Preset& preset : presets())
      if (matches(preset.name, ui.state.preset_search)) preset_entry(ui, model, preset);
    ImGui::EndCombo();
  }
  end_row(row);
}

// Edits which turn the material into one given the other way; the quantities themselves are held.
void convert(const Ui& ui, const MaterialModel& model, Parametrisation target) {
  ui.state.parametrisation = target;
  const MaterialDescription& now = model.now;
  if (now.given == target) return;
  if (target == Parametrisation::color) ui.edit(edit_text(material_path(model, "color"), now.delivered));
  if (target == Parametrisation::albedo) ui.edit(edit_text(material_path(model, "albedo"), now.albedo));
  if (target == Parametrisation::sigma) ui.edit(edit_text(material_path(model, "sigma_s"), now.sigma_s));
}

void g_rows(const Ui& ui, const MaterialModel& model) {
  SliderSpec spec;
  spec.label = "Anisotropy g";
  spec.id = "##g";
  spec.map = {Spacing::linear, -0.95, 0.95, nullptr};
  spec.ticks = kIsotropic;
  spec.origin = 0;
  spec.reset = model.original.g;
  spec.typed_low = -0.9999;
  spec.typed_high = 0.9999;
  spec.text = significant(model.now.g, std::abs(model.now.g) > 0.99 ? 4 : 3);
  spec.start = significant(model.now.g, 6);
  spec.tooltip = "Mean cosine of a scattering: above 0 forward, below 0 backward";
  if (const auto g = slider(ui, spec, model.now.g)) ui.edit(edit_text(material_path(model, "g"), *g));
  const Row row = begin_row(
      "g keeps", Effect::none,
      "What a change of g keeps: the look (colour and reduced extinction σₜ′), the extinction σₜ, or the "
      "reduced scattering σₛ′ = σₛ (1 − g)");
  if (const auto lock = segmented(row, "lock", kLocks, static_cast<int>(model.now.g_lock)))
    ui.edit(edit_text(material_path(model, "g_lock"), kLockWords[static_cast<std::size_t>(*lock)]));
}

void ior_row(const Ui& ui, const MaterialModel& model) {
  SliderSpec spec;
  spec.label = "Index (ior)";
  spec.id = "##ior";
  spec.map = {Spacing::linear, 1, 2, nullptr};
  spec.ticks = kIors;
  spec.reset = model.original.surface.boundary == Boundary::matched ? kUsualIor : model.original.surface.ior;
  spec.typed_low = 1;
  spec.typed_high = 4;
  spec.text = significant(model.now.surface.ior, 4);
  spec.tooltip = "Index of refraction inside over outside: water 1.33, skin 1.40, wax and marble 1.5";
  if (const auto ior = slider(ui, spec, model.now.surface.ior))
    ui.edit(edit_text(material_path(model, "ior"), *ior));
}

void surface_rows(const Ui& ui, const MaterialModel& model) {
  const MaterialDescription& now = model.now;
  const Row row = begin_row("Boundary", Effect::restart,
                            "index-matched: none. Lambertian: light enters and leaves diffusely. dielectric: "
                            "Fresnel reflection and refraction");
  if (const auto picked = choice(row, "##boundary", kBoundaries, static_cast<int>(now.surface.boundary)))
    for (const std::string& edit : boundary_edits(model, static_cast<Boundary>(*picked))) ui.edit(edit);
  if (now.surface.boundary == Boundary::matched) return;
  ior_row(ui, model);
  if (now.surface.boundary != Boundary::dielectric) return;
  SliderSpec spec;
  spec.label = "Roughness";
  spec.id = "##roughness";
  spec.reset = model.original.roughness;
  spec.text = significant(now.roughness, 3);
  spec.tooltip = "0 is smooth";
  if (const auto roughness = slider(ui, spec, now.roughness))
    ui.edit(edit_text(material_path(model, "roughness"), *roughness));
}

}  // namespace

std::string material_path(const MaterialModel& model, std::string_view key) {
  return "material." + model.now.name + '.' + std::string(key);
}

std::vector<std::string> boundary_edits(const MaterialModel& model, Boundary boundary) {
  const MaterialDescription& now = model.now;
  std::vector<std::string> edits;
  if (boundary == now.surface.boundary) return edits;
  const std::string ior = material_path(model, "ior");
  const bool needs_index = boundary == Boundary::dielectric && now.surface.ior == 1;
  if (now.roughness != 0) edits.push_back(edit_text(material_path(model, "roughness"), 0.0));
  if (boundary == Boundary::matched || needs_index) edits.push_back(edit_text(ior, 1.0));
  edits.push_back(
      edit_text(material_path(model, "boundary"), kBoundaryWords[static_cast<std::size_t>(boundary)]));
  if (needs_index) edits.push_back(edit_text(ior, kUsualIor));
  return edits;
}

void preset_panel(const Ui& ui, const MaterialModel& model) {
  if (model.names.size() > 1) {
    const Row row = begin_row("Material", Effect::none);
    const std::vector<std::string_view> names(model.names.begin(), model.names.end());
    if (const auto picked = choice(row, "##material", names, model.selected))
      ui.command(CommandKind::select_material, *picked);
  }
  preset_choice(ui, model);
}

void material_panel(const Ui& ui, const MaterialModel& model) {
  if (model.names.empty()) {
    ImGui::TextDisabled("The scene has no translucent material.");
    return;
  }
  const Parametrisation shown = model.now.given.value_or(ui.state.parametrisation);
  const Row row = begin_wide_row();
  if (const auto pressed = segmented(row, "parametrisation", kParametrisations, static_cast<int>(shown)))
    convert(ui, model, static_cast<Parametrisation>(*pressed));
  if (shown == Parametrisation::color) color_rows(ui, model);
  if (shown == Parametrisation::albedo) albedo_rows(ui, model);
  if (shown == Parametrisation::sigma) sigma_rows(ui, model);
  g_rows(ui, model);
  surface_rows(ui, model);
}

}  // namespace meander
