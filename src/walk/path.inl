// The template bodies of walk/path.h.
#pragma once

namespace meander {

namespace detail {

/// What a path hands over for radiance found by its own ray, without competition from light sampling.
[[nodiscard]] inline Contribution make_contribution(const PathWeight& weight, const Rgb& unweighted,
                                                    int group) noexcept {
  return {group, weight.order, unweighted, weight.albedo, weight.length};
}

/// The weight of light that a ray has found, without throughput: the balance heuristic, over both ways and
/// all channels, between a ray whose direction had the density `pdf` and sampling the light with `sampled`.
[[nodiscard]] inline Rgb found_weight(const PathWeight& weight, Real pdf, Real sampled) noexcept {
  const Rgb passed = weight.ratio * weight.since;
  return passed * (pdf / (average(passed) * pdf + average(weight.ratio) * sampled));
}

[[nodiscard]] inline bool is_black(const Rgb& c) noexcept { return c.x == 0 && c.y == 0 && c.z == 0; }

}  // namespace detail

/// Samples a light at every collision of a walk in a matched body; silent elsewhere.
template <SceneGeometry G>
template <Sink S>
struct PathTracer<G>::WalkObserver {
  PathTracer& tracer;
  S& sink;
  Random& random;
  std::size_t object;
  Real g;
  bool lit;

  void segment(const Walker&, Real) const noexcept {}
  void absorbed(const Rgb&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return tracer.stop(); }

  void scattered(const Walker& walker) noexcept {
    if (!lit) return;
    const std::size_t count = count_sampled_lights(tracer.scene_);
    const std::size_t light =
        std::min(static_cast<std::size_t>(random.next() * static_cast<Real>(count)), count - 1);
    const Real u1 = random.next();
    const Real u2 = random.next();
    State vertex;
    vertex.weight = walker.weight;
    vertex.vertex = tracer.geometry_.center(object) + DVec3(walker.position);
    vertex.light_choice = tracer.walk_light_choice();
    const auto phase = [&](const Vec3& d) { return eval_henyey_greenstein(g, walker.direction, d); };
    tracer.sample_direct(light, vertex, phase, {u1, u2}, sink);
  }
};

template <SceneGeometry G>
template <Sink S>
bool PathTracer<G>::trace(const Ray& camera_ray, Random& random, S& sink) noexcept {
  State state;
  state.ray = camera_ray;
  state.vertex = camera_ray.origin;
  if (options_.chromatic) state.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
  for (std::uint64_t vertices = 1;; ++vertices) {
    if (vertices % kStopInterval == 0 && stop()) return false;
    const Step step = advance(state, random, sink);
    if (step != Step::go_on) return step == Step::done;
  }
}

template <SceneGeometry G>
template <Sink S>
auto PathTracer<G>::advance(State& state, Random& random, S& sink) noexcept -> Step {
  ++counters_.rays;
  const std::optional<SurfaceHit> hit = geometry_.closest_hit(state.ray);
  if (collect_lights(state, hit ? hit->distance : std::numeric_limits<double>::infinity(), sink))
    return Step::done;
  if (!hit) {
    collect_environment(state, sink);
    return Step::done;
  }
  const auto& kind = scene_.materials[scene_.objects[hit->object].material].kind;
  if (const auto* translucent = std::get_if<TranslucentMaterial>(&kind))
    return cross_body(*hit, *translucent, state, random, sink);
  if (const auto* emissive = std::get_if<EmissiveMaterial>(&kind)) {
    const Rgb radiance = state.weight.throughput * state.weight.free_path_weight() * emissive->radiance;
    sink.add(detail::make_contribution(state.weight, radiance, 0));
    return Step::done;
  }
  state.weight.throughput *= std::get<DiffuseMaterial>(kind).color;
  const Real side = hit->entering ? Real(1) : Real(-1);
  return reflect(*hit, make_lobe(side * hit->normal, side * hit->shading_normal), state, random, sink);
}

// A Lambertian vertex: every light is sampled once, then a direction of the lobe goes on.
template <SceneGeometry G>
template <Sink S>
auto PathTracer<G>::reflect(const SurfaceHit& hit, const LambertLobe& lobe, State& state, Random& random,
                            S& sink) noexcept -> Step {
  state.weight.vertex();
  if (!state.weight.survives_roulette(random, kRouletteThreshold)) return Step::done;
  state.vertex = outside(hit.object, hit.point, lobe.normal);
  state.light_choice = 1;
  for (std::size_t light = 0; light < count_sampled_lights(scene_); ++light) {
    const Real u1 = random.next();
    const Real u2 = random.next();
    sample_direct(
        light, state, [&](const Vec3& d) { return lobe.eval(d); }, {u1, u2}, sink);
  }
  const Real u1 = random.next();
  const Real u2 = random.next();
  state.ray = {state.vertex, lobe.sample({u1, u2})};
  state.pdf = lobe.eval(state.ray.direction);
  state.scattered = true;
  return Step::go_on;
}

template <SceneGeometry G>
template <Sink S>
auto PathTracer<G>::cross_body(const SurfaceHit& hit, const TranslucentMaterial& material, State& state,
                               Random& random, S& sink) noexcept -> Step {
  const bool matched = material.boundary == Boundary::matched;
  Walker walker;
  walker.weight = state.weight;
  walker.direction = state.ray.direction;
  if (hit.entering) {
    walker.position = hit.point - geometry_.offset(hit.object, hit.point) * hit.normal;
    if (!matched) {
      const Real u1 = random.next();
      const Real u2 = random.next();
      walker.direction = make_lobe(-hit.normal, -hit.shading_normal).sample({u1, u2});
      walker.weight.vertex();
    }
  } else {
    walker.position = Vec3(state.ray.origin - geometry_.center(hit.object));
  }
  WalkObserver<S> observer{
      *this, sink, random, hit.object, material.medium.g, matched && count_sampled_lights(scene_) > 0};
  const WalkModel model{material.medium, options_.estimator};
  const WalkResult result = geometry_.with_body(
      hit.object, [&](const auto& world) { return random_walk(world, model, walker, random, observer); });
  ++counters_.walks;
  counters_.steps += walker.steps;
  if (geometry_.traces_rays(hit.object)) counters_.rays += walker.steps;
  if (result.end == WalkEnd::interrupted) return Step::interrupted;
  if (result.end == WalkEnd::absorbed) return Step::done;
  const bool unscattered = walker.weight.order == state.weight.order;
  state.weight = walker.weight;
  if (result.end == WalkEnd::leaked) {
    ++counters_.leaked_walks;
    state.ray.direction = walker.direction;
    if (!matched || !unscattered) {
      state.pdf = matched ? pdf_last_direction(walker, material.medium.g) : Real(1);
      state.light_choice = matched ? walk_light_choice() : Real(0);
      state.scattered = true;
    }
    collect_environment(state, sink);
    return Step::done;
  }
  if (matched) {
    const DVec3 exit = outside(hit.object, result.crossing.point, result.crossing.normal);
    if (!unscattered) {
      state.vertex = geometry_.center(hit.object) + DVec3(result.crossing.point) -
                     double{result.crossing.distance} * DVec3(walker.direction);
      state.pdf = pdf_last_direction(walker, material.medium.g);
      state.light_choice = walk_light_choice();
      state.scattered = true;
    }
    state.ray = {exit, walker.direction};
    return Step::go_on;
  }
  SurfaceHit exit = hit;
  exit.point = result.crossing.point;
  return reflect(exit, make_lobe(result.crossing.normal, result.crossing.shading_normal), state, random,
                 sink);
}

// Adds the lights that the ray meets before `distance`; true when a light that the camera sees ends the path.
template <SceneGeometry G>
template <Sink S>
bool PathTracer<G>::collect_lights(const State& state, double distance, S& sink) const noexcept {
  // Seen from the last vertex, which lies straight behind the ray's origin, across matched bodies.
  const Ray from_vertex{state.vertex, state.ray.direction};
  const double behind = glm::dot(state.ray.origin - state.vertex, DVec3(state.ray.direction));
  std::size_t nearest = scene_.lights.size();
  LightHit seen{distance, Rgb(0), 0};
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Light& light = scene_.lights[i];
    if (!state.scattered && !light.visible) continue;
    const auto hit = hit_light(light, from_vertex);
    if (!hit || hit->distance < behind || hit->distance - behind >= distance) continue;
    const PathWeight& weight = state.weight;
    if (!state.scattered) {
      if (hit->distance - behind >= seen.distance) continue;
      seen = *hit;
      seen.distance -= behind;
      nearest = i;
      continue;
    }
    const Rgb found = detail::found_weight(weight, state.pdf, hit->pdf * state.light_choice);
    const Rgb radiance = weight.throughput * found * hit->radiance;
    sink.add(detail::make_contribution(weight, radiance, 1 + static_cast<int>(i)));
  }
  if (nearest == scene_.lights.size()) return false;
  const Rgb radiance = state.weight.throughput * state.weight.free_path_weight() * seen.radiance;
  sink.add(detail::make_contribution(state.weight, radiance, 1 + static_cast<int>(nearest)));
  return true;
}

template <SceneGeometry G>
template <Sink S>
void PathTracer<G>::collect_environment(const State& state, S& sink) const noexcept {
  const Environment& environment = scene_.environment;
  if (!state.scattered && !environment.visible) return;
  const PathWeight& weight = state.weight;
  const Vec3& direction = state.ray.direction;
  const Rgb emitted = environment.image ? environment.image->radiance(direction) : environment.radiance;
  if (detail::is_black(emitted)) return;
  // Only an image competes with its sampling, and only where the path has scattered.
  const bool sampled = environment.image && state.scattered;
  const Rgb found = sampled ? detail::found_weight(weight, state.pdf,
                                                   environment.image->pdf(direction) * state.light_choice)
                            : weight.free_path_weight();
  sink.add(detail::make_contribution(weight, weight.throughput * found * emitted, 0));
}

// One light seen from a vertex whose lobe or phase function has the density `density(direction)`, which is
// also its value; the balance heuristic against the path finding the light by itself, over all channels.
template <SceneGeometry G>
template <Sink S, class Density>
void PathTracer<G>::sample_direct(std::size_t light, const State& vertex, const Density& density,
                                  const Vec2& u, S& sink) noexcept {
  const auto sample = sample_light(scene_, light, vertex.vertex, u);
  if (!sample) return;
  const Real pdf = density(sample->direction);
  if (!(pdf > 0)) return;
  ++counters_.rays;
  const Rgb through = geometry_.transmittance({vertex.vertex, sample->direction}, sample->distance);
  if (detail::is_black(through)) return;
  const PathWeight& weight = vertex.weight;
  const Rgb passed = weight.ratio * through;
  Real total = average(weight.ratio) * sample->pdf * vertex.light_choice;
  if (!sample->delta) total += average(passed) * pdf;
  const Rgb radiance = weight.throughput * passed * (pdf / total) * sample->radiance;
  sink.add(detail::make_contribution(weight, radiance, light_group(scene_, light)));
}

}  // namespace meander
