// A path's passage through one translucent body: in through its boundary, the walk, and out again, or back in
// as often as the boundary says. Included by walk/path.h.
#pragma once

namespace meander {

namespace detail {

/// What a path hands over for radiance found by its own ray, without competition from light sampling.
[[nodiscard]] inline Contribution make_contribution(const PathWeight& weight, const Rgb& unweighted,
                                                    int group) noexcept {
  return {group, weight.order, unweighted, weight.albedo, static_cast<Real>(weight.length)};
}

/// The weight of light that a ray has found, without throughput: the balance heuristic, over both ways and
/// all channels, between a ray whose direction had the density `pdf` and sampling the light with `sampled`.
[[nodiscard]] inline Rgb found_weight(const PathWeight& weight, Real pdf, Real sampled) noexcept {
  const Rgb passed = weight.ratio * weight.since;
  return passed * (pdf / (average(passed) * pdf + average(weight.ratio) * sampled));
}

/// What sample_direct asks of a lobe whose density is known in closed form.
template <class Density>
struct Weighing {
  Density density;
  [[nodiscard]] Real operator()(const Vec3& direction, Real competing, bool delta) const noexcept {
    const Real value = density(direction);
    return value / (delta ? competing : competing + value);
  }
};

/// The same at a collision, where the shadow ray is not always traced.
template <class Density>
struct CollisionWeighing {
  Density density;
  ShadowRoulette& roulette;
  Real carried;  // see most_carried
  [[nodiscard]] Real operator()(const Vec3& direction, Real competing, bool delta) const noexcept {
    return Weighing<const Density&>{density}(direction, competing, delta);
  }
  /// What the ray counts, its worth taken against that of isotropic scattering without competition.
  [[nodiscard]] Real draw(const LightSample& sample, Real light_choice) const noexcept {
    const Real sampled = sample.pdf * light_choice;
    return roulette.draw(carried * 4 * kPi * sampled * (*this)(sample.direction, sampled, sample.delta));
  }
};

[[nodiscard]] inline bool is_black(const Rgb& c) noexcept { return c.x == 0 && c.y == 0 && c.z == 0; }

}  // namespace detail

template <SceneGeometry G>
template <Sink S>
struct PathTracer<G>::Passage {
  PathTracer& tracer;
  Path& path;
  Random& random;
  S& sink;
  State& state = path.state;
  Walker& walker = path.walker;
  const SurfaceHit& hit = path.hit;
  const TranslucentMaterial& material = *path.material;
  bool holds_light = tracer.geometry_.holds_light(path.hit.object);  // asked once a walk, not once a step

  /// Takes the path from the hit into the body, or off it.
  [[nodiscard]] Step begin() noexcept {
    walker = {};
    path.counted_steps = 0;
    path.set_out_normal = Vec3(0);
    walker.weight = state.weight;
    walker.direction = state.ray.direction;
    if (!enter()) return Step::go_on;
    if (material.boundary == Boundary::matched) path.shadows = ShadowRoulette(random.next());
    ++tracer.counters_.walks;
    return Step::walk;
  }

  /// What the end of a walk means for the path.
  [[nodiscard]] Step end(const WalkResult& walked) noexcept {
    if (walked.end == WalkEnd::absorbed) return Step::done;
    if (walked.end == WalkEnd::leaked) return leak();
    if (stays_on_spot(walked.crossing)) return Step::walk;
    return leave(walked.crossing);
  }

  [[nodiscard]] WalkResult walk() noexcept {
    const WalkModel model{material.medium, tracer.options_.estimator};
    const std::uint64_t before = walker.steps;
    const WalkResult result = tracer.geometry_.with_body(
        hit.object, [&](const auto& world) { return random_walk(world, model, walker, random, *this); });
    if (tracer.geometry_.traces_rays(hit.object)) tracer.counters_.rays += walker.steps - before;
    return result;
  }

  // What the walk reports as it goes.
  void segment(const Walker&, Real distance) noexcept {
    if (holds_light) collect_inside(distance);
  }
  void absorbed(const Rgb&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return tracer.stop(); }

  void scattered(const Walker&) noexcept {
    const bool known = tracer.options_.knows_clearance;
    light_collision(known ? Real(tracer.geometry_.clearance(hit.object, walker.position)) : 0);
  }

  /// In a matched body one light is sampled at every collision, and its shadow ray traced where that is worth
  /// it. The surface is at least `clearance` away.
  void light_collision(Real clearance) noexcept {
    const std::size_t count = tracer.sampled_lights();
    if (material.boundary != Boundary::matched || count == 0) return;
    const std::size_t light =
        std::min(static_cast<std::size_t>(random.next() * static_cast<Real>(count)), count - 1);
    const Vec2 u = next_pair();
    State vertex;
    vertex.weight = walker.weight;
    vertex.vertex = tracer.geometry_.center(hit.object) + DVec3(walker.position);
    vertex.light_choice = tracer.one_light();
    const auto phase = [&](const Vec3& d) {
      return eval_henyey_greenstein(material.medium.g, walker.direction, d);
    };
    const Real carried = most_carried(walker.weight, material.medium.sigma_t, clearance);
    tracer.sample_direct(light, vertex, detail::CollisionWeighing{phase, path.shadows, carried}, u, sink);
  }

 private:
  [[nodiscard]] Vec2 next_pair() noexcept {
    const Real u1 = random.next();
    const Real u2 = random.next();
    return {u1, u2};
  }
  [[nodiscard]] Real ior() const noexcept { return static_cast<Real>(material.ior); }

  // Starts the walk at a point of the surface. Only where it sets out so flat that rounding might carry it
  // past a mesh is it moved in: elsewhere that would be a depth that the medium does not have.
  void place_inside(const Vec3& point, const Vec3& normal) noexcept {
    constexpr Real kFlat = Real(0x1p-7);
    const bool flat = glm::dot(walker.direction, normal) > -kFlat;
    const bool exact = !tracer.geometry_.traces_rays(hit.object);
    walker.position = exact || !flat ? point : point - tracer.geometry_.offset(hit.object, point) * normal;
    path.set_out = point;
    path.set_out_normal = normal;
  }

  // Whether a crossing is none of this walk's, which is moved in then. Two walls of a mesh may lie at one
  // place, back to back: a walk that sets out from one of them finds the other at once, which is its
  // neighbour's. And whatever else would keep a path at one place for good ends after some crossings: it is
  // moved beyond what is looked for behind it.
  [[nodiscard]] bool stays_on_spot(const Crossing& crossing) noexcept {
    constexpr int kMostStays = 16;
    constexpr Real kSpot = 64;  // how wide a spot is; the rims of sheets that lie in a stack are many
    if (!tracer.geometry_.traces_rays(hit.object)) return false;
    const Real here = tracer.geometry_.offset(hit.object, crossing.point);
    if (crossing.distance > here) {
      path.stays = 0;
      return false;
    }
    if (path.stays == 0 || glm::distance(crossing.point, path.spot) > kSpot * here) {
      path.stays = 0;
      path.spot = crossing.point;
    }
    const bool stuck = ++path.stays >= kMostStays;
    if (!stuck && !meets_neighbour(crossing, here)) return false;
    walker.position =
        stuck ? crossing.point + tracer.geometry_.depth_beyond_looks(hit.object) * walker.direction
              : path.set_out - here * path.set_out_normal;
    path.set_out_normal = Vec3(0);
    if (stuck) path.stays = 0;
    return true;
  }

  // Back to back with the wall that the walk set out from; at the edge of a wedge it is on the other side of
  // both, a little farther in, that tells.
  [[nodiscard]] bool meets_neighbour(const Crossing& crossing, Real here) const noexcept {
    return glm::dot(crossing.normal, path.set_out_normal) < Real(-0.5) &&
           glm::length(crossing.point - path.set_out) <= 2 * here &&
           tracer.geometry_.holds(hit.object, path.set_out - here * path.set_out_normal, walker.direction);
  }

  // Lights that the segment ahead passes inside the body. Those do not end a path, not even before the
  // camera.
  void collect_inside(Real distance) noexcept {
    State found = state;
    found.ray = {tracer.geometry_.center(hit.object) + DVec3(walker.position), walker.direction};
    if (walker.weight.order != state.weight.order) {
      found.vertex = found.ray.origin;
      found.pdf = pdf_last_direction(walker, material.medium.g);
      found.light_choice = tracer.one_light();
      found.scattered = true;
    }
    const Ray from_vertex{found.vertex, walker.direction};
    const double behind = glm::dot(found.ray.origin - found.vertex, DVec3(walker.direction));
    for (std::size_t i = 0; i < tracer.scene_.lights.size(); ++i) {
      if (!found.scattered && !tracer.scene_.lights[i].visible) continue;
      const auto seen = hit_light(tracer.lights_.lights[i], from_vertex);
      if (!seen || seen->distance < behind || seen->distance - behind >= double{distance}) continue;
      found.weight = walker.weight;
      found.weight.pass(material.medium, static_cast<Real>(seen->distance - behind));
      if (!found.scattered) found.light_choice = 0;
      if (!found.scattered) found.pdf = 1;
      tracer.collect_light(found, i, *seen, sink);
    }
  }

  // False when the boundary mirrors the path off. A path may begin inside: at the camera, or where it has
  // left its body and finds itself inside still, as between two surfaces at one place. Then it goes on from
  // where the ray was traced from: from the surface itself it would leave again at once, and never end.
  [[nodiscard]] bool enter() noexcept {
    if (!hit.entering) {
      walker.position = Vec3(state.ray.origin - tracer.geometry_.center(hit.object));
      if (state.ray.departure.object == hit.object) walker.position += state.ray.departure.offset;
      return true;
    }
    if (is_rough()) {
      if (meet_rough(hit.point, hit.normal, hit.shading_normal)) return false;
    } else if (material.boundary != Boundary::matched && material.ior != 1) {
      const InterfaceRay ray = meet_interface(walker.direction, hit.normal, hit.shading_normal, ior());
      if (random.next() < ray.reflectance) {
        send_specular(state, tracer.leave(hit.object, hit.point, hit.normal, ray.reflected));
        return false;
      }
      walker.direction = ray.refracted;
    }
    if (material.boundary == Boundary::diffuse) send_inward(hit.normal, hit.shading_normal);
    place_inside(hit.point, hit.normal);
    return true;
  }

  // A fresh cosine-distributed direction inside.
  void send_inward(const Vec3& normal, const Vec3& shading_normal) noexcept {
    walker.direction = make_lobe(-normal, -shading_normal).sample(next_pair());
    walker.weight.vertex();
  }

  // Lost through a hole: what is beyond counts as the environment.
  [[nodiscard]] Step leak() noexcept {
    ++tracer.counters_.leaked_walks;
    state.ray.direction = walker.direction;
    if (material.boundary != Boundary::matched) {
      send_specular(state, state.ray);
    } else if (walker.weight.order != state.weight.order) {
      state.pdf = pdf_last_direction(walker, material.medium.g);
      state.light_choice = tracer.one_light();
      state.scattered = true;
    }
    state.weight = walker.weight;
    tracer.collect_environment(state, sink);
    return Step::done;
  }

  // What the boundary does with a walk that reaches it from inside.
  [[nodiscard]] Step leave(const Crossing& crossing) noexcept {
    if (material.boundary == Boundary::matched) return leave_matched(crossing);
    if (is_rough()) return leave_rough(crossing);
    if (material.boundary == Boundary::dielectric) return leave_dielectric(crossing);
    if (material.ior != 1) return leave_refracted(crossing);
    state.weight = walker.weight;
    SurfaceHit exit = hit;
    exit.point = crossing.point;
    return tracer.reflect(exit, make_lobe(crossing.normal, crossing.shading_normal), state, random, sink);
  }

  [[nodiscard]] Step leave_matched(const Crossing& crossing) noexcept {
    if (walker.weight.order != state.weight.order) {
      state.vertex = tracer.geometry_.center(hit.object) + DVec3(crossing.point) -
                     double{crossing.distance} * DVec3(walker.direction);
      state.pdf = pdf_last_direction(walker, material.medium.g);
      state.light_choice = tracer.one_light();
      state.scattered = true;
    }
    state.weight = walker.weight;
    state.ray = tracer.leave(hit.object, crossing.point, crossing.normal, walker.direction);
    return Step::go_on;
  }

  [[nodiscard]] Step leave_dielectric(const Crossing& crossing) noexcept {
    const InterfaceRay ray =
        meet_interface(walker.direction, -crossing.normal, -crossing.shading_normal, 1 / ior());
    if (random.next() < ray.reflectance) {
      walker.direction = lift_off(ray.reflected, -crossing.normal);
      place_inside(crossing.point, crossing.normal);
      return Step::walk;
    }
    state.weight = walker.weight;
    send_specular(state, tracer.leave(hit.object, crossing.point, crossing.normal, ray.refracted));
    return Step::go_on;
  }

  [[nodiscard]] bool is_rough() const noexcept {
    return material.boundary == Boundary::dielectric && material.roughness > 0;
  }

  // Meets the rough interface from either side, samples the lights outside, and sends the path on: true when
  // it leaves the surface to the outside, with the state set; otherwise the walker's direction is.
  [[nodiscard]] bool meet_rough(const Vec3& point, const Vec3& normal, const Vec3& shading_normal) noexcept {
    const RoughDielectric surface{ggx_alpha(static_cast<Real>(material.roughness)), ior()};
    const RoughInterface interface(normal, shading_normal, surface, walker.direction);
    walker.weight.vertex();
    State vertex;
    vertex.weight = walker.weight;
    vertex.ray = tracer.leave(hit.object, point, normal, {});
    vertex.vertex = vertex.ray.origin;
    vertex.departure = vertex.ray.departure;
    vertex.light_choice = tracer.every_light();
    vertex.scattered = true;
    const auto weigh = [&](const Vec3& d, Real competing, bool delta) {
      return interface.weigh(d, competing, delta, random);
    };
    for (std::size_t light = 0; light < tracer.sampled_lights(); ++light)
      tracer.sample_direct(light, vertex, weigh, next_pair(), sink);
    const RoughInterface::Sample sample = interface.sample(random);
    if (!sample.outside) {
      walker.direction = sample.direction;
      return false;
    }
    vertex.ray.direction = sample.direction;
    vertex.pdf = sample.density;
    if (std::isinf(sample.density)) send_specular(vertex, vertex.ray);
    state = vertex;
    return true;
  }

  [[nodiscard]] Step leave_rough(const Crossing& crossing) noexcept {
    if (meet_rough(crossing.point, crossing.normal, crossing.shading_normal)) return Step::go_on;
    place_inside(crossing.point, crossing.normal);
    return Step::walk;
  }

  // A Lambertian under a smooth interface: part of it is refracted out, where lights are sampled, the rest
  // goes back.
  [[nodiscard]] Step leave_refracted(const Crossing& crossing) noexcept {
    walker.weight.vertex();
    if (!walker.weight.survives_roulette(random, kRouletteThreshold)) return Step::done;
    const RefractedLobe lobe(make_lobe(crossing.normal, crossing.shading_normal), ior());
    State vertex;
    vertex.weight = walker.weight;
    const Ray origin = tracer.leave(hit.object, crossing.point, crossing.normal, {});
    vertex.vertex = origin.origin;
    vertex.departure = origin.departure;
    vertex.light_choice = tracer.every_light();
    for (std::size_t light = 0; light < tracer.sampled_lights(); ++light)
      tracer.sample_direct(light, vertex, detail::Weighing{[&](const Vec3& d) { return lobe.eval(d); }},
                           next_pair(), sink);
    const Vec2 u = next_pair();
    const auto direction = lobe.sample(u, random.next());
    if (!direction) {
      send_inward(crossing.normal, crossing.shading_normal);
      place_inside(crossing.point, crossing.normal);
      return Step::walk;
    }
    vertex.ray = {vertex.vertex, *direction, vertex.departure};
    vertex.pdf = lobe.eval(*direction);
    vertex.scattered = true;
    state = vertex;
    return Step::go_on;
  }
};

}  // namespace meander
