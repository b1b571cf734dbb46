#include "scene/precision.h"

#include <doctest/doctest.h>

using namespace meander;

namespace {

std::vector<std::string> warnings_of(const decltype(Object::shape)& shape, const Rgb& sigma,
                                     const Transform& transform) {
  Scene scene;
  scene.materials.push_back({"m", TranslucentMaterial{{sigma, Rgb(1), 0}, Boundary::matched, 1, 0}});
  scene.objects.push_back({"body", shape, 0, transform});
  return precision_warnings(scene);
}

}  // namespace

TEST_CASE("a mean free path below 5e-5 of the object's half size is named, in any channel, shape and size") {
  const auto mesh = std::make_shared<const Mesh>(make_torus_knot(40, 8));
  for (const double scale : {1e-4, 1.0, 1e5}) {
    const Transform transform{{3, 4, 5}, {}, {scale, 0.1 * scale, 0.2 * scale}};
    const auto sigma = static_cast<Real>(2e4 / scale);
    for (const auto& shape : {decltype(Object::shape)(SphereShape{}), decltype(Object::shape)(BoxShape{})}) {
      CHECK(warnings_of(shape, Rgb(sigma), transform).empty());
      CHECK(warnings_of(shape, Rgb(1, 1, 2) * sigma, transform).size() == 1);
    }
    CHECK(warnings_of(mesh, Rgb(Real(0.5) * sigma), transform).empty());
    CHECK(warnings_of(mesh, Rgb(2 * sigma), transform).size() == 1);
  }
  CHECK(warnings_of(SphereShape{}, Rgb(0), {}).empty());
  CHECK(
      warnings_of(SphereShape{}, Rgb(1e6), {}) ==
      std::vector<std::string>{"object 'body': a mean free path of 1e-06 of its half size is finite but not "
                               "accurate: single precision needs 5e-05 or more"});
}

TEST_CASE("an opaque object has no mean free path") {
  Scene scene;
  scene.materials.push_back({"m", DiffuseMaterial{}});
  scene.objects.push_back({"body", SphereShape{}, 0, {}});
  CHECK(precision_warnings(scene).empty());
}
