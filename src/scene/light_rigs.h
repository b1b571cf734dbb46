// Light for any subject: rigs that stand about it as the camera sees it, and lights turned about a point.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/object_measures.h"  // subject_bounds
#include "scene/scene.h"

namespace meander {

enum class Rig : std::uint8_t { front, three_quarter, back, rim };
inline constexpr std::array<std::string_view, 4> kRigNames{"front", "three-quarter", "back", "rim"};

/// Rectangle lights about the subject, seen from the camera: front and three-quarter have their key on the
/// camera's side, back and rim behind the subject, all of them above it in the world (+y). The strongest is
/// named "key", the others "fill" and "rim". Distances and sizes go with the half diagonal of `subject`.
/// A white Lambertian surface at the subject's centre that faces the key receives from it the irradiance pi
/// in front and three-quarter, and 1.5 pi in back and rim, which show only what passes through: luminance,
/// the key's tint aside.
[[nodiscard]] std::vector<Light> make_rig(Rig rig, const Bounds& subject, const Camera& camera);

/// The light turned about a point by degrees of azimuth (about +y, from +z toward +x) and of elevation, which
/// stops within 1 degree of the poles; its distance is held. A rectangle is turned to look at the point; of a
/// directional light the direction turns. A light at the point itself stays as it is.
[[nodiscard]] Light orbit_light(const Light& light, const DVec3& about, double azimuth, double elevation);

}  // namespace meander
