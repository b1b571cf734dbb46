#include "trace/mesh_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"

namespace meander {
namespace {

void check_device(RTCDevice device, const char* doing) {
  if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE)
    throw Error(Fault::runtime, std::string("Embree failed with code ") + std::to_string(code) + " " + doing);
}

// Of a size about 1: how far around a point rounding is looked for, and what outweighs a point's rounding.
constexpr Real kMargin = Real(0x1p-14);
constexpr Real kOffset = Real(0x1p-21);

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

// The point of a triangle that is nearest to p: the nearest of its edges' points and, where that is inside,
// the foot of the perpendicular. Edges always count, so that a needle's normal may be as bad as it likes.
Vec3 nearest_in_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) noexcept {
  const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Real normal2 = glm::dot(normal, normal);
  bool inside = normal2 > 0;
  Vec3 best = corners[0];
  Real best2 = std::numeric_limits<Real>::infinity();
  const auto offer = [&](const Vec3& candidate) {
    const Real d2 = glm::dot(p - candidate, p - candidate);
    if (!(d2 < best2)) return;
    best2 = d2;
    best = candidate;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = corners[i];
    const Vec3 edge = corners[(i + 1) % 3] - from;
    const Vec3 to = p - from;
    inside = inside && glm::dot(glm::cross(edge, to), normal) >= 0;
    const Real length2 = glm::dot(edge, edge);
    offer(from + (length2 > 0 ? std::clamp(glm::dot(to, edge) / length2, Real(0), Real(1)) : Real(0)) * edge);
  }
  if (inside) offer(p - normal * (glm::dot(p - corners[0], normal) / normal2));
  return best;
}

// What a nearest-point query carries from triangle to triangle.
struct NearestSearch {
  const glm::vec3* positions;
  const Triangle* triangles;
  Vec3 place;
  Vec3 point{0};
  unsigned triangle = RTC_INVALID_GEOMETRY_ID;
};

bool visit_triangle(RTCPointQueryFunctionArguments* args) {
  auto& search = *static_cast<NearestSearch*>(args->userPtr);
  const Triangle& t = search.triangles[args->primID];
  const Vec3 point = nearest_in_triangle(
      search.place,
      {Vec3(search.positions[t[0]]), Vec3(search.positions[t[1]]), Vec3(search.positions[t[2]])});
  const auto distance = static_cast<float>(glm::length(search.place - point));
  if (!(distance < args->query->radius)) return false;
  args->query->radius = distance;
  search.point = point;
  search.triangle = args->primID;
  return true;
}

}  // namespace

Device make_device(int threads) {
  Device device(rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str()));
  check_device(device.get(), "making a device");
  return device;
}

MeshBody::MeshBody(RTCDevice device, const Mesh& mesh, const DMat3& map, DVec3& center)
    : triangles_(mesh.triangles), normal_triangles_(mesh.normal_triangles) {
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
  for (const DVec3& p : mapped) positions_.emplace_back((p - center) * double{inverse_scale_});
  positions_.emplace_back(0);
  const DMat3 normal_map = glm::transpose(glm::inverse(map));
  for (const glm::vec3& n : mesh.normals) normals_.emplace_back(glm::normalize(normal_map * DVec3(n)));
  if (glm::determinant(map) < 0) {
    for (Triangle& t : triangles_) std::swap(t[1], t[2]);
    for (Triangle& t : normal_triangles_) std::swap(t[1], t[2]);
  }

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

MeshHit MeshBody::resolve(const RTCRayHit& query) const noexcept {
  const Triangle& t = triangles_[query.hit.primID];
  const Vec3 a(positions_[t[0]]);
  const Vec3 b(positions_[t[1]]);
  const Vec3 c(positions_[t[2]]);
  const Real u = query.hit.u;
  const Real v = query.hit.v;
  const Real w = 1 - u - v;
  const Vec3 normal = glm::normalize(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
  Vec3 shading = normal;
  if (!normal_triangles_.empty()) {
    const Triangle& n = normal_triangles_[query.hit.primID];
    const Vec3 sum = w * Vec3(normals_[n[0]]) + u * Vec3(normals_[n[1]]) + v * Vec3(normals_[n[2]]);
    const Real length = glm::length(sum);
    if (length > 0 && glm::dot(sum, normal) > 0) shading = sum / length;
  }
  return {query.ray.tfar, w * a + u * b + v * c, normal, shading};
}

std::optional<MeshHit> MeshBody::closest(const Vec3& o, const Vec3& d, Real distance) const noexcept {
  RTCRayHit query = make_query(o * inverse_scale_, d, distance * inverse_scale_);
  intersect(scene_.get(), query, nullptr);
  if (!is_hit(query)) return std::nullopt;
  MeshHit hit = resolve(query);
  hit.distance *= scale_;
  hit.point *= scale_;
  return hit;
}

std::optional<Nearest> MeshBody::nearest(const Vec3& p, Real limit) const noexcept {
  NearestSearch search{positions_.data(), triangles_.data(), p * inverse_scale_};
  RTCPointQuery query{static_cast<float>(search.place.x), static_cast<float>(search.place.y),
                      static_cast<float>(search.place.z), 0, static_cast<float>(limit * inverse_scale_)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &query, &context, visit_triangle, &search);
  if (search.triangle == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Triangle& t = triangles_[search.triangle];
  const Vec3 a(positions_[t[0]]);
  const Vec3 normal = glm::cross(Vec3(positions_[t[1]]) - a, Vec3(positions_[t[2]]) - a);
  const Real length = glm::length(normal);
  return Nearest{search.point * scale_, length > 0 ? normal / length : Vec3(0), Real(query.radius) * scale_};
}

Crossing MeshBody::first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  Crossing crossing = cross(p * inverse_scale_, d, distance * inverse_scale_);
  crossing.distance = crossing.kind == CrossingKind::none ? distance : crossing.distance * scale_;
  crossing.point *= scale_;
  return crossing;
}

// Whether a point next to the surface lies outside of it: whether the nearest surface behind it, seen along
// its direction, was an exit.
bool MeshBody::is_outside(const Vec3& p, const Vec3& d) const noexcept {
  RTCRayHit query = make_query(p, -d, 2 * kMargin);
  intersect(scene_.get(), query, nullptr);
  if (!is_hit(query)) return false;
  return glm::dot(d, Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)) > 0;
}

// A step that meets no exit: inside, unless it ends beyond the bounds. Then it has leaked, and `distance` is
// how far the bounds are.
Crossing MeshBody::without_exit(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  const Vec3 half = half_size_ * inverse_scale_ + kMargin;
  const Vec3 end = p + distance * d;
  if (largest(glm::abs(end) - half) <= 0) return {CrossingKind::none, distance, end, {}, {}};
  Real far = distance;
  for (int axis = 0; axis < 3; ++axis)
    if (d[axis] != 0) far = std::min(far, (std::copysign(half[axis], d[axis]) - p[axis]) / d[axis]);
  return {CrossingKind::leaked, std::max(far, Real(0)), p, {}, {}};
}

Crossing MeshBody::cross(const Vec3& p, const Vec3& d, Real distance) const noexcept {
  // Looking from a little behind finds the exit that rounding may have carried the point across; looking a
  // little too far finds the surface that the end of the step may round across.
  RTCRayHit query = make_query(p - kMargin * d, d, distance + 2 * kMargin);
  intersect(scene_.get(), query, accept_exits);
  if (is_hit(query) && query.ray.tfar < kMargin && !is_outside(p, d)) {
    query = make_query(p, d, distance + kMargin);  // a thin gap behind: that exit belongs to another wall
    intersect(scene_.get(), query, accept_exits);
    query.ray.tfar += static_cast<float>(kMargin);
  }
  if (!is_hit(query)) return without_exit(p, d, distance);
  const Real exit_distance = std::max(Real(query.ray.tfar) - kMargin, Real(0));
  if (distance < exit_distance) {
    const Vec3 normal = glm::normalize(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
    const bool at_surface = (exit_distance - distance) * glm::dot(d, normal) < kOffset;
    const Vec3 end = p + distance * d;
    return {CrossingKind::none, distance, at_surface ? end - kOffset * normal : end, {}, {}};
  }
  const MeshHit hit = resolve(query);
  return {CrossingKind::exit, exit_distance, hit.point, hit.normal, hit.shading_normal};
}

}  // namespace meander
