#include "scene/scene_digest.h"

#include "core/digest.h"

namespace meander {
namespace {

template <class... Values>
void add_all(Digest& digest, const Values&... values) {
  (digest.add(values), ...);
}

template <class Element>
void add_list(Digest& digest, const std::vector<Element>& list) {
  digest.add(std::as_bytes(std::span(list)));
}

void add(Digest& digest, const Camera& c) {
  add_all(digest, c.look_from, c.look_at, c.up, c.orthographic_height.has_value(),
          c.orthographic_height.value_or(c.vertical_fov));
}

void add(Digest& digest, const Environment& environment) {
  add_all(digest, environment.visible, environment.image != nullptr);
  if (environment.image)
    digest.add(environment.image->digest());
  else
    digest.add(environment.radiance);
}

void add(Digest& digest, const RectangleLight& l) {
  add_all(digest, l.center, l.look_at, l.up, l.width, l.height, l.radiance);
}
void add(Digest& digest, const SphereLight& l) { add_all(digest, l.center, l.radius, l.radiance); }
void add(Digest& digest, const PointLight& l) { add_all(digest, l.position, l.intensity); }
void add(Digest& digest, const DirectionalLight& l) { add_all(digest, l.direction, l.irradiance); }

void add(Digest& digest, const TranslucentMaterial& m) {
  add_all(digest, m.medium.sigma_t, m.medium.albedo, m.medium.g, m.boundary, m.ior, m.roughness);
}
void add(Digest& digest, const DiffuseMaterial& m) { digest.add(m.color); }
void add(Digest& digest, const EmissiveMaterial& m) { digest.add(m.radiance); }

void add(Digest&, const SphereShape&) {}
void add(Digest&, const BoxShape&) {}
void add(Digest&, const SlabShape&) {}
void add(Digest& digest, const std::shared_ptr<const Mesh>& mesh) {
  add_list(digest, mesh->positions);
  add_list(digest, mesh->triangles);
  add_list(digest, mesh->normals);
  add_list(digest, mesh->normal_triangles);
}

template <class Variant>
void add_variant(Digest& digest, const Variant& variant) {
  digest.add(variant.index());
  std::visit([&](const auto& value) { add(digest, value); }, variant);
}

}  // namespace

std::uint64_t digest_of(const Scene& scene) {
  Digest digest;
  add(digest, scene.camera);
  add_all(digest, scene.film.width, scene.film.height);
  add(digest, scene.environment);
  digest.add(scene.lights.size());
  for (const Light& light : scene.lights) {
    digest.add(light.visible);
    add_variant(digest, light.shape);
  }
  digest.add(scene.materials.size());
  for (const Material& material : scene.materials) add_variant(digest, material.kind);
  digest.add(scene.objects.size());
  for (const Object& object : scene.objects) {
    add_all(digest, object.material, object.transform.translate, object.transform.rotate,
            object.transform.scale);
    add_variant(digest, object.shape);
  }
  return digest.value();
}

}  // namespace meander
