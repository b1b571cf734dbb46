#include "io/scene_text.h"
#include "medium/color_map.h"

using namespace meander;

namespace {

const TranslucentMaterial& material_of(const Scene& scene) {
  return std::get<TranslucentMaterial>(scene.materials.at(0).kind);
}

void check_close(const Rgb& value, const DVec3& expected, double relative) {
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(static_cast<double>(value[c]) == doctest::Approx(expected[c]).epsilon(relative));
  }
}

const std::string kGrey = kWax + "albedo = 0.9\nmean_free_path = 0.5\n";
const std::string kMarble = kWax + "preset = \"marble\"\n";

}  // namespace

TEST_CASE("boundary, ior and roughness arrive, with a matched surface where the file is silent") {
  const Scene plain = load(kGrey);
  CHECK(material_of(plain).boundary == Boundary::matched);
  CHECK(material_of(plain).ior == 1);
  CHECK(material_of(plain).roughness == 0);
  const Scene glass = load(kGrey + "boundary = \"dielectric\"\nior = 1.5\nroughness = 0.25\n");
  CHECK(material_of(glass).boundary == Boundary::dielectric);
  CHECK(material_of(glass).ior == 1.5);
  CHECK(material_of(glass).roughness == 0.25);
  const Scene diffuse = load(kGrey + "boundary = \"diffuse\"\nior = 1.4\n");
  CHECK(material_of(diffuse).boundary == Boundary::diffuse);
  CHECK(material_of(diffuse).ior == 1.4);
  CHECK(material_of(load(kGrey + "ior = 1\n")).ior == 1);
}

TEST_CASE("surfaces that do not fit together are errors which say what fits") {
  CHECK(error_of(kGrey + "ior = 1.5\n") ==
        ":5:7: a matched boundary has ior 1; use boundary = \"dielectric\" or \"diffuse\" for another");
  CHECK(error_of(kGrey + "boundary = \"diffuse\"\nior = 0.9\n") ==
        ":6:7: 'ior' is 0.9, but must be in [1, 4]");
  CHECK(error_of(kGrey + "boundary = \"diffuse\"\nior = 4.5\n") ==
        ":6:7: 'ior' is 4.5, but must be in [1, 4]");
  CHECK(error_of(kGrey + "boundary = \"dielectric\"\n") ==
        ":5:12: a dielectric boundary needs 'ior', such as ior = 1.5");
  CHECK(error_of(kGrey + "roughness = 0.2\n") == ":5:13: 'roughness' is for boundary = \"dielectric\" alone");
  CHECK(error_of(kGrey + "boundary = \"dielectric\"\nior = 1.5\nroughness = 1.5\n") ==
        ":7:13: 'roughness' is 1.5, but must be in [0, 1]");
  CHECK(error_of(kGrey + "boundary = \"glass\"\n") ==
        ":5:12: 'boundary' is 'glass', but must be one of: matched, diffuse, dielectric");
  CHECK(error_of(kGrey + "g_lock = \"hold\"\n") ==
        ":5:10: 'g_lock' is 'hold', but must be one of: look, sigma_t, sigma_s_reduced");
}

TEST_CASE("a colour is delivered under the material's own surface") {
  const std::string colour = kWax + "color = [0.2, 0.5, 0.8]\nradius = 0.25\ng = 0.6\n";
  for (const std::string surface :
       {"", "boundary = \"diffuse\"\nior = 1.5\n", "boundary = \"dielectric\"\nior = 1.5\n"}) {
    const Scene scene = load(colour + surface);
    const TranslucentMaterial& wax = material_of(scene);
    const ColorMap map(0.6, {wax.boundary, wax.ior});
    check_close(wax.medium.sigma_t, DVec3(4), 1e-7);
    const DVec3 asked(0.2, 0.5, 0.8);
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(map.color(static_cast<double>(wax.medium.albedo[c])) - asked[c]) < 1e-5);
  }
}

TEST_CASE("a radius of zero is plain diffuse of that colour, in all channels or none") {
  const Scene scene =
      load(kWax + "color = [0.1, 0.5, 0.9]\nradius = 0\ng = 0.3\nboundary = \"diffuse\"\nior = 1.5\n");
  CHECK(std::get<DiffuseMaterial>(scene.materials.at(0).kind).color == Rgb(DVec3(0.1, 0.5, 0.9)));
  CHECK(error_of(kWax + "color = 0.5\nradius = [0, 1, 1]\n") ==
        ":4:10: 'radius' must be greater than 0 in every channel, or 0 in all three (plain diffuse)");
  CHECK(error_of(kWax + "color = 0.5\nradius = -1\n") == ":4:10: 'radius' is -1, but must be 0 or more");
  CHECK(error_of(kWax + "color = 0.5\nradius = 0\n", {"material.wax.albedo=0.5"}) ==
        ":4:10: a radius of 0 is plain diffuse and has no albedo: set a radius greater than 0 first");
  const Scene soft =
      load(kWax + "color = 0.5\nradius = 0\n", {"material.wax.g=0.5", "material.wax.radius=2"});
  CHECK(medium_of(soft).g == Real(0.5));
  check_close(medium_of(soft).sigma_t, DVec3(0.5), 1e-7);
}

TEST_CASE("a preset brings its coefficients per millimetre, its g and a dielectric surface") {
  const Scene marble = load("[scene]\nmillimetres_per_unit = 10\n" + kMarble);
  check_close(medium_of(marble).sigma_t, {21.921, 26.241, 30.071}, 1e-6);
  check_close(medium_of(marble).albedo, {2.19 / 2.1921, 2.62 / 2.6241, 3 / 3.0071}, 1e-7);
  CHECK(medium_of(marble).g == 0);
  CHECK(material_of(marble).boundary == Boundary::dielectric);
  CHECK(material_of(marble).ior == 1.5);
  const Scene milk = load(kWax + "preset = \"regular_milk\"\n");
  CHECK(medium_of(milk).g == doctest::Approx(0.715));
  CHECK(material_of(milk).ior == 1.33);
  // Each channel has its own sigma_s' = sigma_s (1 - g).
  const double expected = 18.2052 * 0.25 / 0.285;
  CHECK(static_cast<double>(medium_of(milk).sigma_t.x * medium_of(milk).albedo.x) ==
        doctest::Approx(expected));
}

TEST_CASE("other keys override a preset, g in a way that holds sigma_s'") {
  const Medium forward = medium_of(load(kMarble + "g = 0.8\n"));
  CHECK(forward.g == Real(0.8));
  check_close(forward.sigma_t, {10.95 + 0.0021, 13.1 + 0.0041, 15 + 0.0071}, 1e-6);
  const Scene matched = load(kMarble + "boundary = \"matched\"\n");
  CHECK(material_of(matched).boundary == Boundary::matched);
  CHECK(material_of(matched).ior == 1);
  const Scene diffuse = load(kMarble + "boundary = \"diffuse\"\n");
  CHECK(material_of(diffuse).boundary == Boundary::diffuse);
  CHECK(material_of(diffuse).ior == 1.5);
  CHECK(material_of(load(kMarble + "ior = 1.4\nroughness = 0.5\n")).ior == 1.4);
  CHECK(material_of(load(kMarble + "ior = 1.4\nroughness = 0.5\n")).roughness == 0.5);
  const Medium absorbing = medium_of(load(kMarble + "sigma_a = 1\n"));
  check_close(absorbing.sigma_t, {3.19, 3.62, 4}, 1e-6);
  const Medium scattering = medium_of(load(kMarble + "sigma_s = 5\ng = 0.5\n"));
  check_close(scattering.sigma_t, {5.0021, 5.0041, 5.0071}, 1e-6);
}

TEST_CASE("one member of another parametrisation over a preset holds the other member") {
  const Medium marble = medium_of(load(kMarble));
  const Medium albedo = medium_of(load(kMarble + "albedo = 0.5\n"));
  CHECK(albedo.albedo == Rgb(Real(0.5)));
  check_close(albedo.sigma_t, DVec3(marble.sigma_t), 1e-6);
  const Medium path = medium_of(load(kMarble + "mean_free_path = 2\n"));
  check_close(path.albedo, DVec3(marble.albedo), 1e-7);
  check_close(path.sigma_t, DVec3(0.5), 1e-7);
  const Medium radius = medium_of(load(kMarble + "radius = 2\n"));
  check_close(radius.albedo, DVec3(marble.albedo), 1e-7);
  check_close(radius.sigma_t, DVec3(0.5), 1e-7);
  const Medium colour = medium_of(load(kMarble + "color = 0.5\n"));
  check_close(colour.sigma_t, DVec3(marble.sigma_t), 1e-6);
  const DVec3 delivered = color_of(DVec3(colour.albedo), 0, {Boundary::dielectric, 1.5});
  for (int c = 0; c < 3; ++c) CHECK(delivered[c] == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(
      error_of(kMarble + "color = 0.5\nalbedo = 0.5\n").starts_with(":5:10: 'albedo' and 'color' describe"));
}

TEST_CASE("a preset that does not exist is answered with the nearest one") {
  CHECK(error_of(kWax + "preset = \"marbel\"\n") ==
        ":3:10: there is no preset 'marbel'; did you mean 'marble'?");
  CHECK(error_of(kWax + "preset = \"xyzzyxyzzy\"\n")
            .starts_with(":3:10: there is no preset 'xyzzyxyzzy'; known: apple, chicken1, "));
  CHECK(error_of(kWax + "type = \"diffuse\"\npreset = \"marble\"\n").find("unknown key 'preset'") !=
        std::string::npos);
}
