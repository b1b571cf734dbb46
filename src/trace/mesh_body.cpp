#include "trace/mesh_body.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "trace/packet_distances.h"
#include "trace/ray_batch.h"
#include "trace/triangle_place.h"

namespace meander {
namespace {

void check_device(RTCDevice device, const char* doing) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    throw Error(Fault::runtime, std::string("out of memory: Embree has not enough of it for ") + doing);
  if (code != RTC_ERROR_NONE)
    throw Error(Fault::runtime, std::string("Embree failed with code ") + std::to_string(code) + " " + doing);
}

// Of a size about 1: how far around a point rounding is looked for, and what outweighs a point's rounding.
constexpr Real kMargin = Real(0x1p-14);
constexpr Real kOffset = Real(0x1p-21);
// Longer than any way through the bounds.
constexpr Real kReach = 4;

RTCRayHit make_query(const Vec3& o, const Vec3& d, Real distance) noexcept {
  RTCRayHit query;
  query.ray.org_x = static_cast<float>(o.x);
  query.ray.org_y = static_cast<float>(o.y);
  query.ray.org_z = static_cast<float>(o.z);
  query.ray.tnear = 0;
  query.ray.dir_x = static_cast<float>(d.x);
  query.ray.dir_y = static_cast<float>(d.y);
  query.ray.dir_z = static_cast<float>(d.z);
  query.ray.time = 0;
  query.ray.tfar = static_cast<float>(distance);
  query.ray.mask = ~0u;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

bool is_hit(const RTCRayHit& query) noexcept { return query.hit.geomID != RTC_INVALID_GEOMETRY_ID; }

// Embree's geometric normal is that of counter-clockwise triangles: outward.
void accept_exits(const RTCFilterFunctionNArguments* args) {
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const float along = ray->dir_x * hit->Ng_x + ray->dir_y * hit->Ng_y + ray->dir_z * hit->Ng_z;
  if (!(along > 0)) args->valid[0] = 0;
}

void intersect(RTCScene scene, RTCRayHit& query, RTCFilterFunctionN filter) noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.filter = filter;
  rtcIntersect1(scene, &context, &query);
}

}  // namespace

Device make_device(int threads) {
  Device device(rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str()));
  check_device(device.get(), "making a device");
  return device;
}

MeshBody::MeshBody(RTCDevice device, const Mesh& mesh, const DMat3& map, DVec3& center)
    : triangles_(mesh.triangles) {
  std::vector<DVec3> mapped(mesh.positions.size());
  std::transform(mesh.positions.begin(), mesh.positions.end(), mapped.begin(),
                 [&](const DVec3& p) { return map * p; });
  DVec3 low = mapped.front();
  DVec3 high = low;
  for (const DVec3& p : mapped) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  center = 0.5 * (low + high);
  half_size_ = Vec3(0.5 * (high - low));
  scale_ = std::exp2(std::floor(std::log2(largest(half_size_))) + 1);
  inverse_scale_ = 1 / scale_;
  for (const DVec3& p : mapped) {
    positions_.emplace_back((p - center) * double{inverse_scale_});
    radius_ = std::max(radius_, glm::length(p - center) * (1 + 0x1p-18));
  }
  positions_.emplace_back(0);
  const DMat3 normal_map = glm::transpose(glm::inverse(map));
  std::vector<glm::vec3> normals;
  for (const glm::vec3& n : mesh.normals) normals.emplace_back(glm::normalize(normal_map * DVec3(n)));
  for (const Triangle& t : mesh.normal_triangles)
    normals_.push_back({normals[t[0]], normals[t[1]], normals[t[2]]});
  if (glm::determinant(map) < 0) {
    for (Triangle& t : triangles_) std::swap(t[1], t[2]);
    for (auto& n : normals_) std::swap(n[1], n[2]);
  }

  packets_ = make_packets(std::span(positions_).first(positions_.size() - 1), triangles_);
  cells_ = make_surface_cells(packets_, glm::vec3(half_size_ * inverse_scale_));
  scene_.reset(rtcNewScene(device));
  rtcSetSceneFlags(scene_.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                            RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions_.data(), 0,
                             sizeof(glm::vec3), positions_.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles_.data(), 0,
                             sizeof(Triangle), triangles_.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  check_device(device, "building a mesh's hierarchy");
}

Real MeshBody::looks_behind() const noexcept { return kMargin * scale_; }

MeshBody::Met MeshBody::met_by(const RTCRayHit& query) const noexcept {
  const Triangle& t = triangles_[query.hit.primID];
  const RTCRay& ray = query.ray;
  const glm::vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  const glm::vec3 near =
      glm::vec3(ray.org_x, ray.org_y, ray.org_z) + ray.tfar * glm::vec3(ray.dir_x, ray.dir_y, ray.dir_z);
  const TrianglePlace place = place_on({positions_[t[0]], positions_[t[1]], positions_[t[2]]}, query.hit.u,
                                       query.hit.v, near, normal);
  return {query.hit.primID, ray.tfar, Vec3(place.point), Vec3(normal), Real(place.u), Real(place.v)};
}

Vec3 MeshBody::shading_normal(std::uint32_t triangle, Real u, Real v, const Vec3& normal) const noexcept {
  if (normals_.empty()) return normal;
  const auto& n = normals_[triangle];
  const Vec3 sum = (1 - u - v) * Vec3(n[0]) + u * Vec3(n[1]) + v * Vec3(n[2]);
  const Real length = glm::length(sum);
  return length > 0 && glm::dot(sum, normal) > 0 ? sum / length : normal;
}

std::optional<MeshHit> MeshBody::closest(const Vec3& o, const Vec3& d, Real distance) const noexcept {
  return hit_by(o, d, distance, nullptr);
}

std::optional<MeshHit> MeshBody::exit_within(const Vec3& o, const Vec3& d, Real distance) const noexcept {
  return hit_by(o, d, distance, accept_exits);
}

// Who goes backward leaves by it.
std::optional<MeshHit> MeshBody::entry_behind(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  return hit_by(p, -d, distance, accept_exits);
}

std::optional<MeshHit> MeshBody::hit_by(const Vec3& o, const Vec3& d, Real distance,
                                        RTCFilterFunctionN filter) const noexcept {
  RTCRayHit query = make_query(o * inverse_scale_, d, distance * inverse_scale_);
  intersect(scene_.get(), query, filter);
  if (!is_hit(query)) return std::nullopt;
  const Met met = met_by(query);
  const Vec3 normal = glm::normalize(met.normal);
  return MeshHit{met.distance * scale_, met.point * scale_, normal,
                 shading_normal(met.triangle, met.u, met.v, normal)};
}

std::optional<Nearest> MeshBody::nearest(const Vec3& p, Real limit, std::uint64_t& looked) const noexcept {
  const NearestPoint found =
      find_nearest(packets_, glm::vec3(p * inverse_scale_), static_cast<float>(limit * inverse_scale_));
  looked += found.looked;
  if (found.triangle == NearestPoint::kNoTriangle) return std::nullopt;
  const Triangle& t = triangles_[found.triangle];
  const Vec3 a(positions_[t[0]]);
  const Vec3 normal = glm::cross(Vec3(positions_[t[1]]) - a, Vec3(positions_[t[2]]) - a);
  const Real length = glm::length(normal);
  return Nearest{Vec3(found.point) * scale_, length > 0 ? normal / length : Vec3(0),
                 Real(found.distance) * scale_};
}

Real MeshBody::depth_from(const Vec3& from, Real spread, const Vec3& p, Real radius) const noexcept {
  const auto local = [&](Real length) { return static_cast<float>(length * inverse_scale_); };
  const auto place = [&](const Vec3& v) { return glm::vec3(v * inverse_scale_); };
  return Real(find_depth(packets_, {place(from), local(spread)}, {place(p), local(radius)}, local(radius))) *
         scale_;
}

MeshBody::Begun MeshBody::restore(Begun begun, Real distance) const noexcept {
  Crossing& crossing = begun.crossing;
  crossing.distance = crossing.kind == CrossingKind::none ? distance : crossing.distance * scale_;
  crossing.point *= scale_;
  return begun;
}

void MeshBody::begin_crossings(const Steps& steps, std::span<Begun> begun) const noexcept {
  static_assert(kRayBatch >= Steps::kMost);
  GridRays rays{};  // vectors read beyond the last one
  GridExit exits[kRayBatch];
  const std::size_t count = begun.size();
  const auto scale = static_cast<float>(inverse_scale_);
  constexpr auto kBehind = static_cast<float>(kMargin);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i) {
      rays.direction[axis][i] = steps.direction[axis][i];
      rays.origin[axis][i] = steps.from[axis][i] * scale - kBehind * steps.direction[axis][i];
    }
  for (std::size_t i = 0; i < count; ++i)
    rays.distance[i] = std::min(steps.distance[i] * scale + 2 * kBehind, static_cast<float>(kReach));
  find_exits(packets_, cells_, rays, std::span(exits).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Step step{{steps.from[0][i], steps.from[1][i], steps.from[2][i]},
                    {steps.direction[0][i], steps.direction[1][i], steps.direction[2][i]},
                    steps.distance[i]};
    begun[i] = restore(cross(scaled(step), exits[i]), step.distance);
    if (begun[i].triangle == Begun::kNoTriangle || normals_.empty()) continue;
    const auto* normals = reinterpret_cast<const char*>(&normals_[begun[i].triangle]);
    hwy::Prefetch(normals);
    hwy::Prefetch(normals + sizeof(normals_[0]) - 1);
  }
}

Crossing MeshBody::finish_crossing(const Begun& begun) const noexcept {
  Crossing crossing = begun.crossing;
  if (begun.triangle != Begun::kNoTriangle)
    crossing.shading_normal = shading_normal(begun.triangle, begun.u, begun.v, crossing.normal);
  return crossing;
}

Crossing MeshBody::first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  const Step step = scaled({p, d, distance});
  return finish_crossing(restore(cross(step, find_exit(packets_, cells_, grid_ray(step))), distance));
}

Crossing MeshBody::first_crossing_in_tree(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  return finish_crossing(restore(cross_in_tree(p * inverse_scale_, d, distance * inverse_scale_), distance));
}

// Whether rounding has carried a point out of the body: whether the nearest surface behind it, seen along its
// direction, was an exit, and it is not in front of an entry that is nearer. A walk that has just entered
// from a narrow gap may lie in that gap by a rounding; taken for one that has left by the wall behind, it
// would enter at the same point again, and never end. Nor has it left where another wall at the same place
// has taken it in again.
bool MeshBody::is_outside(const Vec3& p, const Vec3& d) const noexcept {
  struct Wall {
    Real height = std::numeric_limits<Real>::infinity();  // of the point over its plane, on either side
    bool leaves = false;                                  // who passes it along d
  };
  const auto nearest_wall = [&](const Vec3& direction) {
    RTCRayHit query = make_query(p, direction, 2 * kMargin);
    intersect(scene_.get(), query, nullptr);
    if (!is_hit(query)) return Wall{};
    const Real along = glm::dot(d, glm::normalize(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)));
    return Wall{query.ray.tfar * std::abs(along), along > 0};
  };
  const Wall behind = nearest_wall(-d);
  if (!behind.leaves) return false;
  const Wall ahead = nearest_wall(d);
  return (ahead.leaves || behind.height <= ahead.height) && depth(p * scale_, d).value_or(0) <= 0;
}

// A step that meets no exit: inside, unless it ends beyond the bounds. Then it has leaked, and `distance` is
// how far the bounds are.
MeshBody::Begun MeshBody::without_exit(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  const Vec3 half = half_size_ * inverse_scale_ + kMargin;
  const Vec3 end = p + distance * d;
  if (largest(glm::abs(end) - half) <= 0) return {{CrossingKind::none, distance, end, {}, {}}};
  Real far = distance;
  for (int axis = 0; axis < 3; ++axis)
    if (d[axis] != 0) far = std::min(far, (std::copysign(half[axis], d[axis]) - p[axis]) / d[axis]);
  return {{CrossingKind::leaked, std::max(far, Real(0)), p, {}, {}}};
}

// Looking from a little behind finds the exit that rounding may have carried the point across; looking a
// little too far finds the surface that the end of the step may round across.
GridRay MeshBody::grid_ray(const Step& step) noexcept {
  return {glm::vec3(step.from - kMargin * step.direction), glm::vec3(step.direction),
          static_cast<float>(std::min(step.distance + 2 * kMargin, kReach))};
}

MeshBody::Begun MeshBody::cross(const Step& step, const GridExit& exit) const noexcept {
  const auto& [p, d, distance] = step;
  if (exit.kind == GridExit::Kind::none) {
    const Begun inside = without_exit(p, d, distance);
    if (inside.crossing.kind != CrossingKind::leaked) return inside;
  }
  // What seems to leave through a hole may have been aimed at a corner.
  if (exit.kind != GridExit::Kind::exit || exit.distance < kMargin) return cross_in_tree(p, d, distance);
  return cross_at(p, d, distance,
                  {exit.triangle, exit.distance, Vec3(exit.point), Vec3(exit.normal), exit.u, exit.v});
}

MeshBody::Begun MeshBody::cross_in_tree(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  RTCRayHit query = make_query(p - kMargin * d, d, distance + 2 * kMargin);
  intersect(scene_.get(), query, accept_exits);
  if (is_hit(query) && query.ray.tfar < kMargin && !is_outside(p, d)) {
    query = make_query(p, d, distance + kMargin);  // a thin gap behind: that exit belongs to another wall
    intersect(scene_.get(), query, accept_exits);
    query.ray.tfar += static_cast<float>(kMargin);
  }
  if (!is_hit(query)) return without_exit(p, d, distance);
  return cross_at(p, d, distance, met_by(query));
}

// A step that may meet an exit, `met` from kMargin behind.
MeshBody::Begun MeshBody::cross_at(const Vec3& p, const Vec3& d, Real distance, const Met& met) noexcept {
  const Real exit_distance = std::max(met.distance - kMargin, Real(0));
  const Vec3 normal = glm::normalize(met.normal);
  if (distance < exit_distance) {
    const bool at_surface = (exit_distance - distance) * glm::dot(d, normal) < kOffset;
    const Vec3 end = p + distance * d;
    return {{CrossingKind::none, distance, at_surface ? end - kOffset * normal : end, {}, {}}};
  }
  return {{CrossingKind::exit, exit_distance, met.point, normal, normal}, met.triangle, met.u, met.v};
}

}  // namespace meander
