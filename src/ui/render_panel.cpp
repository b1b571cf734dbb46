#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/style.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr std::array<int, 3> kScales{100, 50, 25};

void valued(const Ui& ui, CommandKind kind, double value) {
  ui.actions.commands.push_back({kind, 0, value, {}, {}});
}

// Limits at which rendering stops; the low end of each slider is no limit.
void budget_rows(const Ui& ui, const RenderModel& model) {
  SliderSpec spec;
  spec.effect = Effect::instant;
  spec.label = "Stop at samples";
  spec.id = "##budget_spp";
  spec.map = {Spacing::logarithmic, 1, 65536, nullptr};
  spec.typed_high = 1e9;
  const auto spp = static_cast<double>(model.budget_spp);
  spec.text = model.budget_spp == 0 ? "no limit" : count_text(spp) + " spp";
  spec.start = std::to_string(model.budget_spp);
  if (const auto changed = slider(ui, spec, spp))
    ui.command(CommandKind::budget_spp, *changed <= 1 ? 0 : std::llround(*changed));
  spec.label = "Stop at noise";
  spec.id = "##budget_noise";
  spec.map = {Spacing::logarithmic, 0.05, 50, nullptr};
  spec.typed_high = 100;
  spec.text = model.budget_noise == 0 ? "no limit" : short_percent(model.budget_noise);
  spec.start = significant(100 * model.budget_noise, 4);
  if (const auto changed = slider(ui, spec, 100 * model.budget_noise))
    valued(ui, CommandKind::budget_noise, *changed <= 0.05 ? 0 : *changed / 100);
  spec.label = "Stop after";
  spec.id = "##budget_seconds";
  spec.map = {Spacing::logarithmic, 1, 86400, nullptr};
  spec.typed_high = 1e9;
  spec.text = model.budget_seconds == 0 ? "no limit" : duration_text(model.budget_seconds);
  spec.start = significant(model.budget_seconds, 4);
  if (const auto changed = slider(ui, spec, model.budget_seconds))
    valued(ui, CommandKind::budget_seconds, *changed <= 1 ? 0 : *changed);
}

}  // namespace

void render_panel(const Ui& ui, const RenderModel& model) {
  constexpr std::array<std::string_view, 3> kScaleNames{"100 %", "50 %", "25 %"};
  const auto found = std::find(kScales.begin(), kScales.end(), model.scale);
  const Row scale =
      begin_row("Render scale", Effect::restart, "Size of the picture relative to the scene's film");
  if (const auto picked = segmented(scale, "scale", kScaleNames, static_cast<int>(found - kScales.begin())))
    ui.command(CommandKind::render_scale, kScales[static_cast<std::size_t>(*picked)]);
  const Row size = begin_row("Film", Effect::none);
  draw_text(plain_font(), {size.low.x, size.low.y + 3}, kTextColor,
            std::to_string(model.film_width) + " × " + std::to_string(model.film_height));
  end_row(size);
  const std::vector<std::string_view> names(model.estimators.begin(), model.estimators.end());
  const Row estimator =
      begin_row("Estimator", Effect::restart, "How walks are weighted: all have the same mean");
  if (const auto picked = choice(estimator, "##estimator", names, model.estimator))
    ui.command(CommandKind::estimator, *picked);
  SliderSpec spec;
  spec.label = "Threads";
  spec.id = "##threads";
  spec.effect = Effect::instant;
  spec.map = {Spacing::linear, 0, static_cast<double>(std::max(1, model.available_threads)), nullptr};
  spec.typed_high = spec.map.high;
  spec.text =
      model.threads == 0 ? "all " + std::to_string(model.available_threads) : std::to_string(model.threads);
  spec.start = std::to_string(model.threads);
  spec.tooltip = "0 uses all of them; the picture is the same for any number";
  if (const auto threads = slider(ui, spec, model.threads))
    if (std::lround(*threads) != model.threads) ui.command(CommandKind::threads, std::lround(*threads));
  budget_rows(ui, model);
  constexpr std::array<std::string_view, 2> kRegions{"whole picture", "rectangle"};
  const Row region = begin_row("Render", Effect::restart, "The rectangle is drawn in the picture after X");
  if (const auto picked = segmented(region, "region", kRegions, model.region_only ? 1 : 0))
    ui.command(CommandKind::region_only, *picked);
}

}  // namespace meander
