#include <array>
#include <random>
#include <string>

#include "io/document_support.h"
#include "io/image_file.h"
#include "scene/camera_moves.h"
#include "scene/light_rigs.h"
#include "scene/object_measures.h"
#include "scene/sky.h"

using namespace meander;

namespace {

DVec3 middle_of(const Bounds& bounds) { return 0.5 * (bounds.low + bounds.high); }

std::string plane_picture(const Folder& folder, const std::string& name, float value) {
  Image image(8, 4, 3);
  for (float& v : image.values) v = value;
  const std::vector<std::string> channels{"R", "G", "B"};
  write_exr(folder.at(name), image, channels, {}, {});
  return folder.at(name);
}

Real up_radiance(const SceneDocument& document) {
  const auto image = document.scene().scene.environment.image;
  return image ? image->radiance(Vec3(0, 1, 0)).x : Real(-1);
}

// What a user may edit, and to what: a good part of it wrong.
constexpr std::array kEditedPaths{"material.wax.color",
                                  "material.wax.radius",
                                  "material.wax.radius_scale",
                                  "material.wax.albedo",
                                  "material.wax.mean_free_path",
                                  "material.wax.sigma_s",
                                  "material.wax.sigma_a",
                                  "material.wax.g",
                                  "material.wax.g_lock",
                                  "material.wax.boundary",
                                  "material.wax.ior",
                                  "material.wax.roughness",
                                  "material.wax.preset",
                                  "material.wax.inversion",
                                  "material.wax.type",
                                  "material.ground.color",
                                  "light.key.radiance",
                                  "light.key.width",
                                  "light.back.visible",
                                  "object.knot.transform.scale",
                                  "object.knot.transform.rotate",
                                  "object.knot.shape",
                                  "object.knot.name",
                                  "camera.look_from",
                                  "camera.vertical_fov",
                                  "camera.orthographic_height",
                                  "environment.rotation",
                                  "environment.scale",
                                  "environment.sky",
                                  "environment.visible",
                                  "film.width",
                                  "display.exposure",
                                  "display.tone",
                                  "scene.millimetres_per_unit",
                                  "scene.units",
                                  "teapot"};
constexpr std::array kEditedValues{"0.5",
                                   "[0.9, 0.6, 0.3]",
                                   "1",
                                   "0",
                                   "-2",
                                   "1e9",
                                   "nan",
                                   "true",
                                   "[0, 0]",
                                   "0.1",
                                   "9007199254740993",
                                   "look",
                                   "sigma_s_reduced",
                                   "diffuse",
                                   "dielectric",
                                   "matched",
                                   "1.5",
                                   "marble",
                                   "chiang",
                                   "exact",
                                   "overcast",
                                   "filmic",
                                   "sphere",
                                   "64",
                                   "\"",
                                   "{ a = 1 }",
                                   "[[1]]",
                                   "1979-05-27",
                                   "3 # three",
                                   "2\nx = 3"};

std::string random_edit(std::mt19937& random) {
  return std::string(kEditedPaths[random() % kEditedPaths.size()]) + "=" +
         kEditedValues[random() % kEditedValues.size()];
}

void random_structural_edit(SceneDocument& document, std::mt19937& random) {
  const Scene scene = document.scene().scene;
  const auto amount = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  switch (random() % 6) {
    case 0:
      return document.set_camera(orbit(dolly(scene.camera, amount()), amount(), amount()));
    case 1:
      return document.set_lights(
          make_rig(static_cast<Rig>(random() % 4), subject_bounds(scene), scene.camera));
    case 2:
      return document.set_light("key",
                                orbit_light(scene.lights.front(), DVec3(0), 90 * amount(), 90 * amount()));
    case 3:
      return document.set_environment_sky(random() % 4 ? "softbox" : "sunny");
    case 4:
      return document.set_environment_radiance(DVec3(amount(), 0.5, 0.5));
    default:
      return document.set_object_mesh(random() % 2 ? "knot" : "ground", kSoapMesh);
  }
}

}  // namespace

TEST_CASE("whatever is done to a document, it reads, and its text gives the same scene") {
  std::mt19937 random(20);
  int refused = 0;
  int done = 0;
  for (int run = 0; run < 4; ++run) {
    SceneDocument document = SceneDocument::open(kKnot);
    for (int step = 0; step < 60; ++step) {
      const SceneDocument before = document;
      const std::string edit = random_edit(random);
      CAPTURE(run);
      CAPTURE(edit);
      try {
        if (random() % 4 == 0)
          random_structural_edit(document, random);
        else
          document.apply(edit);
        ++done;
      } catch (const Error& error) {
        CHECK(error.exit_code() == 2);
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        CHECK(document.text() == before.text());
        ++refused;
      }
      REQUIRE_NOTHROW((void)document.scene());
      if (step % 8 == 0) check_reads_back(document);
    }
  }
  CHECK(done > 60);
  CHECK(refused > 80);
}

TEST_CASE("the camera that is set is the scene's") {
  SceneDocument document = SceneDocument::open(kKnot);
  Camera camera = orbit(document.scene().scene.camera, 0.3, 0.1);
  camera.up = {0.1, 1, 0};
  document.set_camera(camera);
  const Camera now = document.scene().scene.camera;
  CHECK(now.look_from == camera.look_from);
  CHECK(now.look_at == camera.look_at);
  CHECK(now.up == camera.up);
  CHECK(now.vertical_fov == camera.vertical_fov);
  camera.orthographic_height = 2.5;
  document.set_camera(camera);
  CHECK(document.scene().scene.camera.orthographic_height == 2.5);
  check_reads_back(document);
  camera.look_from = camera.look_at;
  check_refused(
      document, [&] { document.set_camera(camera); }, "'look_at' must differ from 'look_from'");
  Camera front;
  front.look_from = {0, 0.5, 3};
  CHECK(camera_text(front) == "[camera]\nlook_from = [0, 0.5, 3]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n");
}

TEST_CASE("lights that are set are the scene's, to the last digit") {
  SceneDocument document = SceneDocument::open(kKnot);
  const Scene scene = document.scene().scene;
  const std::vector<Light> rig = make_rig(Rig::rim, subject_bounds(scene), scene.camera);
  document.set_lights(rig);
  Scene expected = scene;
  expected.lights = rig;
  CHECK(dump(document.scene().scene) == dump(expected));
  Light sun{"sun", DirectionalLight{{1, -1, 0.5}, Rgb(Real(0.1), 2, 3)}, false};
  document.set_light("key", sun);
  Light bulb{"bulb", SphereLight{{1, 2, 3}, 0.3, Rgb(5)}, true};
  document.set_light("rim", bulb);
  expected.lights[0] = sun;
  expected.lights[1] = bulb;
  CHECK(dump(document.scene().scene) == dump(expected));
  CHECK(document.text().find("irradiance = [0.1, 2, 3]") != std::string::npos);
  check_refused(
      document, [&] { document.set_light("key", sun); }, "no light named 'key'; known: sun, bulb, fill");
  document.set_lights({});
  CHECK(document.scene().scene.lights.empty());
  check_reads_back(document);
}

TEST_CASE("a light without a name is found by its number, and a grey one stays one number") {
  SceneDocument document = SceneDocument::from_text(
      "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 2\n", "here.toml");
  document.set_light("light1", {"light1", PointLight{{0, 2, 0}, Rgb(3)}, false});
  CHECK(document.text() ==
        "[[light]]\nname = \"light1\"\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = 3\n");
  document.set_light("light1", {"light1", PointLight{{0, 2, 0}, Rgb(3, 2, 1)}, false});
  CHECK(document.text().find("intensity = [3, 2, 1]") != std::string::npos);
}

TEST_CASE("environments take each other's place") {
  const Folder folder;
  const std::string grey = plane_picture(folder, "grey.exr", 0.5f);
  SceneDocument document = SceneDocument::open(kKnot);
  document.apply("environment.visible=false");
  document.set_environment_sky("overcast");
  document.apply("environment.scale=3");
  document.apply("environment.rotation=30");
  CHECK(up_radiance(document) == doctest::Approx(3).epsilon(1e-3));
  document.set_environment_sky("softbox");
  CHECK(document.text().find("rotation = 30\nscale = 3\nvisible = false") != std::string::npos);
  document.set_environment_image(grey);
  CHECK(up_radiance(document) == Real(0.5));
  CHECK(watched(document) == std::vector<std::string>{kKnot, grey});
  document.apply("environment.scale=2");
  CHECK(up_radiance(document) == 1);
  document.set_environment_image(plane_picture(folder, "bright.exr", 2));
  CHECK(up_radiance(document) == 4);
  (void)plane_picture(folder, "bright.exr", 3);
  CHECK(up_radiance(document) == 6);
  check_refused(
      document, [&] { document.apply("environment.sky=overcast"); }, "sky or image, not both");
  check_refused(
      document, [&] { document.set_environment_sky("sunny"); }, "'sky' is 'sunny'");
  check_refused(
      document, [&] { document.set_environment_image(folder.at("none.exr")); }, "none.exr");
  check_refused(
      document, [&] { document.apply("environment.scale=1e30"); }, "radiance must be finite");
  document.set_environment_radiance(DVec3(0.25, 0.5, 1));
  const Environment environment = document.scene().scene.environment;
  CHECK_FALSE(environment.image);
  CHECK(environment.radiance == Rgb(Real(0.25), Real(0.5), 1));
  CHECK_FALSE(environment.visible);
  check_refused(
      document, [&] { document.set_environment_radiance(DVec3(-1)); }, "'radiance' is -1");
  check_reads_back(document);
}

TEST_CASE("a mesh takes an object's place, as large and resting where it was") {
  const Folder folder;
  folder.write("body.obj", tetrahedron(40));
  SceneDocument document = SceneDocument::open(kKnot);
  const Scene before = document.scene().scene;
  document.set_object_mesh("knot", folder.at("body.obj"));
  const Scene after = document.scene().scene;
  const Object& knot = object_named(before, "knot");
  const Object& body = object_named(after, "knot");
  CHECK(std::get<MeshPointer>(body.shape)->triangles.size() == 4);
  CHECK(bounding_radius(body) == doctest::Approx(bounding_radius(knot)).epsilon(1e-9));
  const DVec3 moved = middle_of(world_bounds(body)) - middle_of(world_bounds(knot));
  CHECK(std::abs(moved.x) < 1e-9);
  CHECK(std::abs(moved.z) < 1e-9);
  CHECK(world_bounds(body).low.y == doctest::Approx(world_bounds(knot).low.y).epsilon(1e-9));
  CHECK(body.transform.rotate == DVec3(0));
  CHECK(body.material == knot.material);
  CHECK(document.text().find("mesh = \"" + folder.at("body.obj") + "\"") != std::string::npos);
  Scene materials = after;
  materials.objects = before.objects;
  CHECK(dump(materials) == dump(before));
  check_reads_back(document);
}

TEST_CASE("in place of a mesh, a mesh keeps its up axis and rotation") {
  const Folder folder;
  folder.write("body.obj", tetrahedron(2));
  SceneDocument document = SceneDocument::open(kSoap);
  document.apply("object.bar.up_axis=z");
  document.apply("object.bar.transform.rotate=[10, 20, 30]");
  document.apply("object.bar.transform.scale=[1, 2, 0.5]");
  const Object bar = object_named(document.scene().scene, "bar");
  document.set_object_mesh("bar", folder.at("body.obj"));
  const Object body = object_named(document.scene().scene, "bar");
  CHECK(body.transform.rotate == DVec3(10, 20, 30));
  CHECK(bounds_of(*std::get<MeshPointer>(body.shape)).low.z == -2);
  CHECK(bounding_radius(body) == doctest::Approx(bounding_radius(bar)).epsilon(1e-9));
  CHECK(world_bounds(body).low.y == doctest::Approx(world_bounds(bar).low.y).epsilon(1e-9));
  folder.write("broken.obj", "v 0 0\n");
  check_refused(
      document, [&] { document.set_object_mesh("bar", folder.at("broken.obj")); }, "broken.obj");
  check_refused(
      document, [&] { document.set_object_mesh("bar", folder.at("none.obj")); }, "cannot open");
  check_refused(
      document, [&] { document.set_object_mesh("ground", folder.at("body.obj")); }, "unbounded slab");
  check_refused(
      document, [&] { document.set_object_mesh("cup", folder.at("body.obj")); },
      "no object named 'cup'; known: bar, ground");
}
