#include "trace/geometry.h"

namespace meander {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where a body stands, how large it is, and whether its surface bounds an inside.
struct Placement {
  const DVec3& center;
  Real size;
  bool closed;
};

struct BodyHit {
  double distance;
  Vec3 point;
  Vec3 normal;
  Vec3 shading_normal;
};

// The ray's origin in a body's coordinates, moved along the ray to `start` while still in double, so that
// what is left to single precision is of the body's own size.
struct LocalRay {
  double start;
  Vec3 origin;
  Vec3 direction;
};

LocalRay localise(const Ray& ray, const DVec3& center, double start) noexcept {
  return {start, Vec3(ray.origin - center + start * DVec3(ray.direction)), ray.direction};
}

// Where the ray comes nearest to the body's centre, if that is ahead.
double closest_approach(const Ray& ray, const DVec3& center) noexcept {
  return std::max(glm::dot(center - ray.origin, DVec3(ray.direction)), 0.0);
}

template <class Unit>
std::optional<BodyHit> first_hit(const AffineShape<Unit>& shape, const Ray& ray, const Placement& placement,
                                 double distance) noexcept {
  const LocalRay local = localise(ray, placement.center, closest_approach(ray, placement.center));
  const auto interval = shape.inside(local.origin, local.direction);
  if (!interval) return std::nullopt;
  const bool enters = local.start + interval->near > 0;
  const Real t = enters ? interval->near : interval->far;
  if (!(local.start + t > 0) || local.start + t > distance) return std::nullopt;
  const Vec3 gradient = enters ? interval->near_gradient : interval->far_gradient;
  const Vec3 normal = shape.normal_from(gradient);
  return BodyHit{local.start + t, shape.snap(local.origin + t * local.direction, gradient), normal, normal};
}

// Where the ray enters the mesh's bounds, 0 from within; nothing when it misses them.
std::optional<double> bounds_entry(const Ray& ray, const DVec3& center, const Vec3& half_size) noexcept {
  const DVec3 origin = ray.origin - center;
  const DVec3 half = DVec3(half_size) * (1 + 0x1p-18) + DVec3(largest(half_size) * Real(0x1p-18));
  double near = 0;
  double far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    if (d == 0) {
      if (std::abs(origin[axis]) > half[axis]) return std::nullopt;
      continue;
    }
    const double first = (-std::copysign(half[axis], d) - origin[axis]) / d;
    const double second = (std::copysign(half[axis], d) - origin[axis]) / d;
    near = std::max(near, first);
    far = std::min(far, second);
  }
  if (near > far) return std::nullopt;
  return near;
}

// Whether a point lies inside a closed mesh, seen along a line: the surface behind it is left going backward.
bool is_inside(const MeshBody& mesh, const Vec3& p, const Vec3& d) noexcept {
  const auto behind = mesh.closest(p, -d, std::numeric_limits<Real>::infinity());
  return behind && glm::dot(behind->normal, d) < 0;
}

// On the rim of a mesh a ray may slip past the last triangle that faces it and meet the next one from behind.
// Where a mesh is closed, such a hit from outside is no hit.
std::optional<BodyHit> first_hit(const MeshBody& mesh, const Ray& ray, const Placement& placement,
                                 double distance) noexcept {
  const auto entry = bounds_entry(ray, placement.center, mesh.half_size());
  if (!entry) return std::nullopt;
  const double step = double{placement.size} * 0x1p-20;
  for (double start = *entry; start <= distance;) {
    const LocalRay local = localise(ray, placement.center, start);
    const auto hit = mesh.closest(local.origin, local.direction, static_cast<Real>(distance - start));
    if (!hit) return std::nullopt;
    const bool leaves = glm::dot(hit->normal, local.direction) >= 0;
    const bool grazes =
        placement.closed && leaves &&
        (*entry > 0 || !is_inside(mesh, localise(ray, placement.center, 0).origin, local.direction));
    if (!grazes) return BodyHit{start + hit->distance, hit->point, hit->normal, hit->shading_normal};
    start += hit->distance + step;
  }
  return std::nullopt;
}

template <class Unit>
bool blocks(const AffineShape<Unit>& shape, const Ray& ray, const Placement& placement,
            double distance) noexcept {
  return first_hit(shape, ray, placement, distance).has_value();
}

bool blocks(const MeshBody& mesh, const Ray& ray, const Placement& placement, double distance) noexcept {
  const auto entry = bounds_entry(ray, placement.center, mesh.half_size());
  if (!entry || *entry > distance) return false;
  const LocalRay local = localise(ray, placement.center, *entry);
  return mesh.occluded(local.origin, local.direction, static_cast<Real>(distance - *entry));
}

Real size_of(const DMat3& map) noexcept {
  return static_cast<Real>(std::max({glm::length(map[0]), glm::length(map[1]), glm::length(map[2])}));
}

template <class Body>
Placement placement_of(const Body& body) noexcept {
  return {body.center, body.size, body.closed};
}

}  // namespace

Geometry::Geometry(const Scene& scene, int threads) : device_(make_device(threads)) {
  for (const Object& object : scene.objects) bodies_.push_back(make_body(object, scene));
}

Geometry::Body Geometry::make_body(const Object& object, const Scene& scene) const {
  const DMat3 map = linear_part(object.transform);
  const auto* translucent = std::get_if<TranslucentMaterial>(&scene.materials[object.material].kind);
  const bool closed = translucent != nullptr;
  const bool matched = closed && translucent->boundary == Boundary::matched;
  const Rgb sigma_t = matched ? translucent->medium.sigma_t : Rgb(0);
  const DVec3& origin = object.transform.translate;
  if (std::holds_alternative<SphereShape>(object.shape))
    return {SphereBody(map), origin, size_of(map), closed, matched, sigma_t};
  if (std::holds_alternative<BoxShape>(object.shape))
    return {BoxBody(map), origin, size_of(map), closed, matched, sigma_t};
  if (std::holds_alternative<SlabShape>(object.shape))
    return {SlabBody(map), origin, size_of(map), closed, matched, sigma_t};
  DVec3 center(0);
  MeshBody mesh(device_.get(), *std::get<std::shared_ptr<const Mesh>>(object.shape), map, center);
  const Real size = largest(mesh.half_size());
  return {std::move(mesh), origin + center, size, closed, matched, sigma_t};
}

std::optional<SurfaceHit> Geometry::closest_hit(const Ray& ray) const noexcept {
  std::optional<SurfaceHit> closest;
  double distance = kInfinity;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    const auto hit = std::visit(
        [&](const auto& shape) { return first_hit(shape, ray, placement_of(body), distance); }, body.shape);
    if (!hit) continue;
    distance = hit->distance;
    closest = SurfaceHit{
        i, distance, hit->point, hit->normal, hit->shading_normal, glm::dot(hit->normal, ray.direction) < 0};
  }
  return closest;
}

// The length of a segment inside a matched body, surface by surface.
Real Geometry::length_inside(const Body& body, const Ray& ray, double distance) noexcept {
  double inside = 0;
  double done = 0;  // everything before this distance is accounted for
  while (done < distance) {
    const Ray rest{ray.origin + done * DVec3(ray.direction), ray.direction};
    const auto hit = std::visit(
        [&](const auto& shape) { return first_hit(shape, rest, placement_of(body), kInfinity); }, body.shape);
    if (!hit) break;
    if (glm::dot(hit->normal, ray.direction) > 0) inside += std::min(hit->distance, distance - done);
    // Past the surface just met, by what outweighs its rounding.
    done += hit->distance + body.size * 0x1p-20;
  }
  return static_cast<Real>(inside);
}

Rgb Geometry::transmittance(const Ray& ray, double distance) const noexcept {
  for (const Body& body : bodies_) {
    if (body.matched) continue;
    const bool blocked = std::visit(
        [&](const auto& shape) { return blocks(shape, ray, placement_of(body), distance); }, body.shape);
    if (blocked) return Rgb(0);
  }
  Rgb through(1);
  for (const Body& body : bodies_) {
    if (!body.matched) continue;
    const Real length = length_inside(body, ray, distance);
    if (length > 0) through *= glm::exp(-body.sigma_t * length);
  }
  return through;
}

}  // namespace meander
