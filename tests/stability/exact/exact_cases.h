// The hard cases of the exact shapes: no absorption or next to none, phase functions of every extreme, mean
// free paths from 1e-4 to 1e6 times the body's size, chromatic extinctions of a ratio of 1e4. Every parameter
// is a float's, so that both precisions walk in the same medium.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/types.h"
#include "medium/surface.h"

namespace meander {

/// Slab of thickness 1, half-space, sphere of radius 1.
enum class ExactShape { slab, half_space, sphere };

/// What of a case is counted. whole: what leaves, is absorbed and is flown, under diffuse light. capped:
/// where walks are after 1024 steps, at the latest, in bodies too thick to leave. thin: what scatters, over
/// the optical thickness, under normal light; the random number of the first flight is drawn where it
/// matters. chromatic: what leaves, per channel.
enum class ExactKind { whole, capped, thin, chromatic };

struct ExactCase {
  ExactKind kind = ExactKind::whole;
  ExactShape shape = ExactShape::slab;
  DVec3 sigma_t{1};
  double albedo = 1;
  double g = 0;
  Boundary boundary = Boundary::matched;
  double ior = 1;
};

inline constexpr std::array<std::string_view, 13> kExactQuantities{
    "reflectance",    "transmittance", "escaped",   "absorbed",  "path",      "left",           "depth",
    "scattered_back", "scattered",     "escaped_r", "escaped_g", "escaped_b", "transmittance_b"};

/// All of them, the same in either precision; a case's place is its number.
[[nodiscard]] std::vector<ExactCase> exact_cases();

/// Shape, sigma_t, albedo, g, ior and boundary, as the table has them.
[[nodiscard]] std::string describe(const ExactCase& of);

/// How many walks take about `steps` steps.
[[nodiscard]] std::uint64_t walks_within(const ExactCase& of, double steps);

/// What theory says, where it says something: everything leaves a body that does not absorb, after a mean
/// path of n^2 4V/S (Bardsley & Dubi 1981); what collides in a thin body.
[[nodiscard]] std::optional<double> exact_value(const ExactCase& of, std::string_view quantity);

}  // namespace meander
