// The controls of each way to give a medium.
#pragma once

#include <string>
#include <vector>

#include "ui/models.h"
#include "ui/widgets.h"

namespace meander {

/// `material.NAME.key`: what edits of the selected material begin with.
[[nodiscard]] std::string material_path(const MaterialModel& model, std::string_view key);

/// The edits that give the selected material another boundary, in an order in which each leaves a scene that
/// reads: a matched boundary has neither index nor roughness, and a dielectric one needs an index.
[[nodiscard]] std::vector<std::string> boundary_edits(const MaterialModel& model, Boundary boundary);

/// Surface colour asked and delivered, inversion, mean free path.
void color_rows(const Ui& ui, const MaterialModel& model);
/// Single-scattering albedo of each channel, mean free path.
void albedo_rows(const Ui& ui, const MaterialModel& model);
/// Scattering and absorption of each channel.
void sigma_rows(const Ui& ui, const MaterialModel& model);

/// The lengths scaled so that the largest is `largest`, ratios held, each rounded to six digits; three times
/// `largest` where there is nothing to scale.
[[nodiscard]] DVec3 scaled_to(const DVec3& lengths, double largest);

}  // namespace meander
