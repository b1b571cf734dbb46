// What any correct renderer of these walks obeys, whatever the medium: reciprocity of camera and light,
// scale, rotation.
#include <doctest/doctest.h>

#include <cmath>

#include "render/small_scene.h"
#include "stats/hypothesis.h"
#include "stats/image_error.h"

using namespace meander;

namespace {

// The mean of an image and its standard error, one channel.
std::pair<double, double> mean_of_image(const Rendering& rendering, int channel) {
  double mean = 0;
  double variance = 0;
  for (const Pixel& pixel : rendering.film.pixels) {
    mean += pixel.mean[channel];
    variance += pixel.variance_of_mean()[channel];
  }
  const auto count = static_cast<double>(rendering.film.pixels.size());
  return {mean / count, std::sqrt(variance) / count};
}

Material surface_of(Boundary boundary, double ior, double roughness) {
  return {"m",
          TranslucentMaterial{
              {Rgb(1, 2, 4), Rgb(Real(0.95), Real(0.8), Real(0.99)), Real(0.4)}, boundary, ior, roughness}};
}

// A box seen by an orthographic camera along one direction and lit by a parallel beam along another.
Scene beam_scene(const Material& material, const DVec3& view, const DVec3& beam) {
  Scene scene;
  scene.camera = {-10.0 * view, {0, 0, 0}, {0, 1, 0}, 40, 2.4};
  scene.film = {16, 16};
  scene.materials.push_back(material);
  scene.objects.push_back({"body", BoxShape{}, 0, {{}, {20, 30, 40}, {0.6, 0.4, 0.5}}});
  scene.lights.push_back({"beam", DirectionalLight{beam, Rgb(1)}, false});
  return scene;
}

}  // namespace

TEST_CASE("camera and light may change places") {
  // Flux toward an orthographic camera per irradiance of a parallel beam: the same with both directions
  // reversed and exchanged (Helmholtz; Chandrasekhar 1960, section 13).
  const DVec3 a = glm::normalize(DVec3(0.3, -0.2, -1));
  const DVec3 b = glm::normalize(DVec3(-1, -0.5, 0.2));
  const Material materials[]{surface_of(Boundary::matched, 1, 0), surface_of(Boundary::diffuse, 1, 0),
                             surface_of(Boundary::diffuse, 1.5, 0),
                             surface_of(Boundary::dielectric, 1.4, 0.5)};
  for (const Material& material : materials) {
    Job there = make_job(beam_scene(material, a, b), 2);
    Job back = make_job(beam_scene(material, -b, -a), 2);
    back.seed = 1;
    const Rendering forth = render_spp(there, 1500);
    const Rendering returned = render_spp(back, 1500);
    for (int c = 0; c < 3; ++c) {
      const auto [mean, error] = mean_of_image(forth, c);
      const auto [other_mean, other_error] = mean_of_image(returned, c);
      CAPTURE(c);
      CHECK(mean > 10 * error);
      CHECK(std::abs(two_sample_z(mean, error, other_mean, other_error)) < 4);
    }
  }
}

TEST_CASE("multiplying every length leaves the image, and turning everything turns with it") {
  const auto scene_of = [](double scale, double turn) {
    Scene scene;
    const DMat3 map = scale * linear_part({{}, {0, turn, 0}, DVec3(1)});
    scene.camera = {map * DVec3(0, 1, 5), map * DVec3(0, 0, 0), {0, 1, 0}, 30, {}};
    scene.film = {20, 20};
    scene.environment.radiance = Rgb(Real(0.2));
    const Medium medium = medium_from_albedo({0.9, 0.8, 0.99}, DVec3(0.1, 0.2, 0.4) * scale, 0.6);
    scene.materials.push_back(translucent("m", medium, Boundary::matched));
    scene.materials.push_back({"ground", DiffuseMaterial{Rgb(Real(0.5))}});
    scene.objects.push_back({"knot",
                             std::make_shared<const Mesh>(make_torus_knot(160, 20)),
                             0,
                             {{}, {0, turn, 0}, DVec3(scale)}});
    scene.objects.push_back({"ground", SlabShape{}, 1, {{0, -1.2 * scale, 0}, {}, DVec3(0.2 * scale)}});
    scene.lights.push_back(
        {"key", RectangleLight{map * DVec3(2, 3, 1), map * DVec3(0, 0, 0), {0, 1, 0}, scale, scale, Rgb(9)},
         false});
    scene.lights.push_back(
        {"point", PointLight{map * DVec3(-2, 2, 0), Rgb(static_cast<Real>(5 * scale * scale))}, false});
    return scene;
  };
  const Image here = resolve(render_spp(make_job(scene_of(1, 0), 2), 300).film);
  const std::pair<double, double> others[]{{1e-3, 0}, {1e3, 0}, {1, 77}};
  for (const auto& [scale, turn] : others) {
    Job job = make_job(scene_of(scale, turn), 2);
    job.seed = 3;
    const Rendering r = render_spp(job, 300);
    CHECK(r.counters.leaked_walks == 0);
    CAPTURE(scale);
    CHECK(z_test(resolve(r.film), here).passed);
  }
}
