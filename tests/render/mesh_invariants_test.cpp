// The furnace, reciprocity, scale, rotation and the sum of lights on every closed mesh that the project has
// (their mean path: mean_path_test).
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "io/mesh_file.h"
#include "render/small_scene.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/image_error.h"

using namespace meander;

namespace {

std::vector<std::shared_ptr<const Mesh>> closed_meshes() {
  std::vector<std::shared_ptr<const Mesh>> meshes{std::make_shared<const Mesh>(make_torus_knot())};
  for (const auto& file : std::filesystem::directory_iterator(std::string(MEANDER_SOURCE_DIR) + "/scenes")) {
    if (file.path().extension() != ".ply") continue;
    const MeshFile loaded = load_mesh(file.path().string(), false);
    REQUIRE(loaded.report.open_edges == 0);
    meshes.push_back(std::make_shared<const Mesh>(loaded.mesh));
  }
  REQUIRE(meshes.size() > 1);
  return meshes;
}

// The mesh, made to fit the camera, which looks along `view`.
Scene scene_of(const std::shared_ptr<const Mesh>& mesh, const TranslucentMaterial& material,
               const DVec3& view) {
  DVec3 low(1e300);
  DVec3 high(-1e300);
  for (const DVec3& p : mesh->positions) low = glm::min(low, p), high = glm::max(high, p);
  const double scale = 2 / glm::length(high - low);
  Scene scene;
  scene.camera = {-10.0 * view, {0, 0, 0}, {0, 1, 0}, 40, 2.2};
  scene.film = {16, 16};
  scene.materials.push_back({"m", material});
  scene.objects.push_back({"body", mesh, 0, {-0.5 * scale * (low + high), {}, DVec3(scale)}});
  return scene;
}

// The sum of one channel over the film, and its variance.
std::pair<double, double> flux_of(const Rendering& rendering, int channel) {
  double sum = 0;
  double variance = 0;
  for (const Pixel& pixel : rendering.film.pixels) {
    sum += pixel.mean[channel];
    variance += pixel.variance_of_mean()[channel];
  }
  return {sum, variance};
}

// The mesh in chromatic, anisotropic matter under two lights, every length times `scale`, all turned about y.
Scene lit_scene(const std::shared_ptr<const Mesh>& mesh, double scale, double turn) {
  const Medium medium = medium_from_albedo({0.9, 0.8, 0.99}, DVec3(0.05, 0.1, 0.2) * scale, 0.6);
  Scene scene = scene_of(mesh, {medium, Boundary::matched, 1, 0}, {0, 0, -1});
  const DMat3 map = scale * linear_part({{}, {0, turn, 0}, DVec3(1)});
  scene.camera.look_from = map * scene.camera.look_from;
  scene.camera.orthographic_height = scale * *scene.camera.orthographic_height;
  Transform& transform = scene.objects[0].transform;
  transform = {map * transform.translate, {0, turn, 0}, scale * transform.scale};
  scene.lights.push_back(
      {"key", RectangleLight{map * DVec3(2, 3, 1), map * DVec3(0), {0, 1, 0}, scale, scale, Rgb(9)}, false});
  scene.lights.push_back(
      {"point", PointLight{map * DVec3(-2, 2, 0), Rgb(static_cast<Real>(5 * scale * scale))}, false});
  return scene;
}

Image render_lit(Scene scene, std::uint64_t seed) {
  Job job = make_job(std::move(scene), 2);
  job.seed = seed;
  const Rendering rendering = render_spp(job, 300);
  CHECK(rendering.counters.leaked_walks == 0);
  return resolve(rendering.film);
}

}  // namespace

TEST_CASE("scale and rotation leave the image of every closed mesh, and its lights add up") {
  for (const auto& mesh : closed_meshes()) {
    CAPTURE(mesh->triangles.size());
    const Image here = render_lit(lit_scene(mesh, 1, 0), 0);
    CHECK(z_test(render_lit(lit_scene(mesh, 1e-3, 0), 1), here).passed);
    CHECK(z_test(render_lit(lit_scene(mesh, 1e3, 0), 2), here).passed);
    CHECK(z_test(render_lit(lit_scene(mesh, 1, 77), 3), here).passed);
    Image sum;
    for (const int light : {0, 1}) {
      Scene alone = lit_scene(mesh, 1, 0);
      alone.lights = {alone.lights[static_cast<std::size_t>(light)]};
      const Image image = render_lit(std::move(alone), 4 + static_cast<std::uint64_t>(light));
      if (sum.values.empty()) {
        sum = image;
        continue;
      }
      CHECK_FALSE(z_test(image, here).passed);  // one light alone is not the whole
      for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += image.values[i];
    }
    CHECK(z_test(sum, here).passed);
  }
}

TEST_CASE("every closed mesh vanishes in a furnace, behind every boundary") {
  const TranslucentMaterial surfaces[]{{{}, Boundary::matched, 1, 0},
                                       {{}, Boundary::diffuse, 1, 0},
                                       {{}, Boundary::diffuse, 1.5, 0},
                                       {{}, Boundary::dielectric, 1.5, 0},
                                       {{}, Boundary::dielectric, 1.5, 0.4}};
  for (const auto& mesh : closed_meshes()) {
    for (TranslucentMaterial material : surfaces) {
      CAPTURE(static_cast<int>(material.boundary));
      CAPTURE(material.ior);
      material.medium = {Rgb(5), Rgb(1), Real(0.5)};
      Scene scene = scene_of(mesh, material, {0, 0, -1});
      scene.environment.radiance = Rgb(1);
      const Rendering r = render_spp(make_job(std::move(scene), 2), 8);
      CHECK(r.counters.walks > 300);
      CHECK(r.counters.leaked_walks == 0);
      double worst = 0;
      for (const Pixel& pixel : r.film.pixels) worst = std::max(worst, std::abs(pixel.mean[1] - 1));
      CHECK(worst < 1e-5);
    }
  }
}

// Matched bodies alone: the shading normals of a mesh bend what other boundaries do, one way and not the
// other (Veach 1997, section 5.3).
TEST_CASE("camera and light may change places about every closed mesh") {
  const DVec3 a = glm::normalize(DVec3(0.3, -0.2, -1));
  const DVec3 b = glm::normalize(DVec3(-1, -0.5, 0.2));
  const TranslucentMaterial material{
      {Rgb(2, 4, 8), Rgb(Real(0.95), Real(0.8), Real(0.99)), Real(0.4)}, Boundary::matched, 1, 0};
  std::vector<double> scores;
  for (const auto& mesh : closed_meshes()) {
    const auto seen = [&](const DVec3& view, const DVec3& beam, std::uint64_t seed) {
      Scene scene = scene_of(mesh, material, view);
      scene.lights.push_back({"beam", DirectionalLight{beam, Rgb(1)}, false});
      Job job = make_job(std::move(scene), 2);
      job.seed = seed;
      return render_spp(job, 400);
    };
    const Rendering forth = seen(a, b, 0);
    const Rendering back = seen(-b, -a, 1);
    for (int c = 0; c < 3; ++c) {
      const auto [sum, variance] = flux_of(forth, c);
      const auto [other, other_variance] = flux_of(back, c);
      CHECK(sum > 30 * std::sqrt(variance));
      scores.push_back((sum - other) / std::sqrt(variance + other_variance));
    }
  }
  const double threshold = two_sided_threshold(sidak_level(1e-3, scores.size()));
  for (const double z : scores) CHECK(std::abs(z) < threshold);
}
