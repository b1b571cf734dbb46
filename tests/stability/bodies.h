// Closed meshes that are hard on a tracer, each of a body that is simple otherwise.
#pragma once

#include <utility>
#include <vector>

#include "scene/mesh.h"

namespace meander {

/// The cube [-1, 1]^3. Each of its edges about z is cut into `along` pieces, so that the four sides consist
/// of pairs of triangles across them, and its two ends are fans about their middles, of 4 * `around`
/// triangles that share one vertex.
[[nodiscard]] Mesh make_cube(int around = 1, int along = 1);

/// The prism between z = -1 and 1 over a convex polygon, given counter-clockwise as seen from +z; its ends
/// are fans about the middle.
[[nodiscard]] Mesh make_prism(const std::vector<glm::dvec2>& polygon, int along = 1);

/// The pyramid with its tip at (0, 1, 0), a regular polygon of `sides` in y = -1 about the origin, radius 1:
/// `sides` triangles share the tip.
[[nodiscard]] Mesh make_pyramid(int sides);

/// A star of `points` about z, radii 0.8 and 0.3 in turn, its rim up and down by 0.1, joined to (0, 0, +-1):
/// towards these its grooves are narrower than any rounding.
[[nodiscard]] Mesh make_star(int points);

/// Two cubes of half size 0.5, on either side of the plane x = 0, in which each has a face of its own, cut up
/// otherwise than the other's.
[[nodiscard]] std::pair<Mesh, Mesh> make_touching_cubes();

/// The cube [-1, 1]^3 as eight blocks in one mesh, each with all of its faces, that meet in (0.1, 0.2,
/// -0.15).
[[nodiscard]] Mesh make_divided_cube();

/// Both in one mesh.
[[nodiscard]] Mesh joined(const std::pair<Mesh, Mesh>& meshes);

/// The cube [-1, 1]^3 without the cube [-1 + thickness, 1 - thickness]^3.
[[nodiscard]] Mesh make_hollow_cube(double thickness);

/// Every triangle twice, the same way round.
[[nodiscard]] Mesh doubled(Mesh mesh);

/// With a square within the cube [-1, 1]^3 given from both sides: it encloses nothing.
[[nodiscard]] Mesh with_leaf(Mesh mesh);

/// All positions moved.
[[nodiscard]] Mesh shifted(Mesh mesh, const DVec3& by);

/// Without the triangle `number`.
[[nodiscard]] Mesh without_triangle(Mesh mesh, std::size_t number);

}  // namespace meander
