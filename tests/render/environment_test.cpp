// Environment images as lights: against the constant surround, against an irradiance by quadrature, and
// against the same emission on an object that rays alone can find.
#include <doctest/doctest.h>

#include "render/small_scene.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/image_error.h"
#include "support/quadrature.h"

using namespace meander;

namespace {

constexpr int kWidth = 16;
constexpr int kHeight = 8;
constexpr int kPatchColumn = 9;
constexpr int kPatchRow = 2;
const Rgb kPatchRadiance(20, 16, 10);
const Rgb kSky(Real(0.2));

Image constant_picture(const Rgb& radiance) {
  Image image(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(radiance[c]);
  return image;
}

Image picture_with_patch() {
  Image image = constant_picture(kSky);
  for (int c = 0; c < 3; ++c) image.at(kPatchColumn, kPatchRow)[c] = static_cast<float>(kPatchRadiance[c]);
  return image;
}

void set_image(Scene& scene, const Image& image, double rotation) {
  scene.environment.image = std::make_shared<const EnvironmentImage>(image, rotation);
}

// The texel's part of the unit sphere, finely cut.
Mesh make_patch(int pieces) {
  Mesh mesh;
  for (int j = 0; j <= pieces; ++j)
    for (int i = 0; i <= pieces; ++i) {
      const double phi = ((kPatchColumn + double(i) / pieces) / kWidth - 0.5) * 2 * glm::pi<double>();
      const double theta = (kPatchRow + double(j) / pieces) / kHeight * glm::pi<double>();
      const double sine = std::sin(theta);
      mesh.positions.emplace_back(sine * std::sin(phi), std::cos(theta), -sine * std::cos(phi));
    }
  const auto stride = static_cast<std::uint32_t>(pieces + 1);
  for (std::uint32_t j = 0; j + 1 < stride; ++j)
    for (std::uint32_t i = 0; i + 1 < stride; ++i) {
      const std::uint32_t a = j * stride + i;
      mesh.triangles.push_back({a, a + 1, a + stride});
      mesh.triangles.push_back({a + 1, a + stride + 1, a + stride});
    }
  return mesh;
}

// A body on a ground, with a lamp beside it.
Scene body_on_ground(const Material& body) {
  Scene scene;
  scene.camera = {{0, 1, 5}, {0, -0.1, 0}, {0, 1, 0}, 35, {}};
  scene.film = {24, 24};
  scene.materials.push_back(body);
  scene.materials.push_back({"ground", DiffuseMaterial{Rgb(Real(0.5), Real(0.4), Real(0.3))}});
  scene.objects.push_back({"body", SphereShape{}, 0, {{0, 0, 0}, {}, {0.9, 0.7, 0.8}}});
  scene.objects.push_back({"ground", SlabShape{}, 1, {{0, -1.8, 0}, {}, DVec3(1)}});
  scene.lights.push_back({"ball", SphereLight{{1.2, 1.6, -0.6}, 0.5, Rgb(2)}, false});
  return scene;
}

const Material kMilk = translucent("milk", {Rgb(2), Rgb(Real(0.95)), Real(0.5)}, Boundary::matched);
const Material kJade = translucent("jade", {Rgb(1, 3, 8), Rgb(Real(0.95), Real(0.8), Real(0.99)), Real(-0.3)},
                                   Boundary::matched);
const Material kWax = translucent("wax", {Rgb(4), Rgb(Real(0.95)), 0}, Boundary::diffuse);
const Material kClay = {"clay", DiffuseMaterial{Rgb(Real(0.7))}};

void check_same(const Scene& a, const Scene& b, std::uint64_t spp) {
  Job second = make_job(b, 2);
  second.seed = 1;
  const Rendering first = render_spp(make_job(a, 2), spp);
  CHECK(first.non_finite == 0);
  const ZTest z = z_test(resolve(first.film), resolve(render_spp(second, spp).film));
  INFO("worst pixel ", z.worst_pixel_z, ", worst block ", z.worst_block_z, " of ", z.block_threshold,
       ", image ", z.image_z[0], " ", z.image_z[1], " ", z.image_z[2], " of ", z.image_threshold);
  CHECK(z.passed);
}

// The image samples its patch; the object is found by rays alone.
void check_patch(const Material& body) {
  const double rotation = 25;
  Scene by_image = body_on_ground(body);
  set_image(by_image, picture_with_patch(), rotation);
  Scene by_rays = body_on_ground(body);
  by_rays.environment.radiance = kSky;
  by_rays.materials.push_back({"patch", EmissiveMaterial{kPatchRadiance}});
  by_rays.objects.push_back(
      {"patch", std::make_shared<const Mesh>(make_patch(48)), 2, {{0, 0, 0}, {0, rotation, 0}, DVec3(1e4)}});
  check_same(by_image, by_rays, 600);
}

// Radiance that arrives on a plane, times the cosine. Panels are 2.25 degrees wide and 1.125 high: the
// rotation must be a multiple of that, lest a panel span two texels.
Rgb irradiance(const EnvironmentImage& environment, const DVec3& normal) {
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    const auto per_angle = [&](double phi, double theta) {
      const DVec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const double cosine = std::max(glm::dot(d, normal), 0.0);
      return environment.radiance(Vec3(d))[c] * cosine * std::sin(theta);
    };
    const double pi = glm::pi<double>();
    result[c] = static_cast<Real>(integrate_rectangle(per_angle, {0.0, 0.0}, {2 * pi, pi}, 160));
  }
  return result;
}

}  // namespace

TEST_CASE("a picture of one colour lights as the constant surround of that colour") {
  const Rgb radiance(Real(0.9), Real(0.7), Real(0.5));
  for (const Material& body : {kMilk, kJade, kWax, kClay}) {
    CAPTURE(body.name);
    Scene constant = body_on_ground(body);
    constant.environment = {radiance, nullptr, body.name != "jade"};
    Scene image = constant;
    set_image(image, constant_picture(radiance), 0);
    check_same(image, constant, 300);
  }
}

TEST_CASE("a bright patch of the surround looks the same sampled or found: opaque") { check_patch(kClay); }
TEST_CASE("a bright patch of the surround looks the same sampled or found: diffuse") { check_patch(kWax); }
TEST_CASE("a bright patch of the surround looks the same sampled or found: matched, grey") {
  check_patch(kMilk);
}
TEST_CASE("a bright patch of the surround looks the same sampled or found: matched, chromatic") {
  check_patch(kJade);
}

TEST_CASE("an opaque plane under a picture sends back its irradiance over pi") {
  Scene scene;
  scene.film = {8, 8};
  scene.materials.push_back({"paper", DiffuseMaterial{Rgb(1, Real(0.5), Real(0.25))}});
  scene.objects.push_back({"plane", SlabShape{}, 0, {{0, 0, 0}, {20, 0, 35}, DVec3(1)}});
  const DVec3 normal = linear_part(scene.objects[0].transform) * DVec3(0, 1, 0);
  scene.camera = {5.0 * normal, {0, 0, 0}, {0, 0, -1}, 30, {}};
  Image picture = constant_picture(Rgb(Real(0.1), Real(0.4), Real(0.2)));
  Random random = stream(3, 0, 0);
  for (float& value : picture.values) value *= static_cast<float>(random.next());
  for (int c = 0; c < 3; ++c) picture.at(5, 1)[c] = 40;
  set_image(scene, picture, -36);
  const Rgb expected = irradiance(*scene.environment.image, normal) / kPi *
                       std::get<DiffuseMaterial>(scene.materials[0].kind).color;
  const Rendering r = render_spp(make_job(scene, 2), 16000);
  const double threshold = two_sided_threshold(sidak_level(1e-3, 3));
  for (int c = 0; c < 3; ++c) {
    double variance = 0;
    for (const Pixel& pixel : r.film.pixels) variance += pixel.variance_of_mean()[c];
    const double error = std::sqrt(variance) / static_cast<double>(r.film.pixels.size());
    INFO("channel ", c, ": ", mean_of(r.film)[c], " +- ", error, ", expected ", expected[c]);
    CHECK(error < 0.001 * expected[c]);
    CHECK(std::abs(z_score(mean_of(r.film)[c], expected[c], error)) < threshold);
  }
}

TEST_CASE("white bodies vanish in a white picture") {
  for (const Boundary boundary : {Boundary::matched, Boundary::diffuse}) {
    for (const Rgb& sigma : {Rgb(5), Rgb(1, 4, 20)}) {
      Scene scene = mixed_scene();
      scene.lights.clear();
      set_image(scene, constant_picture(Rgb(1)), 0);
      scene.materials[0] = translucent("a", {sigma, Rgb(1), Real(0.6)}, boundary);
      scene.materials[1] = translucent("b", {sigma, Rgb(1), 0}, boundary);
      scene.materials[2] = {"ground", DiffuseMaterial{Rgb(1)}};
      const Rendering r = render_spp(make_job(std::move(scene), 2), 32);
      const double threshold = two_sided_threshold(sidak_level(1e-3, 12));
      for (int c = 0; c < 3; ++c) {
        double variance = 0;
        for (const Pixel& pixel : r.film.pixels) variance += pixel.variance_of_mean()[c];
        const double error = std::sqrt(variance) / static_cast<double>(r.film.pixels.size());
        INFO(sigma.y, " channel ", c, ": ", mean_of(r.film)[c], " +- ", error);
        CHECK(error < 0.01);
        CHECK(std::abs(z_score(mean_of(r.film)[c], 1, error)) < threshold);
      }
    }
  }
}

TEST_CASE("the camera sees the picture itself, unless it is invisible") {
  Scene scene;
  scene.film = {6, 4};
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 20, {}};
  Image picture(2, 2, 3);  // quarters: left and right of -z, above and below the horizon
  for (int i = 0; i < 4; ++i) picture.values[static_cast<std::size_t>(3 * i)] = static_cast<float>(i + 1);
  set_image(scene, picture, 0);
  const Rendering seen = render_spp(make_job(scene, 1), 4);
  CHECK(seen.film.at(0, 0).mean[0] == 1);
  CHECK(seen.film.at(5, 0).mean[0] == 2);
  CHECK(seen.film.at(0, 3).mean[0] == 3);
  CHECK(seen.film.at(5, 3).mean[0] == 4);
  scene.environment.visible = false;
  CHECK(render_spp(make_job(scene, 1), 4).film.at(5, 3).mean[0] == 0);
}

TEST_CASE("a black picture leaves a scene to its lights") {
  Scene none = body_on_ground(kMilk);
  Scene black = none;
  set_image(black, constant_picture(Rgb(0)), 0);
  check_same(black, none, 200);
}
