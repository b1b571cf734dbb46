#include "scene/object_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace meander {
namespace {

using MeshPointer = std::shared_ptr<const Mesh>;

bool is_slab(const Object& object) { return std::holds_alternative<SlabShape>(object.shape); }

void include(Bounds& bounds, const Bounds& other) {
  bounds.low = glm::min(bounds.low, other.low);
  bounds.high = glm::max(bounds.high, other.high);
}

// Of [-1, 1]^3 or of the unit sphere: half the extent along each axis is the sum or the length of a row.
DVec3 half_extents(const DMat3& linear, bool sphere) {
  DVec3 half(0);
  for (int axis = 0; axis < 3; ++axis) {
    const DVec3 row(linear[0][axis], linear[1][axis], linear[2][axis]);
    half[axis] = sphere ? glm::length(row) : std::abs(row.x) + std::abs(row.y) + std::abs(row.z);
  }
  return half;
}

Bounds mesh_bounds(const Mesh& mesh, const DMat3& linear) {
  if (mesh.positions.empty()) return {};
  const DVec3 first = linear * mesh.positions.front();
  Bounds bounds{first, first};
  for (const DVec3& position : mesh.positions) {
    const DVec3 p = linear * position;
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
  }
  return bounds;
}

// The surface of the ellipsoid with these semi-axes, by elliptic integrals (Legendre 1825).
double ellipsoid_area(DVec3 axes) {
  std::array<double, 3> s{axes.x, axes.y, axes.z};
  std::sort(s.begin(), s.end());
  const auto [c, b, a] = s;
  const double cosine = c / a;
  const double sine = std::sqrt((a - c) * (a + c)) / a;
  if (sine < 1e-6) return 4 * glm::pi<double>() * a * b;
  const double modulus = std::min(1.0, std::sqrt((b - c) * (b + c)) / (b * sine));
  const double angle = std::atan2(sine, cosine);
  const double second = std::ellint_2(modulus, angle) * sine * sine;
  const double first = std::ellint_1(modulus, angle) * cosine * cosine;
  return 2 * glm::pi<double>() * (c * c + a * b / sine * (second + first));
}

double mesh_chord(const Mesh& mesh, const DMat3& linear) {
  // Vector areas go with the cofactor matrix.
  const DMat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1]));
  double doubled_area = 0;
  DVec3 sum(0);
  for (const Triangle& triangle : mesh.triangles) {
    const DVec3& a = mesh.positions[triangle[0]];
    const DVec3 across = glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
    doubled_area += glm::length(cofactors * across);
    sum += cofactors * across;
  }
  const bool closed = glm::length(sum) <= 1e-9 * doubled_area;
  const double volume = signed_volume(mesh) * glm::determinant(linear);
  if (closed && volume > 0) return 8 * volume / doubled_area;
  const Bounds bounds = mesh_bounds(mesh, linear);
  const DVec3 size = bounds.high - bounds.low;
  return std::min({size.x, size.y, size.z});
}

}  // namespace

Bounds world_bounds(const Object& object) {
  const DMat3 linear = linear_part(object.transform);
  const DVec3& at = object.transform.translate;
  if (const auto* mesh = std::get_if<MeshPointer>(&object.shape)) {
    const Bounds bounds = mesh_bounds(**mesh, linear);
    return {at + bounds.low, at + bounds.high};
  }
  const DVec3 half = half_extents(linear, std::holds_alternative<SphereShape>(object.shape));
  return {at - half, at + half};
}

double bounding_radius(const Object& object) {
  const DVec3& scale = object.transform.scale;
  if (std::holds_alternative<SphereShape>(object.shape)) return std::max({scale.x, scale.y, scale.z});
  const auto* mesh = std::get_if<MeshPointer>(&object.shape);
  if (!mesh) return glm::length(scale);
  const DMat3 linear = linear_part(object.transform);
  const Bounds bounds = mesh_bounds(**mesh, linear);
  const DVec3 center = 0.5 * (bounds.low + bounds.high);
  double squared = 0;
  for (const DVec3& position : (*mesh)->positions) {
    const DVec3 d = linear * position - center;
    squared = std::max(squared, glm::dot(d, d));
  }
  return std::sqrt(squared);
}

Bounds subject_bounds(const Scene& scene) {
  const auto translucent = [&](const Object& object) {
    return std::holds_alternative<TranslucentMaterial>(scene.materials[object.material].kind);
  };
  using Choice = std::array<bool, 2>;  // translucent ones only, slabs too
  for (const auto& [only_translucent, slabs] :
       {Choice{true, false}, Choice{true, true}, Choice{false, false}, Choice{false, true}}) {
    std::optional<Bounds> bounds;
    for (const Object& object : scene.objects) {
      if ((only_translucent && !translucent(object)) || (!slabs && is_slab(object))) continue;
      const Bounds own = world_bounds(object);
      if (!bounds) bounds = own;
      include(*bounds, own);
    }
    if (bounds) return *bounds;
  }
  return {DVec3(-1), DVec3(1)};
}

double mean_chord(const Object& object) {
  const DVec3& s = object.transform.scale;
  if (is_slab(object)) return 4 * s.y;
  if (std::holds_alternative<BoxShape>(object.shape))
    return 4 * s.x * s.y * s.z / (s.x * s.y + s.y * s.z + s.z * s.x);
  if (std::holds_alternative<SphereShape>(object.shape))
    return 16.0 / 3 * glm::pi<double>() * s.x * s.y * s.z / ellipsoid_area(s);
  return mesh_chord(*std::get<MeshPointer>(object.shape), linear_part(object.transform));
}

}  // namespace meander
