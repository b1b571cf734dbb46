// One sample of a pixel: from the camera through media and off surfaces until the light is found or the
// weight is gone. Every light is sampled where the path scatters; rays that hit a light by themselves share
// it by the balance heuristic. An environment image is one more light; a constant environment is collected by
// escaping rays alone.
#pragma once

#include <atomic>
#include <optional>

#include "scene/crossing.h"
#include "walk/interface.h"
#include "walk/lights.h"
#include "walk/lobe.h"
#include "walk/random_walk.h"
#include "walk/rough_interface.h"
#include "walk/shadow_roulette.h"
#include "walk/sink.h"

namespace meander {

/// What a path asks of a scene's geometry.
/// closest_hit: the first surface along a ray. center: an object's origin in the world. offset: the distance
/// that outweighs the rounding of a point of it. with_body: calls f with the object's World, returns what f
/// returns. transmittance: along a segment through every matched body on it, 0 where anything else stands in
/// the way. traces_rays: whether a step in the object costs a ray. clearance: a lower bound of the distance
/// from a point in the object to its surface. depth_beyond_looks: how deep a walk must begin to find nothing
/// behind it. holds: whether a point is known to lie inside the object, of an object whose steps cost rays;
/// found out along a direction.
template <class G>
concept SceneGeometry = requires(const G& geometry, const Ray& ray, std::size_t object, const Vec3& point,
                                 double distance) {
  { geometry.closest_hit(ray) } -> std::same_as<std::optional<SurfaceHit>>;
  { geometry.center(object) } -> std::convertible_to<DVec3>;
  { geometry.offset(object, point) } -> std::convertible_to<Real>;
  { geometry.transmittance(ray, distance) } -> std::same_as<Rgb>;
  { geometry.traces_rays(object) } -> std::same_as<bool>;
  { geometry.holds_light(object) } -> std::same_as<bool>;
  { geometry.clearance(object, point) } -> std::convertible_to<Real>;
  { geometry.depth_beyond_looks(object) } -> std::convertible_to<Real>;
  { geometry.holds(object, point, ray.direction) } -> std::same_as<bool>;
};

/// What happened on the way, for statistics.
struct PathCounters {
  std::uint64_t walks = 0;
  std::uint64_t steps = 0;
  std::uint64_t rays = 0;
  std::uint64_t leaked_walks = 0;

  void operator+=(const PathCounters& other) noexcept {
    walks += other.walks;
    steps += other.steps;
    rays += other.rays;
    leaked_walks += other.leaked_walks;
  }
};

struct PathOptions {
  Estimator estimator = Estimator::implicit;
  bool chromatic = false;                   // some medium's sigma_t differs between channels
  bool knows_clearance = false;             // the geometry does, which makes shadow rays fewer
  const std::atomic<bool>* stop = nullptr;  // asked every kStopInterval steps
  bool sample_lights = true;                // false: lights are found by rays alone, which tests compare with
};

/// A path under way. `state` stands for what lies between two interactions: `vertex` is where it last
/// scattered, `pdf` the density per steradian of the direction it took there, `light_choice` the probability
/// with which any one light was sampled there. The rest belongs to the body that the path is inside of.
struct Path {
  struct State {
    Ray ray;
    PathWeight weight;
    bool scattered = false;  // false: this is still what the camera sees directly
    DVec3 vertex{0};
    Departure departure;  // what a shadow ray leaves there
    Real pdf = 0;
    Real light_choice = 1;
  };
  State state;
  SurfaceHit hit;  // where it came in
  const TranslucentMaterial* material = nullptr;
  Walker walker;
  ShadowRoulette shadows;
  std::uint64_t counted_steps = 0;  // of the walker's
  Vec3 set_out{0};                  // where on the surface the walk began, or was last mirrored
  Vec3 set_out_normal{0};           // outward, there; 0 once another wall was found at the same place
  int stays = 0;                    // crossings on one spot, since the path last got anywhere
  Vec3 spot{0};                     // where the first of them was
  std::uint64_t walks = 0;          // that have ended; a path of many short ones asks for the stop among them
};

/// What a path begins with: a camera ray, the first surface that it meets, and the channel that samples a
/// chromatic path's distances, uniformly distributed over the paths of a pixel; without it, it is drawn.
struct PathStart {
  Ray ray;
  std::optional<SurfaceHit> hit;
  std::optional<int> hero;
};

/// What a path needs next: the walk of path.walker in the body of path.hit, or nothing any more.
enum class PathStep { walk, done, interrupted };

/// Traces paths in one scene; holds references only. One tracer a thread, for the counters' sake.
template <SceneGeometry G>
class PathTracer {
 public:
  PathTracer(const Scene& scene, const G& geometry, const PathOptions& options)
      : scene_(scene), geometry_(geometry), options_(options), lights_(scene) {}

  /// Traces one path, with scalar walks, and hands its contributions to the sink; false when it was
  /// interrupted. `hero`: see PathStart.
  template <Sink S>
  [[nodiscard]] bool trace(const Ray& camera_ray, Random& random, S& sink,
                           std::optional<int> hero = std::nullopt) noexcept;

  /// The same in pieces, for walks that are walked elsewhere: takes a new path as far as its first walk.
  template <Sink S>
  [[nodiscard]] PathStep begin(Path& path, const PathStart& start, Random& random, S& sink) noexcept;

  /// Takes a path whose walk has ended as far as its next one.
  template <Sink S>
  [[nodiscard]] PathStep resume(Path& path, const WalkResult& walked, Random& random, S& sink) noexcept;

  /// What a camera ray finds of which it is known that it meets no surface.
  template <Sink S>
  void escape(const Ray& camera_ray, S& sink) const noexcept;

  /// The walk that a path needs, by the scalar code.
  template <Sink S>
  [[nodiscard]] WalkResult walk(Path& path, Random& random, S& sink) noexcept;

  /// What a walk's collision adds, see WalkEvents::scattered; the surface is at least `clearance` away.
  template <Sink S>
  void collided(Path& path, Real clearance, Random& random, S& sink) noexcept;

  /// Whether collided adds anything in bodies of a material.
  [[nodiscard]] bool lights_collisions(const TranslucentMaterial& material) const noexcept {
    return material.boundary == Boundary::matched && sampled_lights() > 0;
  }

  [[nodiscard]] bool stop() const noexcept {
    return options_.stop && options_.stop->load(std::memory_order_relaxed);
  }
  [[nodiscard]] const PathOptions& options() const noexcept { return options_; }
  [[nodiscard]] PathCounters& counters() noexcept { return counters_; }

 private:
  using State = Path::State;
  template <Sink S>
  struct Passage;

  enum class Step { go_on, walk, done };

  // Takes the path through interactions until it needs a walk or has ended.
  template <Sink S>
  [[nodiscard]] PathStep proceed(Path& path, Random& random, S& sink) noexcept;
  template <Sink S>
  [[nodiscard]] Step meet(Path& path, const std::optional<SurfaceHit>& hit, Random& random, S& sink) noexcept;
  template <Sink S>
  [[nodiscard]] Step reflect(const SurfaceHit& hit, const LambertLobe& lobe, State& state, Random& random,
                             S& sink) noexcept;
  template <Sink S>
  [[nodiscard]] bool collect_lights(const State& state, double distance, S& sink) const noexcept;
  template <Sink S>
  void collect_light(const State& state, std::size_t light, const LightHit& hit, S& sink) const noexcept;
  template <Sink S>
  void collect_environment(const State& state, S& sink) const noexcept;
  template <Sink S, class Weigh>
  void sample_direct(std::size_t light, const State& vertex, const Weigh& weigh, const Vec2& u,
                     S& sink) noexcept;

  // The lights that a vertex samples.
  [[nodiscard]] std::size_t sampled_lights() const noexcept {
    return options_.sample_lights ? count_sampled_lights(scene_) : 0;
  }
  // The probability with which a vertex that samples every light, or one of them, samples any one.
  [[nodiscard]] Real every_light() const noexcept { return options_.sample_lights ? Real(1) : Real(0); }
  [[nodiscard]] Real one_light() const noexcept {
    return sampled_lights() > 0 ? 1 / static_cast<Real>(sampled_lights()) : Real(0);
  }
  // A direction that no light was sampled for: whatever light the ray finds counts in full.
  static void send_specular(State& state, const Ray& ray) noexcept {
    state.ray = ray;
    state.vertex = ray.origin;
    state.pdf = 1;
    state.light_choice = 0;
    state.scattered = true;
  }
  // The ray that leaves an object at a point, on the side of `normal`.
  [[nodiscard]] Ray leave(std::size_t object, const Vec3& point, const Vec3& normal,
                          const Vec3& direction) const noexcept {
    return {geometry_.center(object) + DVec3(point),
            direction,
            {object, geometry_.offset(object, point) * normal}};
  }

  const Scene& scene_;
  const G& geometry_;
  PathOptions options_;
  PreparedLights lights_;
  PathCounters counters_;
};

}  // namespace meander

#include "walk/passage.inl"
#include "walk/path.inl"
