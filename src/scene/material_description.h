// A material as people look at it: every way of giving the medium, whichever one the scene uses.
#pragma once

#include <optional>
#include <string>

#include "medium/similarity.h"

namespace meander {

/// The three ways to give a medium.
enum class Parametrisation { color, albedo, sigma };

/// One material, all quantities in doubles and resolved. Lengths in scene units; infinite (or, for the
/// colours and the albedo, 0) where a channel is vacuum. Materials that are not translucent have their
/// reflectance or radiance in `color` and nothing else; a translucent one of radius 0 is `lambertian`, and
/// has `color` and its surface.
struct MaterialDescription {
  std::string name;
  bool translucent = true;
  bool lambertian = false;
  std::string preset;                    // empty when none
  std::optional<Parametrisation> given;  // none when all comes from the preset
  DVec3 color{0};                        // asked for; where none is, the delivered one
  DVec3 delivered{0};                    // the colour that a half-space really shows: ColorMap of the albedo
  DVec3 radius{0};                       // as the key has it, without the scale; without a key 1 / sigma_t
  DVec3 radius_scale{1};
  DVec3 albedo{0};  // single-scattering
  DVec3 mean_free_path{0};
  DVec3 sigma_s{0};  // per millimetre
  DVec3 sigma_a{0};  // per millimetre
  double g = 0;
  GLock g_lock = GLock::look;
  Inversion inversion = Inversion::exact;
  Surface surface;
  double roughness = 0;
  DVec3 diffusion_length{0};  // 1 / sqrt(3 sigma_a sigma_t'), infinite without absorption
};

}  // namespace meander
