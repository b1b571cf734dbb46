// Spheres in a white surround against exact pixel averages, computed without random walks
// (tests/reference/f5_*).
#include <doctest/doctest.h>

#include <cmath>

#include "render/small_scene.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "support/csv.h"

using namespace meander;

namespace {

Scene white_surround(double tau_radius, double albedo, double g, double eta) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40, 2.5};
  scene.film = {16, 16};
  scene.environment.radiance = Rgb(1);
  TranslucentMaterial material;
  material.medium = {Rgb(static_cast<Real>(tau_radius)), Rgb(static_cast<Real>(albedo)),
                     static_cast<Real>(g)};
  if (eta != 1) {
    material.boundary = Boundary::dielectric;
    material.ior = eta;
  }
  scene.materials.push_back({"m", material});
  scene.objects.push_back({"ball", SphereShape{}, 0, {}});
  return scene;
}

}  // namespace

TEST_CASE("spheres show their exact pixel averages: isotropic, anisotropic, and with a Fresnel surface") {
  const CsvTable index = reference_table("f5_images_index.csv");
  std::vector<double> scores;
  std::vector<double> image_scores;
  for (std::size_t row = 0; row < index.rows.size(); ++row) {
    if (index.number(row, "N") != 16) continue;
    const CsvTable exact = reference_table(index.text(row, "file"), false);
    const Job job = make_job(white_surround(index.number(row, "optical_radius"), index.number(row, "alpha"),
                                            index.number(row, "g"), index.number(row, "eta")),
                             2);
    const Rendering rendering = render_spp(job, 1500);
    CHECK(rendering.counters.leaked_walks == 0);
    double difference = 0;
    double variance = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const Pixel& pixel = rendering.film.at(x, y);
        const double reference = exact.number(static_cast<std::size_t>(y), static_cast<std::size_t>(x));
        const double error = std::sqrt(pixel.variance_of_mean()[0]);
        difference += pixel.mean[0] - reference;
        variance += error * error;
        if (reference > 0.99999) {
          CHECK(pixel.mean[0] == doctest::Approx(1).epsilon(1e-5));
        } else {
          scores.push_back(z_score(pixel.mean[0], reference, error));
        }
      }
    image_scores.push_back(difference / std::sqrt(variance));
  }
  REQUIRE(image_scores.size() == 4);
  const double pixel_threshold = two_sided_threshold(sidak_level(1e-3, scores.size()));
  double squares = 0;
  for (const double z : scores) {
    CHECK(std::abs(z) < pixel_threshold);
    squares += z * z;
  }
  const auto count = static_cast<double>(scores.size());
  CHECK(std::abs(squares / count - 1) < 4 * std::sqrt(2 / count));
  for (const double z : image_scores) CHECK(std::abs(z) < 3.5);
}

TEST_CASE("a white body in a white surround vanishes behind any index of refraction") {
  const std::pair<Boundary, double> surfaces[]{{Boundary::diffuse, 0},
                                               {Boundary::dielectric, 0},
                                               {Boundary::dielectric, 0.1},
                                               {Boundary::dielectric, 0.8}};
  for (const auto& [boundary, roughness] : surfaces) {
    Scene scene = mixed_scene();
    scene.lights.clear();
    scene.environment.radiance = Rgb(1);
    TranslucentMaterial white{{Rgb(4), Rgb(1), Real(0.5)}, boundary, 1.5, roughness};
    scene.materials[0] = {"a", white};
    white.ior = 1.33;
    scene.materials[1] = {"b", white};
    scene.materials[2] = {"ground", DiffuseMaterial{Rgb(1)}};
    const Rendering r = render_spp(make_job(std::move(scene), 2), 16);
    for (const Pixel& pixel : r.film.pixels) CHECK(pixel.mean[1] == doctest::Approx(1).epsilon(1e-5));
    CHECK(r.counters.leaked_walks == 0);
  }
}
