#include "scene/scene_digest.h"

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <set>

using namespace meander;

namespace {

// One of every kind of light, material and shape.
Scene full_scene() {
  Scene scene;
  scene.lights = {{"a", RectangleLight{}, false},
                  {"b", SphereLight{}, false},
                  {"c", PointLight{}, false},
                  {"d", DirectionalLight{}, false}};
  scene.materials = {{"a", TranslucentMaterial{}}, {"b", DiffuseMaterial{}}, {"c", EmissiveMaterial{}}};
  scene.objects = {{"a", SphereShape{}, 0, {}},
                   {"b", BoxShape{}, 1, {}},
                   {"c", SlabShape{}, 2, {}},
                   {"d", std::make_shared<const Mesh>(make_torus_knot(12, 4)), 0, {}}};
  return scene;
}

template <class Kind, class Variant>
Kind& as(Variant& variant) {
  return std::get<Kind>(variant);
}

using Edit = std::function<void(Scene&)>;

const std::vector<Edit> kCameraEdits{
    [](Scene& s) { s.camera.look_from.x += 1e-12; },
    [](Scene& s) { s.camera.look_at.y += 1; },
    [](Scene& s) { s.camera.up.z += 1; },
    [](Scene& s) { s.camera.vertical_fov = 41; },
    [](Scene& s) { s.camera.orthographic_height = 40; },
    [](Scene& s) { s.film.width = 961; },
    [](Scene& s) { s.film.height = 961; },
    [](Scene& s) { s.environment.radiance.y = Real(0.1); },
    [](Scene& s) { s.environment.visible = false; },
    [](Scene& s) { s.environment.image = std::make_shared<const EnvironmentImage>(Image(4, 2, 3)); },
    [](Scene& s) { s.environment.image = std::make_shared<const EnvironmentImage>(Image(4, 2, 3), 90); },
    [](Scene& s) { s.environment.image = std::make_shared<const EnvironmentImage>(Image(4, 2, 3), 0, 2); },
    [](Scene& s) { s.environment.image = std::make_shared<const EnvironmentImage>(Image(2, 4, 3)); },
    [](Scene& s) {
      Image lit(4, 2, 3);
      lit.at(1, 1)[2] = 1;
      s.environment.image = std::make_shared<const EnvironmentImage>(lit);
    }};

const std::vector<Edit> kLightEdits{
    [](Scene& s) { s.lights[0].visible = true; },
    [](Scene& s) { as<RectangleLight>(s.lights[0].shape).center.x = 1; },
    [](Scene& s) { as<RectangleLight>(s.lights[0].shape).look_at.x = 1; },
    [](Scene& s) { as<RectangleLight>(s.lights[0].shape).up.x = 1; },
    [](Scene& s) { as<RectangleLight>(s.lights[0].shape).width = 2; },
    [](Scene& s) { as<RectangleLight>(s.lights[0].shape).height = 2; },
    [](Scene& s) { as<RectangleLight>(s.lights[0].shape).radiance.z = 2; },
    [](Scene& s) { as<SphereLight>(s.lights[1].shape).center.x = 1; },
    [](Scene& s) { as<SphereLight>(s.lights[1].shape).radius = 2; },
    [](Scene& s) { as<SphereLight>(s.lights[1].shape).radiance.x = 2; },
    [](Scene& s) { as<PointLight>(s.lights[2].shape).position.x = 1; },
    [](Scene& s) { as<PointLight>(s.lights[2].shape).intensity.x = 2; },
    [](Scene& s) { as<DirectionalLight>(s.lights[3].shape).direction.x = 1; },
    [](Scene& s) { as<DirectionalLight>(s.lights[3].shape).irradiance.x = 2; },
    [](Scene& s) { s.lights.pop_back(); },
    [](Scene& s) { std::swap(s.lights[0], s.lights[1]); }};

const std::vector<Edit> kObjectEdits{
    [](Scene& s) { as<TranslucentMaterial>(s.materials[0].kind).medium.sigma_t.x = 2; },
    [](Scene& s) { as<TranslucentMaterial>(s.materials[0].kind).medium.albedo.y = Real(0.5); },
    [](Scene& s) { as<TranslucentMaterial>(s.materials[0].kind).medium.g = Real(0.5); },
    [](Scene& s) { as<TranslucentMaterial>(s.materials[0].kind).boundary = Boundary::diffuse; },
    [](Scene& s) { as<TranslucentMaterial>(s.materials[0].kind).ior = 1.5; },
    [](Scene& s) { as<TranslucentMaterial>(s.materials[0].kind).roughness = 0.5; },
    [](Scene& s) { as<DiffuseMaterial>(s.materials[1].kind).color.x = 0; },
    [](Scene& s) { as<EmissiveMaterial>(s.materials[2].kind).radiance.x = 0; },
    [](Scene& s) { s.objects[0].material = 1; },
    [](Scene& s) { s.objects[0].transform.translate.x = 1; },
    [](Scene& s) { s.objects[0].transform.rotate.x = 1; },
    [](Scene& s) { s.objects[0].transform.scale.x = 2; },
    [](Scene& s) { s.objects[0].shape = BoxShape{}; },
    [](Scene& s) { s.objects[3].shape = std::make_shared<const Mesh>(make_torus_knot(12, 5)); },
    [](Scene& s) {
      Mesh mesh = *as<std::shared_ptr<const Mesh>>(s.objects[3].shape);
      mesh.positions[7].y += 1e-9;
      s.objects[3].shape = std::make_shared<const Mesh>(std::move(mesh));
    },
    [](Scene& s) {
      Mesh mesh = *as<std::shared_ptr<const Mesh>>(s.objects[3].shape);
      std::swap(mesh.triangles[0], mesh.triangles[1]);
      s.objects[3].shape = std::make_shared<const Mesh>(std::move(mesh));
    },
    [](Scene& s) { s.objects.pop_back(); }};

}  // namespace

TEST_CASE("the digest of a scene tells every value that its image depends on") {
  std::set<std::uint64_t> seen{digest_of(full_scene())};
  std::size_t scenes = 1;
  for (const auto* edits : {&kCameraEdits, &kLightEdits, &kObjectEdits})
    for (std::size_t i = 0; i < edits->size(); ++i, ++scenes) {
      Scene scene = full_scene();
      (*edits)[i](scene);
      CAPTURE(scenes);
      CHECK(seen.insert(digest_of(scene)).second);
    }
  CHECK(seen.size() == scenes);
}

TEST_CASE("the digest of a scene does not depend on names, the display, or where a mesh lies in memory") {
  const std::uint64_t digest = digest_of(full_scene());
  CHECK(digest_of(full_scene()) == digest);
  Scene scene = full_scene();
  scene.name = "other";
  scene.lights[0].name = scene.materials[0].name = scene.objects[0].name = "other";
  scene.display.exposure = 3;
  CHECK(digest_of(scene) == digest);
}
