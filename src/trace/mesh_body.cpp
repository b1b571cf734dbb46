#include "trace/mesh_body.h"

#include <algorithm>
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
