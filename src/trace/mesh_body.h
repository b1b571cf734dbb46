// A closed triangle mesh on Embree, in its own coordinates: centred on its bounds, so that a body far from
// the origin is as exact as one at it.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/crossing.h"
#include "trace/packet_rays.h"

namespace meander {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;

/// An Embree device whose builds use at most `threads` threads. Errors: Error(runtime) when none can be made.
[[nodiscard]] Device make_device(int threads);

/// Where a line meets the surface: the distance, the place and both normals (unit, outward).
struct MeshHit {
  Real distance;
  Vec3 point;
  Vec3 normal;
  Vec3 shading_normal;
};

/// The point of the surface that is nearest to another, and the geometric normal there (unit, outward).
struct Nearest {
  Vec3 point;
  Vec3 normal;
  Real distance;
};

class MeshBody {
 public:
  /// The mesh under the linear map, moved so that its bounds are centred on the origin; `center` receives
  /// where that centre was. The mesh must have triangles; a map that mirrors turns them. Errors:
  /// Error(runtime) from Embree.
  MeshBody(RTCDevice device, const Mesh& mesh, const DMat3& map, DVec3& center);

  /// The step of length `distance` (>= 0, may be infinite) from a point inside along a unit direction. Only
  /// crossings outward count. A point that rounding left outside leaves at once, and one about to be left
  /// outside is moved in by the offset. Looked up in a grid; in Embree's tree where that has no answer.
  [[nodiscard]] Crossing first_crossing(const Vec3& p, const Vec3& d, Real distance) const noexcept;

  /// The same, always by Embree's tree: the oracle of the grid.
  [[nodiscard]] Crossing first_crossing_in_tree(const Vec3& p, const Vec3& d, Real distance) const noexcept;

  /// How far behind a step's beginning an exit still counts as one that rounding has carried it across.
  [[nodiscard]] Real looks_behind() const noexcept;

  /// A step whose shading normal is still to be looked up, in memory that has been asked for.
  struct Begun {
    static constexpr std::uint32_t kNoTriangle = 0xffffffff;

    Crossing crossing;  // whose shading normal is the geometric one
    std::uint32_t triangle = kNoTriangle;
    Real u = 0;  // the weights of the triangle's second and third corners
    Real v = 0;
  };

  /// first_crossing in two parts, for who has several steps under way: the first of all of them, in as many
  /// `begun`, then the second of each.
  void begin_crossings(const Steps& steps, std::span<Begun> begun) const noexcept;
  [[nodiscard]] Crossing finish_crossing(const Begun& begun) const noexcept;

  /// The first surface within `distance` along a ray, from either side.
  [[nodiscard]] std::optional<MeshHit> closest(const Vec3& o, const Vec3& d, Real distance) const noexcept;

  /// Of all points of the surface within `limit` the nearest to `p`; its distance is short of the true one,
  /// or beyond it, by at most 2^-20 of the scale. Adds what the search has cost to `looked`, in packets.
  [[nodiscard]] std::optional<Nearest> nearest(const Vec3& p, Real limit,
                                               std::uint64_t& looked) const noexcept;
  [[nodiscard]] std::optional<Nearest> nearest(const Vec3& p, Real limit) const noexcept {
    std::uint64_t looked = 0;
    return nearest(p, limit, looked);
  }

  /// How much of `distance` (may be infinite) of a ray lies inside the mesh, which must be closed; `outside`
  /// says that the ray is known to start there. In one traversal; nothing where that is in doubt: beside an
  /// edge, at a grazing angle, past a hole, with more than 16 meetings.
  [[nodiscard]] std::optional<double> length_inside(const Vec3& o, const Vec3& d, double distance,
                                                    bool outside) const noexcept;

  /// How many times the surface wraps a point, 0 outside, which must be closed: counted along the line
  /// through it, to both ends. Where two walls lie at one place, both count, whichever is met first. Nothing
  /// where the two ends differ or are in doubt, as above.
  [[nodiscard]] std::optional<int> depth(const Vec3& p, const Vec3& d) const noexcept;

  /// The first wall within `distance` along a ray that it leaves by, whatever else it meets.
  [[nodiscard]] std::optional<MeshHit> exit_within(const Vec3& o, const Vec3& d,
                                                   Real distance) const noexcept;

  /// The last wall within `distance` behind a point that one who comes along `d` enters by.
  [[nodiscard]] std::optional<MeshHit> entry_behind(const Vec3& p, const Vec3& d,
                                                    Real distance) const noexcept;

  /// A radius of a ball about `p`, at most `radius`, for which no step to a point of it from a point inside
  /// of the body within `spread` of `from` leaves the body; 0 or less where there is none. The ball of
  /// `radius` must hold no part of the surface.
  [[nodiscard]] Real depth_from(const Vec3& from, Real spread, const Vec3& p, Real radius) const noexcept;

  /// In how many packets the triangles lie.
  [[nodiscard]] std::uint64_t packet_count() const noexcept { return packets_.packets.size(); }

  /// Of a ball about the origin that holds the mesh.
  [[nodiscard]] double radius() const noexcept { return radius_; }

  /// Half the size of the bounds along each axis.
  [[nodiscard]] const Vec3& half_size() const noexcept { return half_size_; }

  /// A power of two just above the largest of them, by which rounding is measured.
  [[nodiscard]] Real scale() const noexcept { return scale_; }

 private:
  // Where a triangle is met: its second and third corners weigh u and v there.
  struct Met {
    std::uint32_t triangle;
    Real distance;
    Vec3 point;
    Vec3 normal;  // of any length
    Real u;
    Real v;
  };
  [[nodiscard]] Met met_by(const RTCRayHit& query) const noexcept;
  [[nodiscard]] std::optional<MeshHit> hit_by(const Vec3& o, const Vec3& d, Real distance,
                                              RTCFilterFunctionN filter) const noexcept;

  // In units of scale_.
  [[nodiscard]] Vec3 shading_normal(std::uint32_t triangle, Real u, Real v,
                                    const Vec3& normal) const noexcept;
  [[nodiscard]] bool is_outside(const Vec3& p, const Vec3& d) const noexcept;
  [[nodiscard]] static GridRay grid_ray(const Step& step) noexcept;
  [[nodiscard]] Begun cross(const Step& step, const GridExit& exit) const noexcept;
  [[nodiscard]] Begun cross_in_tree(const Vec3& p, const Vec3& d, Real distance) const noexcept;
  [[nodiscard]] static Begun cross_at(const Vec3& p, const Vec3& d, Real distance, const Met& met) noexcept;
  [[nodiscard]] Begun without_exit(const Vec3& p, const Vec3& d, Real distance) const noexcept;
  [[nodiscard]] Step scaled(const Step& step) const noexcept {
    return {step.from * inverse_scale_, step.direction, step.distance * inverse_scale_};
  }
  [[nodiscard]] Begun restore(Begun begun, Real distance) const noexcept;

  std::vector<glm::vec3> positions_;  // one spare at the end: Embree reads 16 bytes a vertex
  std::vector<Triangle> triangles_;
  std::vector<std::array<glm::vec3, 3>> normals_;  // of each triangle's corners, if the mesh has any
  Packets packets_;
  SurfaceCells cells_;
  std::unique_ptr<RTCSceneTy, SceneRelease> scene_;
  Vec3 half_size_{0};
  double radius_ = 0;
  // Inside, lengths are divided by a power of two, exactly, so that every mesh is of a size about 1.
  Real scale_ = 1;
  Real inverse_scale_ = 1;
};

}  // namespace meander
