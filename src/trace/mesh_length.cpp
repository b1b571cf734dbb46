// How much of a line lies inside a closed mesh, in one traversal, and how deep inside a point lies.
#include <algorithm>
#include <array>
#include <limits>

#include "trace/mesh_body.h"

namespace meander {
namespace {

// Where a line meets the surface, in any order; `leaves` where it goes outward there.
struct Meeting {
  float distance;
  bool leaves;
};

// More meetings than that are left to a walk from one to the next.
constexpr std::size_t kMost = 16;

// So near to an edge of the triangle, in barycentric coordinates, or at so small an angle to it a line may by
// rounding meet both neighbours or none. A narrower margin does where two counts must agree.
constexpr float kDoubtful = 0x1p-10f;
constexpr float kDoubtfulCount = 0x1p-16f;

// What the traversal carries. Embree hands the filter a pointer to the first member.
struct Gathering {
  RTCIntersectContext context;
  std::array<Meeting, kMost> met;
  std::size_t count = 0;
  float margin = kDoubtful;
  bool doubtful = false;
};

// Takes every hit down and refuses it, so that the traversal goes on to the next; a doubtful one ends it.
void gather(const RTCFilterFunctionNArguments* args) {
  auto& gathering = *reinterpret_cast<Gathering*>(args->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  const glm::vec3 normal(hit->Ng_x, hit->Ng_y, hit->Ng_z);
  const float along = glm::dot(glm::vec3(ray->dir_x, ray->dir_y, ray->dir_z), normal);
  const float inward = std::min({hit->u, hit->v, 1 - hit->u - hit->v});
  const float margin = gathering.margin;
  gathering.doubtful = gathering.count == kMost || !(inward > margin) ||
                       !(along * along > margin * margin * glm::dot(normal, normal));
  if (gathering.doubtful) return;
  gathering.met[gathering.count++] = {ray->tfar, along > 0};
  args->valid[0] = 0;
}

// All meetings from a point on, without end.
Gathering gather_from(RTCScene scene, const glm::vec3& p, const glm::vec3& v, float margin) noexcept {
  RTCRay ray{p.x, p.y, p.z, 0, v.x, v.y, v.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
  Gathering gathering;
  gathering.margin = margin;
  rtcInitIntersectContext(&gathering.context);
  gathering.context.filter = gather;
  rtcOccluded1(scene, &gathering.context, &ray);
  return gathering;
}

}  // namespace

std::optional<int> MeshBody::depth(const Vec3& p, const Vec3& d) const noexcept {
  const auto count = [&](const Vec3& direction) -> std::optional<int> {
    const Gathering found =
        gather_from(scene_.get(), glm::vec3(p * inverse_scale_), glm::vec3(direction), kDoubtfulCount);
    if (found.doubtful) return std::nullopt;
    int depth = 0;
    for (std::size_t i = 0; i < found.count; ++i) depth += found.met[i].leaves ? 1 : -1;
    return depth;
  };
  const auto ahead = count(d);
  return ahead && ahead == count(-d) ? ahead : std::nullopt;
}

std::optional<double> MeshBody::length_inside(const Vec3& o, const Vec3& d, double distance,
                                              bool outside) const noexcept {
  Gathering gathering = gather_from(scene_.get(), glm::vec3(o * inverse_scale_), glm::vec3(d), kDoubtful);
  if (gathering.doubtful) return std::nullopt;
  const auto end = gathering.met.begin() + static_cast<std::ptrdiff_t>(gathering.count);
  std::sort(gathering.met.begin(), end,
            [](const Meeting& a, const Meeting& b) { return a.distance < b.distance; });
  const double reach = distance * double{inverse_scale_};
  double inside = 0;
  int depth = 0;  // between two meetings, from the far end back: the line ends outside
  double beyond = reach;
  for (auto at = end; at != gathering.met.begin();) {
    --at;
    const double here = std::min(double{at->distance}, reach);
    if (depth > 0) inside += beyond - here;
    depth += at->leaves ? 1 : -1;
    if (depth < 0 && at != gathering.met.begin() && (at - 1)->distance != at->distance) return std::nullopt;
    beyond = here;
  }
  if (depth < 0 || (outside && depth != 0)) return std::nullopt;
  if (depth > 0) inside += beyond;
  return inside * double{scale_};
}

}  // namespace meander
