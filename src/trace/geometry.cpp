#include "trace/geometry.h"

#include <tbb/info.h>

#include <algorithm>

#include "math/free_path.h"

namespace meander {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A body and where it stands, as a ray in the world meets it.
struct Placement {
  const DVec3& center;
  Real size;
  bool closed;   // its surface bounds an inside
  bool matched;  // which light enters as if there were no surface
};

struct BodyHit {
  double distance;
  Vec3 point;
  Vec3 normal;
  Vec3 shading_normal;
};

// A ray as one body sees it. `slack` is how far behind the ray's origin it starts: a surface that faces the
// ray there touches the one that the ray has just left, and counts as met at once; one that faces away lies
// behind. `lifted` is how far the origin was moved off the surface of this body, outward, when the ray left
// it by there.
struct Approach {
  DVec3 origin;  // in the body's coordinates
  Vec3 direction;
  double slack;
  Vec3 lifted{0};
};

template <class Unit>
std::optional<BodyHit> first_hit(const AffineShape<Unit>& shape, const Approach& ray, const Placement&,
                                 double distance) noexcept {
  const auto interval = shape.inside(ray.origin, DVec3(ray.direction));
  if (!interval) return std::nullopt;
  const bool enters = interval->near > 0;
  const double t = enters ? interval->near : interval->far;
  if (!(t > (enters ? 0 : 2 * ray.slack)) || t - ray.slack > distance) return std::nullopt;
  const Vec3 gradient(enters ? interval->near_gradient : interval->far_gradient);
  const Vec3 normal = shape.normal_from(gradient);
  const Vec3 point(ray.origin + t * DVec3(ray.direction));
  return BodyHit{std::max(t - ray.slack, 0.0), shape.snap(point, gradient), normal, normal};
}

// Where the ray enters the mesh's bounds, 0 from within; nothing when it misses them.
std::optional<double> bounds_entry(const Approach& ray, const Vec3& half_size) noexcept {
  const DVec3 half = DVec3(half_size) * (1 + 0x1p-18) + DVec3(largest(half_size) * Real(0x1p-18));
  double near = 0;
  double far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    if (d == 0) {
      if (std::abs(ray.origin[axis]) > half[axis]) return std::nullopt;
      continue;
    }
    const double first = (-std::copysign(half[axis], d) - ray.origin[axis]) / d;
    const double second = (std::copysign(half[axis], d) - ray.origin[axis]) / d;
    near = std::max(near, first);
    far = std::min(far, second);
  }
  if (near > far) return std::nullopt;
  return near;
}

// The ray's origin moved to where it enters the bounds while still in double, so that what is left to single
// precision is of the body's own size.
Vec3 local_origin(const Approach& ray, double entry) noexcept {
  return Vec3(ray.origin + entry * DVec3(ray.direction));
}

// Whether a point lies inside a closed mesh. Where counting the walls leaves doubt: whether the surface
// behind it, seen along a line, is left going backward.
bool is_inside(const MeshBody& mesh, const Vec3& p, const Vec3& d) noexcept {
  if (const auto depth = mesh.depth(p, d)) return *depth > 0;
  const auto behind = mesh.closest(p, -d, std::numeric_limits<Real>::infinity());
  return behind && glm::dot(behind->normal, d) < 0;
}

// A ray that has left a mesh and is inside of it all the same has crossed two walls at one place: the second
// one, which it enters by. One that was lifted off the first lies above both.
std::optional<BodyHit> hit_at_once(const MeshBody& mesh, const Approach& ray, const Vec3& origin) noexcept {
  const Real height = glm::length(ray.lifted);
  const Real rise = glm::dot(ray.lifted, ray.direction);
  if (!(rise > 0)) return std::nullopt;
  const auto entry = mesh.entry_behind(origin, ray.direction, 2 * height * height / rise);
  if (!entry) return std::nullopt;
  return BodyHit{0, entry->point, entry->normal, entry->shading_normal};
}

// Of two walls at one place a ray from inside of the first body leaves that one before it enters the second.
std::optional<MeshHit> exit_before(const MeshBody& mesh, const Vec3& origin, const Vec3& d,
                                   const std::pair<Real, Real>& place) noexcept {
  const auto& [distance, rounding] = place;
  const Real begin = std::max(distance - rounding, Real(0));
  auto exit = mesh.exit_within(origin + begin * d, d, 2 * rounding);
  if (!exit || !is_inside(mesh, origin, d)) return std::nullopt;
  exit->distance += begin;
  return exit;
}

// On the rim of a mesh a ray may slip past the last triangle that faces it and meet the next one from behind.
// Where a mesh is closed, such a hit from outside is no hit.
std::optional<BodyHit> first_hit(const MeshBody& mesh, const Approach& ray, const Placement& placement,
                                 double distance) noexcept {
  const auto entry = bounds_entry(ray, mesh.half_size());
  if (!entry) return std::nullopt;
  const Vec3 origin = local_origin(ray, *entry);
  const double reach = distance + ray.slack - *entry;
  const Real step = placement.size * Real(0x1p-20);
  for (Real start = 0; double{start} <= reach;) {
    auto hit = mesh.closest(origin + start * ray.direction, ray.direction, static_cast<Real>(reach) - start);
    if (!hit) return std::nullopt;
    start += hit->distance;
    const double met = *entry + double{start};
    bool leaves = glm::dot(hit->normal, ray.direction) >= 0;
    if (!leaves && placement.closed && *entry == 0)
      if (const auto exit = exit_before(mesh, origin, ray.direction, {start, step})) {
        hit = exit;
        leaves = true;
      }
    const bool behind = leaves && ray.slack > 0 && met <= 2 * ray.slack;
    const bool asks = leaves && placement.closed && !behind;
    const bool inside = asks && *entry == 0 && is_inside(mesh, origin, ray.direction);
    if (inside && !placement.matched)
      if (const auto at_once = hit_at_once(mesh, ray, origin)) return at_once;
    if (!behind && (!asks || inside))
      return BodyHit{std::max(met - ray.slack, 0.0), hit->point, hit->normal, hit->shading_normal};
    start += step;
  }
  return std::nullopt;
}

// The length of a segment that lies inside a closed body.
template <class Unit>
double length_inside(const AffineShape<Unit>& shape, const Approach& ray, const Placement&,
                     double distance) noexcept {
  const auto interval = shape.inside(ray.origin, DVec3(ray.direction));
  if (!interval) return 0;
  return std::max(std::min(interval->far, distance + ray.slack) - std::max(interval->near, ray.slack), 0.0);
}

// From one surface to the next.
double sum_lengths_inside(const MeshBody& mesh, const Approach& ray, const Placement& placement,
                          double distance) noexcept {
  double inside = 0;
  double done = 0;
  for (Approach rest = ray; done < distance;) {
    const auto hit = first_hit(mesh, rest, placement, kInfinity);
    if (!hit) break;
    if (glm::dot(hit->normal, ray.direction) > 0) inside += std::min(hit->distance, distance - done);
    // Past the surface just met, by what outweighs its rounding; from the point itself, so that no distance
    // is too far.
    const double step = double{placement.size} * 0x1p-20;
    done += hit->distance + step;
    rest = {DVec3(hit->point) + step * DVec3(ray.direction), ray.direction, 0, Vec3(0)};
  }
  return inside;
}

double length_inside(const MeshBody& mesh, const Approach& ray, const Placement& placement,
                     double distance) noexcept {
  const auto entry = bounds_entry(ray, mesh.half_size());
  if (!entry || *entry >= distance + ray.slack) return 0;
  if (ray.slack == 0) {
    const Vec3 origin = local_origin(ray, *entry);
    const auto length = mesh.length_inside(origin, ray.direction, distance - *entry, *entry > 0);
    if (length) return *length;
  }
  return sum_lengths_inside(mesh, ray, placement, distance);
}

template <class Shape>
bool blocks(const Shape& shape, const Approach& ray, const Placement& placement, double distance) noexcept {
  return first_hit(shape, ray, placement, distance).has_value();
}

// What is inside of an exact shape by more than the rounding of a step's end.
template <class Unit>
SafeRegion convex_region(const AffineShape<Unit>& shape) noexcept {
  constexpr float kMargin = 0x1p-18F;
  SafeRegion region;
  region.kind = std::is_same_v<Unit, UnitSphere> ? SafeRegion::Kind::ellipsoid : SafeRegion::Kind::box;
  for (int row = 0; row < 3; ++row) {
    const bool bounded = !std::is_same_v<Unit, UnitSlab> || row == 1;
    for (int column = 0; column < 3; ++column)
      region.map[row][column] = static_cast<float>(shape.to_unit[column][row]) * (1 + kMargin);
    region.low[row] = bounded ? -1 : -std::numeric_limits<float>::infinity();
    region.high[row] = bounded ? 1 : std::numeric_limits<float>::infinity();
  }
  return region;
}

Real size_of(const DMat3& map) noexcept {
  return static_cast<Real>(std::max({glm::length(map[0]), glm::length(map[1]), glm::length(map[2])}));
}

// Of the unit box under a map whose columns are at right angles.
double half_diagonal(const DMat3& map) noexcept {
  return std::sqrt(glm::dot(map[0], map[0]) + glm::dot(map[1], map[1]) + glm::dot(map[2], map[2]));
}

}  // namespace

Geometry::Geometry(const Scene& scene, int threads, const Geometry* previous)
    : threads_(std::min(threads, tbb::info::default_concurrency())),  // oneTBB warns of more
      device_(previous ? previous->device_ : nullptr) {
  for (const Object& object : scene.objects) bodies_.push_back(make_body(object, scene, previous));
  for (Body& body : bodies_) {
    body.holds_light = body.matched && holds_light(body, scene);
    body.region = std::visit(
        [](const auto& shape) {
          if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, SharedMesh>)
            return SafeRegion{.kind = SafeRegion::Kind::balls};
          else
            return convex_region(shape);
        },
        body.shape);
  }
}

// Whether a light with an extent may lie, partly at least, inside a body: whether their bounding spheres
// meet.
bool Geometry::holds_light(const Body& body, const Scene& scene) noexcept {
  for (const Light& light : scene.lights) {
    if (const auto* sphere = std::get_if<SphereLight>(&light.shape))
      if (glm::length(sphere->center - body.center) <= body.radius + sphere->radius) return true;
    if (const auto* rectangle = std::get_if<RectangleLight>(&light.shape))
      if (glm::length(rectangle->center - body.center) <=
          body.radius + 0.5 * std::hypot(rectangle->width, rectangle->height))
        return true;
  }
  return false;
}

Geometry::SharedMesh Geometry::find_mesh(const std::shared_ptr<const Mesh>& mesh, const DMat3& map) const {
  for (const Body& body : bodies_) {
    const auto* placed = std::get_if<SharedMesh>(&body.shape);
    if (!placed || (*placed)->map != map) continue;
    // By owner: another mesh at the address of one that is gone is another mesh.
    const std::weak_ptr<const Mesh>& source = (*placed)->source;
    if (!source.owner_before(mesh) && !mesh.owner_before(source) && source.lock() == mesh) return *placed;
  }
  return nullptr;
}

Geometry::SharedMesh Geometry::make_mesh(const std::shared_ptr<const Mesh>& mesh, const DMat3& map,
                                         const Geometry* previous) {
  if (SharedMesh known = find_mesh(mesh, map)) return known;
  if (previous)
    if (SharedMesh known = previous->find_mesh(mesh, map)) return known;
  if (!device_) device_ = make_device(threads_);
  return std::make_shared<const PlacedMesh>(device_, mesh, map);
}

Geometry::Body Geometry::make_body(const Object& object, const Scene& scene, const Geometry* previous) {
  const DMat3 map = linear_part(object.transform);
  const auto* translucent = std::get_if<TranslucentMaterial>(&scene.materials[object.material].kind);
  const bool closed = translucent != nullptr;
  const bool matched = closed && translucent->boundary == Boundary::matched;
  const Rgb sigma_t = matched ? translucent->medium.sigma_t : Rgb(0);
  const DVec3& origin = object.transform.translate;
  if (std::holds_alternative<SphereShape>(object.shape))
    return {SphereBody(map), origin, size_of(map), size_of(map), closed, matched, false, sigma_t, {}};
  if (std::holds_alternative<BoxShape>(object.shape))
    return {BoxBody(map), origin, size_of(map), half_diagonal(map), closed, matched, false, sigma_t, {}};
  if (std::holds_alternative<SlabShape>(object.shape))
    return {SlabBody(map), origin, size_of(map), kInfinity, closed, matched, false, sigma_t, {}};
  SharedMesh mesh = make_mesh(std::get<std::shared_ptr<const Mesh>>(object.shape), map, previous);
  const Real size = largest(mesh->body.half_size());
  const DVec3 center = origin + mesh->center;
  const double radius = mesh->body.radius();
  return {std::move(mesh), center, size, radius, closed, matched, false, sigma_t, {}};
}

bool Geometry::is_finished() const {
  return std::ranges::all_of(bodies_, [](const Body& body) {
    const auto* mesh = std::get_if<SharedMesh>(&body.shape);
    return !mesh || !body.closed || (*mesh)->balls.ready();
  });
}

bool Geometry::finish(const std::atomic<bool>& stop) const {
  return std::ranges::all_of(bodies_, [&](const Body& body) {
    const auto* mesh = std::get_if<SharedMesh>(&body.shape);
    return !mesh || !body.closed || (*mesh)->balls.make(threads_, stop);
  });
}

SafeRegion Geometry::safe_region(std::size_t object) const noexcept {
  SafeRegion region = bodies_[object].region;
  if (const auto* mesh = std::get_if<SharedMesh>(&bodies_[object].shape))
    region.balls = &(*mesh)->balls.get();
  return region;
}

Real Geometry::clearance(std::size_t object, const Vec3& point) const noexcept {
  return walks_in_lanes(object) ? safe_region(object).clearance(point) : Real(0);
}

Real Geometry::offset(std::size_t object, const Vec3& point) const noexcept {
  const Body& body = bodies_[object];
  if (std::holds_alternative<SharedMesh>(body.shape)) return body.size * Real(0x1p-20);
  return std::max(largest(glm::abs(point)), body.size) * Real(0x1p-22);
}

Real Geometry::depth_beyond_looks(std::size_t object) const noexcept {
  const auto* mesh = std::get_if<SharedMesh>(&bodies_[object].shape);
  return mesh ? Real(1.01) * (*mesh)->body.looks_behind() : Real(0);
}

bool Geometry::holds(std::size_t object, const Vec3& point, const Vec3& direction) const noexcept {
  const auto* mesh = std::get_if<SharedMesh>(&bodies_[object].shape);
  return mesh && (*mesh)->body.depth(point, direction).value_or(0) > 0;
}

// f(shape, approach, placement) for one body.
template <class F>
auto Geometry::approach(std::size_t object, const Ray& ray, const F& f) const noexcept {
  const Body& body = bodies_[object];
  const Placement placement{body.center, body.size, body.closed, body.matched};
  Approach seen{ray.origin - body.center, ray.direction, 0, Vec3(0)};
  if (ray.departure.object == object) {
    seen.lifted = ray.departure.offset;
    seen.origin += DVec3(seen.lifted);
  } else if (ray.departure.object != Departure::kNowhere) {
    const double rounding = offset(object, Vec3(seen.origin));
    seen.slack = 2 * (double{glm::length(ray.departure.offset)} + rounding);
    seen.origin -= seen.slack * DVec3(ray.direction);
  }
  return std::visit([&](const auto& shape) { return f(world_of(shape), seen, placement); }, body.shape);
}

// Whether the ray has just left the object, outward, and the object is convex about its centre: it never
// comes back. From the inner side of an opaque one it does.
bool Geometry::leaves_for_good(std::size_t object, const Ray& ray) const noexcept {
  return ray.departure.object == object && !traces_rays(object) &&
         glm::dot(ray.departure.offset, ray.direction) > 0 &&
         glm::dot(DVec3(ray.departure.offset), ray.origin - bodies_[object].center) > 0;
}

// Puts the first surface of one object in the place of a farther one.
void Geometry::hit_before(std::size_t object, const Ray& ray,
                          std::optional<SurfaceHit>& closest) const noexcept {
  approach(object, ray, [&](const auto& shape, const Approach& seen, const Placement& placement) {
    const auto hit = first_hit(shape, seen, placement, closest ? closest->distance : kInfinity);
    if (!hit) return;
    closest = SurfaceHit{object,      hit->distance,       hit->point,
                         hit->normal, hit->shading_normal, glm::dot(hit->normal, ray.direction) < 0};
  });
}

std::optional<SurfaceHit> Geometry::hit_object(std::size_t object, const Ray& ray) const noexcept {
  std::optional<SurfaceHit> hit;
  hit_before(object, ray, hit);
  return hit;
}

std::optional<SurfaceHit> Geometry::closest_hit(const Ray& ray) const noexcept {
  std::optional<SurfaceHit> closest;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!leaves_for_good(i, ray)) hit_before(i, ray, closest);
  return closest;
}

Rgb Geometry::transmittance(const Ray& ray, double distance) const noexcept {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].matched) continue;
    const bool blocked =
        approach(i, ray, [&](const auto& shape, const Approach& seen, const Placement& placement) {
          return blocks(shape, seen, placement, distance);
        });
    if (blocked) return Rgb(0);
  }
  Rgb through(1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i].matched) continue;
    const double length =
        approach(i, ray, [&](const auto& shape, const Approach& seen, const Placement& placement) {
          return length_inside(shape, seen, placement, distance);
        });
    for (int c = 0; c < 3; ++c)
      through[c] *= meander::transmittance(bodies_[i].sigma_t[c], static_cast<Real>(length));
  }
  return through;
}

}  // namespace meander
