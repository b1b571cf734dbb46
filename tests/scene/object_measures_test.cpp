#include "scene/object_measures.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace meander;

namespace {

using MeshPointer = std::shared_ptr<const Mesh>;

template <class Shape>
Object object_of(const Shape& shape, const DVec3& scale = DVec3(1), const DVec3& rotate = DVec3(0)) {
  return {"object", shape, 0, {{5, -3, 2}, rotate, scale}};
}

MeshPointer sphere_mesh(int splits) { return std::make_shared<const Mesh>(make_sphere_mesh(splits)); }

// A box of [-1, 1]^3 with each face in two triangles.
MeshPointer box_mesh() {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return std::make_shared<const Mesh>(std::move(mesh));
}

void check_close(const DVec3& a, const DVec3& b, double tolerance) {
  CHECK(glm::distance(a, b) <= tolerance);
}

const DVec3 kTurn(20, -35, 70);

}  // namespace

TEST_CASE("the mean chord of the unit shapes") {
  CHECK(mean_chord(object_of(SphereShape{})) == doctest::Approx(4.0 / 3).epsilon(1e-14));
  CHECK(mean_chord(object_of(BoxShape{})) == doctest::Approx(4.0 / 3).epsilon(1e-14));
  CHECK(mean_chord(object_of(SlabShape{}, {7, 0.25, 9}, kTurn)) == doctest::Approx(1));
  CHECK(mean_chord(object_of(SphereShape{}, DVec3(3), kTurn)) == doctest::Approx(4).epsilon(1e-14));
  // 4 V / S of a box of sides 2, 4, 6: 4 * 48 / 88.
  CHECK(mean_chord(object_of(BoxShape{}, {1, 2, 3}, kTurn)) == doctest::Approx(4 * 48.0 / 88).epsilon(1e-14));
}

TEST_CASE("the mean chord of ellipsoids, against closed forms and meshes") {
  // Prolate spheroid of semi-axes 1, 1, 2: S = 2 pi (1 + 2 asin(e) / e), e = sqrt(3)/2; V = 8/3 pi.
  const double e = std::sqrt(3.0) / 2;
  const double prolate = 4 * (8.0 / 3) / (2 * (1 + 2 * std::asin(e) / e));
  CHECK(mean_chord(object_of(SphereShape{}, {1, 2, 1})) == doctest::Approx(prolate).epsilon(1e-12));
  CHECK(mean_chord(object_of(SphereShape{}, {2, 1, 1})) == doctest::Approx(prolate).epsilon(1e-12));
  // Oblate of 2, 2, 1: S = 2 pi 4 (1 + (1 - e^2)/e atanh(e)).
  const double oblate = 4 * (16.0 / 3) / (8 * (1 + (1 - e * e) / e * std::atanh(e)));
  CHECK(mean_chord(object_of(SphereShape{}, {2, 1, 2})) == doctest::Approx(oblate).epsilon(1e-12));
  CHECK(mean_chord(object_of(SphereShape{}, {1, 1 + 1e-9, 1})) == doctest::Approx(4.0 / 3).epsilon(1e-8));
  const double mesh = mean_chord(object_of(sphere_mesh(60), {0.5, 1, 3}, kTurn));
  CHECK(mean_chord(object_of(SphereShape{}, {0.5, 1, 3})) == doctest::Approx(mesh).epsilon(2e-3));
}

TEST_CASE("the mean chord of meshes goes with the transform; an open one has the shortest side") {
  CHECK(mean_chord(object_of(box_mesh())) == doctest::Approx(4.0 / 3).epsilon(1e-14));
  CHECK(mean_chord(object_of(box_mesh(), {1, 2, 3}, kTurn)) ==
        doctest::Approx(mean_chord(object_of(BoxShape{}, {1, 2, 3}))).epsilon(1e-12));
  Mesh open = *box_mesh();
  open.triangles.pop_back();
  CHECK(mean_chord(object_of(std::make_shared<const Mesh>(open), {1, 2, 3})) == doctest::Approx(2));
}

TEST_CASE("world bounds and the bounding radius, exact and turned") {
  const Bounds sphere = world_bounds(object_of(SphereShape{}, {1, 2, 3}, {0, 0, 90}));
  check_close(sphere.low, DVec3(5 - 2, -3 - 1, 2 - 3), 1e-12);
  check_close(sphere.high, DVec3(5 + 2, -3 + 1, 2 + 3), 1e-12);
  const double root = std::sqrt(2.0);
  const Bounds box = world_bounds(object_of(BoxShape{}, DVec3(1), {0, 45, 0}));
  check_close(box.high, DVec3(5 + root, -2, 2 + root), 1e-12);
  const Bounds mesh = world_bounds(object_of(box_mesh(), DVec3(1), {0, 45, 0}));
  check_close(mesh.low, box.low, 1e-12);
  check_close(mesh.high, box.high, 1e-12);
  CHECK(bounding_radius(object_of(SphereShape{}, {1, 4, 3}, kTurn)) == 4);
  CHECK(bounding_radius(object_of(BoxShape{}, {2, 3, 6}, kTurn)) == doctest::Approx(7));
  CHECK(bounding_radius(object_of(box_mesh(), {2, 3, 6}, kTurn)) == doctest::Approx(7).epsilon(1e-12));
  CHECK(bounding_radius(object_of(sphere_mesh(20), DVec3(2), kTurn)) == doctest::Approx(2).epsilon(1e-2));
}

TEST_CASE("the subject is what is translucent, without the floor") {
  Scene scene;
  CHECK(subject_bounds(scene).high == DVec3(1));
  scene.materials = {{"floor", DiffuseMaterial{}}, {"wax", TranslucentMaterial{}}};
  Object floor{"floor", SlabShape{}, 0, {{0, -9, 0}, DVec3(0), DVec3(4)}};
  scene.objects = {floor};
  CHECK(subject_bounds(scene).low == DVec3(-4, -13, -4));
  Object statue{"statue", BoxShape{}, 0, {{20, 0, 0}, DVec3(0), DVec3(1)}};
  scene.objects.push_back(statue);
  CHECK(subject_bounds(scene).low == DVec3(19, -1, -1));
  Object sheet = floor;
  sheet.material = 1;
  scene.objects.push_back(sheet);
  CHECK(subject_bounds(scene).low == DVec3(-4, -13, -4));
  Object ball{"ball", SphereShape{}, 1, {{0, 0, 3}, DVec3(0), DVec3(2)}};
  scene.objects.push_back(ball);
  ball.transform.translate.x = 10;
  scene.objects.push_back(ball);
  CHECK(subject_bounds(scene).low == DVec3(-2, -2, 1));
  CHECK(subject_bounds(scene).high == DVec3(12, 2, 5));
}
