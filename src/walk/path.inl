// The template bodies of walk/path.h.
#pragma once

namespace meander {

template <SceneGeometry G>
template <Sink S>
bool PathTracer<G>::trace(const Ray& camera_ray, Random& random, S& sink, std::optional<int> hero) noexcept {
  Path path;
  PathStep step = begin(path, {camera_ray, geometry_.closest_hit(camera_ray), hero}, random, sink);
  while (step == PathStep::walk) {
    const WalkResult walked = walk(path, random, sink);
    step = resume(path, walked, random, sink);
  }
  return step == PathStep::done;
}

template <SceneGeometry G>
template <Sink S>
PathStep PathTracer<G>::begin(Path& path, const PathStart& start, Random& random, S& sink) noexcept {
  path.state = {};
  path.walks = 0;
  path.state.ray = start.ray;
  path.state.vertex = start.ray.origin;
  if (options_.chromatic)
    path.state.weight.hero = start.hero ? *start.hero : std::min(static_cast<int>(random.next() * 3), 2);
  ++counters_.rays;
  const Step step = meet(path, start.hit, random, sink);
  if (step != Step::go_on) return step == Step::walk ? PathStep::walk : PathStep::done;
  return proceed(path, random, sink);
}

template <SceneGeometry G>
template <Sink S>
PathStep PathTracer<G>::resume(Path& path, const WalkResult& walked, Random& random, S& sink) noexcept {
  counters_.steps += path.walker.steps - path.counted_steps;
  path.counted_steps = path.walker.steps;
  if (walked.end == WalkEnd::interrupted) return PathStep::interrupted;
  if (++path.walks % kStopInterval == 0 && stop()) return PathStep::interrupted;
  switch (Passage<S>{*this, path, random, sink}.end(walked)) {
    case Step::walk:
      return PathStep::walk;
    case Step::done:
      return PathStep::done;
    case Step::go_on:
      break;
  }
  return proceed(path, random, sink);
}

template <SceneGeometry G>
template <Sink S>
void PathTracer<G>::escape(const Ray& camera_ray, S& sink) const noexcept {
  State state;
  state.ray = camera_ray;
  state.vertex = camera_ray.origin;
  if (!collect_lights(state, std::numeric_limits<double>::infinity(), sink)) collect_environment(state, sink);
}

template <SceneGeometry G>
template <Sink S>
WalkResult PathTracer<G>::walk(Path& path, Random& random, S& sink) noexcept {
  return Passage<S>{*this, path, random, sink}.walk();
}

template <SceneGeometry G>
template <Sink S>
void PathTracer<G>::collided(Path& path, Real clearance, Random& random, S& sink) noexcept {
  Passage<S>{*this, path, random, sink}.light_collision(clearance);
}

template <SceneGeometry G>
template <Sink S>
PathStep PathTracer<G>::proceed(Path& path, Random& random, S& sink) noexcept {
  for (std::uint64_t vertices = 1;; ++vertices) {
    if (vertices % kStopInterval == 0 && stop()) return PathStep::interrupted;
    ++counters_.rays;
    const Step step = meet(path, geometry_.closest_hit(path.state.ray), random, sink);
    if (step != Step::go_on) return step == Step::walk ? PathStep::walk : PathStep::done;
  }
}

template <SceneGeometry G>
template <Sink S>
auto PathTracer<G>::meet(Path& path, const std::optional<SurfaceHit>& hit, Random& random, S& sink) noexcept
    -> Step {
  State& state = path.state;
  if (collect_lights(state, hit ? hit->distance : std::numeric_limits<double>::infinity(), sink))
    return Step::done;
  if (!hit) {
    collect_environment(state, sink);
    return Step::done;
  }
  const auto& kind = scene_.materials[scene_.objects[hit->object].material].kind;
  if (const auto* translucent = std::get_if<TranslucentMaterial>(&kind)) {
    path.hit = *hit;
    path.material = translucent;
    return Passage<S>{*this, path, random, sink}.begin();
  }
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
  const Ray origin = leave(hit.object, hit.point, lobe.normal, {});
  state.vertex = origin.origin;
  state.departure = origin.departure;
  state.light_choice = every_light();
  for (std::size_t light = 0; light < sampled_lights(); ++light) {
    const Real u1 = random.next();
    const Real u2 = random.next();
    sample_direct(light, state, detail::Weighing{[&](const Vec3& d) { return lobe.eval(d); }}, {u1, u2},
                  sink);
  }
  const Real u1 = random.next();
  const Real u2 = random.next();
  state.ray = {state.vertex, lobe.sample({u1, u2}), state.departure};
  state.pdf = lobe.eval(state.ray.direction);
  state.scattered = true;
  return Step::go_on;
}

// Adds the lights that the ray meets before `distance`; true when a light that the camera sees ends the path.
template <SceneGeometry G>
template <Sink S>
bool PathTracer<G>::collect_lights(const State& state, double distance, S& sink) const noexcept {
  if (scene_.lights.empty()) return false;
  // Seen from the last vertex, which lies straight behind the ray's origin, across matched bodies.
  const Ray from_vertex{state.vertex, state.ray.direction};
  const double behind = glm::dot(state.ray.origin - state.vertex, DVec3(state.ray.direction));
  std::size_t nearest = scene_.lights.size();
  LightHit seen{distance, Rgb(0), 0};
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Light& light = scene_.lights[i];
    if (!state.scattered && !light.visible) continue;
    const auto hit = hit_light(lights_.lights[i], from_vertex);
    if (!hit || hit->distance < behind || hit->distance - behind >= distance) continue;
    if (!state.scattered) {
      if (hit->distance - behind >= seen.distance) continue;
      seen = *hit;
      seen.distance -= behind;
      nearest = i;
      continue;
    }
    collect_light(state, i, *hit, sink);
  }
  if (nearest == scene_.lights.size()) return false;
  const Rgb radiance = state.weight.throughput * state.weight.free_path_weight() * seen.radiance;
  sink.add(detail::make_contribution(state.weight, radiance, 1 + static_cast<int>(nearest)));
  return true;
}

// A light that the path's own ray has found, weighed against the vertex having sampled it.
template <SceneGeometry G>
template <Sink S>
void PathTracer<G>::collect_light(const State& state, std::size_t light, const LightHit& hit,
                                  S& sink) const noexcept {
  const PathWeight& weight = state.weight;
  const Rgb found = detail::found_weight(weight, state.pdf, hit.pdf * state.light_choice);
  sink.add(detail::make_contribution(weight, weight.throughput * found * hit.radiance,
                                     1 + static_cast<int>(light)));
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

// One light seen from a vertex. weigh(direction, competing, delta) is f / (competing + f), f the density of
// the vertex's lobe or phase function, which is also its value: the balance heuristic against the path
// finding the light by itself, over all channels; for a light without extent it is f / competing.
// weigh.draw, where there is one, decides whether the shadow ray is worth tracing.
template <SceneGeometry G>
template <Sink S, class Weigh>
void PathTracer<G>::sample_direct(std::size_t light, const State& vertex, const Weigh& weigh, const Vec2& u,
                                  S& sink) noexcept {
  const auto sample = sample_light(lights_, light, vertex.vertex, u);
  if (!sample) return;
  // A cheap look first: where the lobe is black no shadow ray is needed.
  const PathWeight& weight = vertex.weight;
  if constexpr (requires { weigh.density(sample->direction); })
    if (!(weigh.density(sample->direction) > 0)) return;
  Real lifted = 1;
  if constexpr (requires { weigh.draw(*sample, vertex.light_choice); }) {
    lifted = weigh.draw(*sample, vertex.light_choice);
    if (lifted == 0) return;
  }
  ++counters_.rays;
  const Rgb through =
      geometry_.transmittance({vertex.vertex, sample->direction, vertex.departure}, sample->distance);
  if (detail::is_black(through)) return;
  const Rgb passed = weight.ratio * through;
  const Real mean = average(passed);
  const Real competing = sample->pdf * vertex.light_choice * average(weight.ratio) / mean;
  const Real part = weigh(sample->direction, competing, sample->delta);
  if (!(part > 0)) return;
  const Rgb radiance = weight.throughput * (passed / mean) * (lifted * part) * sample->radiance;
  sink.add(detail::make_contribution(weight, radiance, light_group(scene_, light)));
}

}  // namespace meander
