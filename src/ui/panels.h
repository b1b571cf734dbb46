// The sections of the panel at the right: each draws its controls into the current window and says what was
// done to them.
#pragma once

#include "ui/models.h"
#include "ui/widgets.h"

namespace meander {

/// Which material, and the published one that it starts from.
void preset_panel(const Ui& ui, const MaterialModel& model);
/// One parametrisation's controls, g, and the surface.
void material_panel(const Ui& ui, const MaterialModel& model);
/// Every quantity of the material in every channel, to be read and copied.
void coefficients_panel(const Ui& ui, const MaterialModel& model);
/// Rigs, lights, environment.
void light_panel(const Ui& ui, const LightModel& model);
void camera_panel(const Ui& ui, const CameraModel& model);
void render_panel(const Ui& ui, const RenderModel& model);
/// Noise against time, speed, the rectangle, the pixel.
void statistics_panel(const Ui& ui, const StatisticsModel& model);

/// Noise against time on logarithmic axes with the -1/2 line through the last point, over `box` of the
/// current window. `target` is marked.
void noise_plot(const StatisticsModel& model, double target, const std::pair<ImVec2, ImVec2>& box);
/// The same small and without axes.
void noise_sparkline(const StatisticsModel& model, const std::pair<ImVec2, ImVec2>& box);

/// Seconds still to go until the noise is `target`, by the -1/2 law: 0 when it is there, nothing while the
/// noise is unknown.
[[nodiscard]] std::optional<double> seconds_to_noise(const StatisticsModel& model, double target);

/// sigma_t' of the reduced medium and what follows from the description, per millimetre or in millimetres.
struct ShownCoefficients {
  DVec3 sigma_t;
  DVec3 sigma_s_reduced;
  DVec3 mean_free_path;
  DVec3 mean_free_path_reduced;
  DVec3 diffusion_length;
  DVec3 optical_thickness;
};
[[nodiscard]] ShownCoefficients shown_coefficients(const MaterialModel& model);

}  // namespace meander
