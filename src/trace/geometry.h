// A scene's geometry for rays and walks: every object a body in its own coordinates, placed by a translation
// in double.
#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <variant>

#include "scene/analytic_shapes.h"
#include "scene/camera_rays.h"
#include "scene/safe_region.h"
#include "scene/scene.h"
#include "trace/lazy_balls.h"
#include "trace/mesh_body.h"

namespace meander {

class Geometry {
 public:
  /// Builds what tracing needs, on at most `threads` threads; keeps nothing of the scene. Meshes that stand
  /// in `previous` under the same linear map are shared with it, its Embree device too; it may be destroyed
  /// at any time. Errors: Error(runtime).
  Geometry(const Scene& scene, int threads, const Geometry* previous = nullptr);

  /// The first surface along a ray, from either side.
  [[nodiscard]] std::optional<SurfaceHit> closest_hit(const Ray& ray) const noexcept;

  /// The first surface of one object along a ray, whatever else stands there.
  [[nodiscard]] std::optional<SurfaceHit> hit_object(std::size_t object, const Ray& ray) const noexcept;

  /// Along `distance` (may be infinite) of a ray: what matched bodies let through unscattered, per channel; 0
  /// where any other object stands in the way.
  [[nodiscard]] Rgb transmittance(const Ray& ray, double distance) const noexcept;

  /// Half the object's largest extent, about.
  [[nodiscard]] Real size(std::size_t object) const noexcept { return bodies_[object].size; }

  /// Of a ball about the object's origin that holds all of it; infinite for a slab.
  [[nodiscard]] double radius(std::size_t object) const noexcept { return bodies_[object].radius; }

  /// The object's own origin, in the world.
  [[nodiscard]] const DVec3& center(std::size_t object) const noexcept { return bodies_[object].center; }

  /// The distance that outweighs the rounding of a point of the object, given in its own coordinates.
  [[nodiscard]] Real offset(std::size_t object, const Vec3& point) const noexcept;

  /// How deep below an object's surface a step no longer finds, behind it, a wall at the same place: beyond
  /// what a mesh looks back for a wall that rounding has carried a point across. 0 where nothing does.
  [[nodiscard]] Real depth_beyond_looks(std::size_t object) const noexcept;

  /// Whether a point, in the object's own coordinates, is known to lie inside a mesh; found out along a
  /// direction. False where that leaves doubt, and of what is no mesh.
  [[nodiscard]] bool holds(std::size_t object, const Vec3& point, const Vec3& direction) const noexcept;

  /// Whether the object is matched and a light with an extent may lie inside.
  [[nodiscard]] bool holds_light(std::size_t object) const noexcept { return bodies_[object].holds_light; }

  /// Whether a step of a walk in the object costs a ray.
  [[nodiscard]] bool traces_rays(std::size_t object) const noexcept {
    return std::holds_alternative<SharedMesh>(bodies_[object].shape);
  }

  /// Whether walks in a translucent object are walked in lanes: it has a region in which a step costs no
  /// ray, and no light lies inside.
  [[nodiscard]] bool walks_in_lanes(std::size_t object) const noexcept {
    return bodies_[object].closed && !bodies_[object].holds_light;
  }

  /// Where steps of a walk in a translucent object cross nothing. Refers to the geometry, which must be
  /// finished.
  [[nodiscard]] SafeRegion safe_region(std::size_t object) const noexcept;

  /// A lower bound of the distance from a point of a translucent object, in its own coordinates, to its
  /// surface; the geometry must be finished.
  [[nodiscard]] Real clearance(std::size_t object, const Vec3& point) const noexcept;

  /// Whether the balls of every mesh that holds a medium are there; finish makes them, false when `stop` came
  /// first. Errors: whatever the making throws.
  [[nodiscard]] bool is_finished() const;
  [[nodiscard]] bool finish(const std::atomic<bool>& stop) const;

  /// f(world) with the object's own World. Errors: whatever f throws.
  template <class F>
  [[nodiscard]] auto with_body(std::size_t object, F&& f) const {
    return std::visit([&](const auto& shape) { return f(world_of(shape)); }, bodies_[object].shape);
  }

 private:
  // A mesh on its device, and what it was made of, by which another geometry knows it again.
  struct PlacedMesh {
    PlacedMesh(std::shared_ptr<RTCDeviceTy> on, const std::shared_ptr<const Mesh>& mesh, const DMat3& linear)
        : device(std::move(on)),
          source(mesh),
          map(linear),
          body(device.get(), *mesh, map, center),
          balls(body) {}

    std::shared_ptr<RTCDeviceTy> device;
    std::weak_ptr<const Mesh> source;
    DMat3 map;
    DVec3 center{0};
    MeshBody body;
    LazyBalls balls;
  };
  using SharedMesh = std::shared_ptr<const PlacedMesh>;

  struct Body {
    std::variant<SphereBody, BoxBody, SlabBody, SharedMesh> shape;
    DVec3 center;
    Real size;
    double radius;
    bool closed;   // it holds a medium: its surface has an inside
    bool matched;  // light passes it unscattered
    bool holds_light;
    Rgb sigma_t;
    SafeRegion region;  // but for a mesh's balls
  };

  template <class Shape>
  [[nodiscard]] static const Shape& world_of(const Shape& shape) noexcept {
    return shape;
  }
  [[nodiscard]] static const MeshBody& world_of(const SharedMesh& mesh) noexcept { return mesh->body; }

  [[nodiscard]] Body make_body(const Object& object, const Scene& scene, const Geometry* previous);
  [[nodiscard]] SharedMesh make_mesh(const std::shared_ptr<const Mesh>& mesh, const DMat3& map,
                                     const Geometry* previous);
  [[nodiscard]] SharedMesh find_mesh(const std::shared_ptr<const Mesh>& mesh, const DMat3& map) const;
  [[nodiscard]] static bool holds_light(const Body& body, const Scene& scene) noexcept;
  void hit_before(std::size_t object, const Ray& ray, std::optional<SurfaceHit>& closest) const noexcept;
  [[nodiscard]] bool leaves_for_good(std::size_t object, const Ray& ray) const noexcept;
  template <class F>
  auto approach(std::size_t object, const Ray& ray, const F& f) const noexcept;

  int threads_;
  std::shared_ptr<RTCDeviceTy> device_;  // made with the first mesh that needs one
  std::vector<Body> bodies_;
};

}  // namespace meander
