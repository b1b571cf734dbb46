#include <doctest/doctest.h>

#include "io/scene_text.h"
#include "support/temporary_folder.h"

using namespace meander;

TEST_CASE("a whole scene arrives as written, defaults where it is silent") {
  const Scene scene = load(R"(
    [scene]
    millimetres_per_unit = 10
    [camera]
    look_from = [0, 1, 5]
    look_at = [0, 0, 0]
    orthographic_height = 2.5
    [film]
    width = 64
    [display]
    exposure = -1.5
    tone = "filmic"
    [environment]
    radiance = [0.1, 0.2, 0.3]
    visible = false
    [[light]]
    name = "key"
    type = "rectangle"
    center = [0, 3, 0]
    look_at = [0, 0, 0]
    radiance = 5
    [[light]]
    type = "directional"
    direction = [0, -1, 0]
    [[material]]
    name = "milk"
    sigma_s = [1, 2, 3]
    sigma_a = 1
    g = 0.5
    boundary = "diffuse"
    [[material]]
    name = "ground"
    type = "diffuse"
    color = 0.25
    [[object]]
    shape = "sphere"
    material = "milk"
    transform = { translate = [1, 2, 3], scale = 2 }
    [[object]]
    shape = "torus_knot"
    material = "ground")");
  CHECK(scene.camera.orthographic_height == 2.5);
  CHECK(scene.film.width == 64);
  CHECK(scene.film.height == 540);
  CHECK(scene.display.exposure == -1.5);
  CHECK(scene.display.tone == Tone::filmic);
  CHECK(scene.environment.radiance.y == Real(0.2));
  CHECK_FALSE(scene.environment.visible);
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.lights[1].name == "light2");
  CHECK(std::get<RectangleLight>(scene.lights[0].shape).radiance == Rgb(5));
  CHECK(scene.millimetres_per_unit == 10);
  CHECK(load(kWax + "albedo = 0.9\nmean_free_path = 1").millimetres_per_unit == 1);
  // Per millimetre, at ten millimetres a unit.
  CHECK(medium_of(scene).sigma_t.x == doctest::Approx(20));
  CHECK(medium_of(scene).albedo.z == doctest::Approx(0.75));
  CHECK(std::get<TranslucentMaterial>(scene.materials[0].kind).boundary == Boundary::diffuse);
  CHECK(scene.objects[0].transform.scale == DVec3(2));
  CHECK(std::get<std::shared_ptr<const Mesh>>(scene.objects[1].shape)->triangles.size() == 100000);
}

TEST_CASE("the three parametrisations of a medium") {
  const Medium albedo = medium_of(load(kWax + "albedo = [0.9, 0.8, 1]\nmean_free_path = 0.1\n"));
  CHECK(albedo.sigma_t.x == doctest::Approx(10));
  CHECK(albedo.albedo.z == 1);
  const Medium color = medium_of(load(kWax + "color = 0.5\nradius = [1, 0.3, 0.2]\nradius_scale = 0.5\n"));
  CHECK(color.sigma_t.x == doctest::Approx(2));
  const Medium chiang =
      medium_of(load(kWax + "color = [0.5, 0.75, 0.3]\nradius = [1, 0.3, 0.2]\ninversion = \"chiang\"\n"));
  CHECK(chiang.sigma_t.y == doctest::Approx(2.87666));
  CHECK(chiang.albedo.x == doctest::Approx(0.912298));
}

TEST_CASE("bad input is one line with the place, the wrong value and the right ones") {
  CHECK(error_of("[camera]\nlok_from = [0, 0, 5]\n") ==
        ":2:1: unknown key 'lok_from' in [camera]; did you mean 'look_from'?");
  CHECK(error_of("[film]\nwidth = 0\n") == ":2:9: 'width' is 0, but must be a whole number from 1 to 16384");
  CHECK(error_of("[film]\nwidth = 1.5\n") == ":2:9: 'width' must be a whole number, not a number");
  CHECK(error_of("[film]\nwidth = \"wide\"\n") ==
        ":2:9: 'width' must be a whole number, not the text 'wide'");
  CHECK(error_of(kWax + "albedo = 1.5\nmean_free_path = 1\n") ==
        ":3:10: 'albedo' is 1.5, but must be in [0, 1]");
  CHECK(error_of(kWax + "albedo = nan\nmean_free_path = 1\n") ==
        ":3:10: 'albedo' is nan, but must be in [0, 1]");
  CHECK(error_of(kWax + "albedo = 0.5\nmean_free_path = inf\n") ==
        ":4:18: 'mean_free_path' is inf, but must be greater than 0 and at most 1e30 in size");
  CHECK(error_of(kWax + "albedo = 0.5\nmean_free_path = -1\n") ==
        ":4:18: 'mean_free_path' is -1, but must be greater than 0");
  CHECK(error_of(kWax + "albedo = 0.5\nmean_free_path = 1\ng = 1\n") ==
        ":5:5: 'g' is 1, but must be greater than -1 and less than 1, by 1e-7 at least");
  CHECK(error_of(kWax + "albedo = 0.5\n") == ":1:1: [[material]] needs 'mean_free_path'");
  CHECK(error_of(kWax + "colour = 0.5\nradius = 1\n") ==
        ":3:1: unknown key 'colour' in [[material]]; did you mean 'color'?");
  CHECK(error_of(kWax + "sigma_s = 1\nalbedo = 0.5\n")
            .starts_with(":3:11: 'sigma_s' and 'albedo' describe the medium twice"));
  CHECK(error_of(kWax).starts_with(":1:1: [[material]] needs color + radius"));
  CHECK(error_of(kWax + "albedo = [1, 1]\nmean_free_path = 1\n") ==
        ":3:10: 'albedo' must be a number or a list of three numbers, not a list of 2");
  CHECK(error_of(kWax + "type = \"glass\"\n") ==
        ":3:8: 'type' is 'glass', but must be one of: translucent, diffuse, emissive");
  CHECK(error_of("[[object]]\nshape = \"sphere\"\nmaterial = \"waxx\"\n" + kWax +
                 "albedo = 0.5\nmean_free_path = 1\n") ==
        ":3:12: there is no material named 'waxx'; did you mean 'wax'?");
  CHECK(error_of(kWax + "albedo = 0.5\nmean_free_path = 1\n[[object]]\nmaterial = \"wax\"\n") ==
        ":5:1: [[object]] needs either 'shape' or 'mesh'");
  CHECK(error_of(kWax + "albedo = 0.5\nmean_free_path = 1\n[[object]]\nmaterial = \"wax\"\nshape = "
                        "\"sphere\"\ntransform = { scale = 0 }\n") ==
        ":8:23: 'scale' is 0, but must be greater than 0");
  CHECK(error_of("[camera]\nlook_from = [0, 0, 0]\nlook_at = [0, 0, 0]\n") ==
        ":3:11: 'look_at' must differ from 'look_from'");
  CHECK(error_of("[camera]\nup = [0, 0, 1]\n") == ":2:6: 'up' must not be zero or parallel to the view");
  CHECK(error_of("[film\n").starts_with(":1:"));
  CHECK(error_of("light = 3\n") == ":1:9: 'light' must be a list of tables, [[light]], not a number");
  CHECK(error_of("[[light]]\nname = \"a\"\n") == ":1:1: [[light]] needs 'type'");
  CHECK(error_of("[[light]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = -2\n") ==
        ":4:10: 'radius' is -2, but must be greater than 0");
}

TEST_CASE("keys of many parts are refused before they nest tables without end, and nothing else is") {
  const auto parts = [](int count) {
    std::string key = "a";
    for (int i = 1; i < count; ++i) key += i % 2 ? ".a" : " . \"#.'\"";
    return key;
  };
  const std::string refusal = "a key has more than 16 parts; those of a scene have at most three, such as ";
  for (const int count : {17, 40000})
    for (const std::string& text :
         {parts(count) + " = 1", "[" + parts(count) + "]", "x = {" + parts(count) + " = 1}",
          "x = ['''a''''', {" + parts(count) + " = 1}]"}) {
      CHECK(error_of("\n" + text).starts_with(":2:"));
      CHECK(error_of("\n" + text).ends_with(refusal + "camera.look_at"));
    }
  CHECK(error_of(parts(16) + " = 1").starts_with(":1:1: unknown key 'a'"));
  std::string dots(1000, '.');
  CHECK(error_of("# " + dots + "\nx = \"" + dots + "\"\n").starts_with(":2:1: unknown key 'x'"));
  CHECK(error_of("x = \"\"\"\n" + dots + "\\\"\"\" # \n" + dots + "\"\"\"\n")
            .starts_with(":1:1: unknown key 'x'"));
  std::string list = "x = [";
  for (int i = 0; i < 100; ++i) list += "1.5, ";
  CHECK(error_of(list + "]").starts_with(":1:1: unknown key 'x'"));
  const std::string wax = kWax + "albedo = 0.5\nmean_free_path = 1\n";
  CHECK(error_of(wax, {"film." + parts(40000) + "=1"}).ends_with(refusal + "camera.look_at"));
  CHECK(
      error_of(wax, {"film.width={" + parts(40000) + "=1}"}).ends_with("=1}: " + refusal + "camera.look_at"));
}

TEST_CASE("what is wrong with a bare mesh has no place in a scene file") {
  const TemporaryFolder folder;
  const std::string flat = folder.write(
      "flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1e-30\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  CHECK_THROWS_WITH_AS((void)load_scene(flat, {}),
                       (flat + ": " + flat + " encloses no volume, and cannot hold a medium").c_str(), Error);
  CHECK_THROWS_WITH_AS((void)load_scene(folder.path().string(), {}),
                       (folder.path().string() + ": is a folder, not a scene file").c_str(), Error);
}

TEST_CASE("files that are not there") {
  CHECK_THROWS_WITH_AS((void)load_scene("nowhere.toml", {}),
                       "nowhere.toml: cannot open: No such file or directory", Error);
  CHECK(
      error_of(kWax + "albedo = 1\nmean_free_path = 1\n[[object]]\nmaterial = \"wax\"\nmesh = \"none.ply\"\n")
          .find("none.ply: cannot open: No such file") != std::string::npos);
  CHECK(
      error_of(kWax + "albedo = 1\nmean_free_path = 1\n[[object]]\nmaterial = \"wax\"\nmesh = \"none.fbx\"\n")
          .find("none.fbx") != std::string::npos);
}

TEST_CASE("edits set any value by name") {
  const std::string text =
      kWax +
      "albedo = 0.5\nmean_free_path = 1\n[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [0, 1, 0]\n"
      "[[object]]\nname = \"ball\"\nshape = \"sphere\"\nmaterial = \"wax\"\n";
  const Scene scene = load(text, {"film.width=32", "material.wax.g=0.4", "light.key.intensity=[1, 2, 3]",
                                  "object.ball.transform.scale=3", "material.wax.boundary=diffuse"});
  CHECK(scene.film.width == 32);
  CHECK(medium_of(scene).g == Real(0.4));
  CHECK(std::get<PointLight>(scene.lights[0].shape).intensity.z == 3);
  CHECK(scene.objects[0].transform.scale == DVec3(3));
  CHECK(std::get<TranslucentMaterial>(scene.materials[0].kind).boundary == Boundary::diffuse);
}

TEST_CASE("setting one member of a parametrisation converts the material, the other quantities held") {
  const std::string color = kWax + "color = [0.5, 0.6, 0.7]\nradius = [1, 0.5, 0.25]\n";
  const Medium before = medium_of(load(color));
  const Medium albedo = medium_of(load(color, {"material.wax.albedo=0.9"}));
  CHECK(albedo.albedo == Rgb(Real(0.9)));
  for (int c = 0; c < 3; ++c) CHECK(albedo.sigma_t[c] == doctest::Approx(before.sigma_t[c]));
  const Medium sigma = medium_of(load(color, {"material.wax.sigma_a=0"}));
  for (int c = 0; c < 3; ++c)
    CHECK(sigma.sigma_t[c] == doctest::Approx(before.sigma_t[c] * before.albedo[c]));
  const Medium back = medium_of(
      load(kWax + "albedo = [0.9, 0.5, 0.99]\nmean_free_path = 0.1\ng = 0.6\n", {"material.wax.radius=0.2"}));
  const Rgb kept(Real(0.9), Real(0.5), Real(0.99));
  for (int c = 0; c < 3; ++c) {
    CHECK(back.sigma_t[c] == doctest::Approx(5));
    CHECK(back.albedo[c] == doctest::Approx(kept[c]).epsilon(1e-5));
  }
}

TEST_CASE("a bad edit is named as it was typed") {
  const std::string text = kWax + "albedo = 0.5\nmean_free_path = 1\n";
  CHECK(error_of(text, {"material.wax.g=2"}) ==
        "--set material.wax.g=2: 'g' is 2, but must be greater than -1 and less than 1, by 1e-7 at least");
  CHECK(error_of(text, {"material.jade.g=0"}) ==
        "--set material.jade.g=0: there is no material named 'jade'; known: wax");
  CHECK(error_of(text, {"light.key.radiance=0"}) ==
        "--set light.key.radiance=0: there is no light named 'key'; the scene has none");
  CHECK(error_of(text, {"film.width"}) ==
        "--set film.width: an edit must read PATH=VALUE, such as material.wax.g=0.4");
  CHECK(error_of(text, {"film.widht=3"}) ==
        "--set film.widht=3: unknown key 'widht' in [film]; did you mean 'width'?");
  CHECK(error_of(text, {"material=3"})
            .starts_with("--set material=3: a path into a list must read material.NAME.KEY"));
}

TEST_CASE("the scenes of the project load without a warning, and a bare mesh gets a studio") {
  const std::string folder = std::string(MEANDER_SOURCE_DIR) + "/scenes/";
  for (const char* name : {"wax_knot.toml", "sphere_furnace.toml", "soap.toml"}) {
    const SceneFile file = load_scene(folder + name, {});
    CHECK(file.warnings.empty());
    CHECK(!file.scene.objects.empty());
  }
  const std::vector<std::string> edits{"film.width=100", "material.wax.g=0.5"};
  const SceneFile studio = load_scene(folder + "soap.ply", edits);
  CHECK(studio.warnings.empty());
  CHECK(studio.scene.film.width == 100);
  CHECK(studio.scene.lights.size() == 2);
  REQUIRE(studio.scene.objects.size() == 2);
  CHECK(std::get<std::shared_ptr<const Mesh>>(studio.scene.objects[0].shape)->triangles.size() >= 100000);
  CHECK(std::get<TranslucentMaterial>(studio.scene.materials[0].kind).medium.g == Real(0.5));
}
