// Small scenes and jobs for render tests.
#pragma once

#include "render/progressive.h"

namespace meander {

inline Material translucent(const std::string& name, const Medium& medium, Boundary boundary) {
  return {name, TranslucentMaterial{medium, boundary}};
}

inline Job make_job(Scene scene, int threads) {
  Job job;
  job.threads = threads;
  job.scene = std::make_shared<const Scene>(std::move(scene));
  job.geometry = std::make_shared<const Geometry>(*job.scene, threads);
  return job;
}

inline Rendering render_spp(const Job& job, std::uint64_t spp) {
  const std::atomic<bool> stop{false};
  return render(job, {spp, {}, {}}, stop, [](const Rendering&) {});
}

/// A chromatic matched knot and a diffuse sphere on a ground, under a rectangle and a point light.
inline Scene mixed_scene() {
  Scene scene;
  scene.camera = {{0, 1.5, 6}, {0, 0, 0}, {0, 1, 0}, 40, {}};
  scene.film = {40, 24};
  scene.environment.radiance = Rgb(Real(0.2));
  scene.lights.push_back({"key", RectangleLight{{2, 4, 2}, {0, 0, 0}, {0, 1, 0}, 1, 1, Rgb(20)}, false});
  scene.lights.push_back({"point", PointLight{{-2, 2, 1}, Rgb(4)}, false});
  scene.materials.push_back(translucent(
      "jade", {Rgb(3, 6, 12), Rgb(Real(0.9), Real(0.95), Real(0.8)), Real(0.4)}, Boundary::matched));
  scene.materials.push_back(
      translucent("wax", {Rgb(10), Rgb(Real(0.98), Real(0.9), Real(0.7)), 0}, Boundary::diffuse));
  scene.materials.push_back({"ground", DiffuseMaterial{Rgb(Real(0.4))}});
  scene.objects.push_back(
      {"knot", std::make_shared<const Mesh>(make_torus_knot(120, 16)), 0, {{-1, 0, 0}, {}, DVec3(1)}});
  scene.objects.push_back({"ball", SphereShape{}, 1, {{1.2, -0.2, 0}, {}, DVec3(0.8)}});
  scene.objects.push_back({"ground", SlabShape{}, 2, {{0, -2, 0}, {}, DVec3(1)}});
  return scene;
}

}  // namespace meander
