// A scene as text that tells any two different scenes apart, for comparing them.
#pragma once

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include "scene/scene.h"

namespace meander {

class SceneDump {
 public:
  explicit SceneDump(const Scene& scene) {
    out_ << std::hexfloat;
    add(scene.millimetres_per_unit, scene.camera.look_from, scene.camera.look_at, scene.camera.up);
    if (scene.camera.orthographic_height)
      add("orthographic", *scene.camera.orthographic_height);
    else
      add("perspective", scene.camera.vertical_fov);
    add("film", scene.film.width, scene.film.height, scene.display.exposure,
        static_cast<int>(scene.display.tone));
    add("environment", scene.environment.radiance, scene.environment.visible);
    if (scene.environment.image)
      for (int i = 0; i < 40; ++i) {
        const Vec3 d(std::sin(Real(i) * Real(2.4)), Real(i) / 20 - 1, std::cos(Real(i) * Real(2.4)));
        add(scene.environment.image->radiance(glm::normalize(d)));
      }
    for (const Light& light : scene.lights) add_light(light);
    for (const Material& material : scene.materials) add_material(material);
    for (const Object& object : scene.objects) add_object(object);
  }
  [[nodiscard]] std::string text() const { return out_.str(); }

 private:
  template <class... T>
  void add(const T&... values) {
    (put(values), ...);
    out_ << '\n';
  }
  template <class T>
  void put(const T& value) {
    out_ << value << ' ';
  }
  void put(const DVec3& v) { out_ << '(' << v.x << ' ' << v.y << ' ' << v.z << ") "; }
  void put(const glm::vec3& v) { put(DVec3(v)); }

  void add_light(const Light& light) {
    add("light", light.name, light.visible, light.shape.index());
    if (const auto* r = std::get_if<RectangleLight>(&light.shape))
      add(r->center, r->look_at, r->up, r->width, r->height, r->radiance);
    if (const auto* s = std::get_if<SphereLight>(&light.shape)) add(s->center, s->radius, s->radiance);
    if (const auto* p = std::get_if<PointLight>(&light.shape)) add(p->position, p->intensity);
    if (const auto* d = std::get_if<DirectionalLight>(&light.shape)) add(d->direction, d->irradiance);
  }
  void add_material(const Material& material) {
    add("material", material.name, material.kind.index());
    if (const auto* t = std::get_if<TranslucentMaterial>(&material.kind))
      add(t->medium.sigma_t, t->medium.albedo, t->medium.g, static_cast<int>(t->boundary), t->ior,
          t->roughness);
    if (const auto* d = std::get_if<DiffuseMaterial>(&material.kind)) add(d->color);
    if (const auto* e = std::get_if<EmissiveMaterial>(&material.kind)) add(e->radiance);
  }
  void add_object(const Object& object) {
    const Transform& t = object.transform;
    add("object", object.name, object.material, object.shape.index(), t.translate, t.rotate, t.scale);
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
      add((*mesh)->triangles.size(), signed_volume(**mesh), (*mesh)->positions.front());
  }

  std::ostringstream out_;
};

inline std::string dump(const Scene& scene) { return SceneDump(scene).text(); }

}  // namespace meander
