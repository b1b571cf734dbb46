#include <doctest/doctest.h>

#include <cmath>

#include "math/random.h"
#include "math/warp.h"
#include "trace/geometry.h"
#include "trace/overlaps.h"

using namespace meander;

namespace {

Material translucent(Boundary boundary, const Rgb& sigma_t) {
  return {"m", TranslucentMaterial{{sigma_t, Rgb(Real(0.9)), 0}, boundary}};
}

Scene one_object(const decltype(Object::shape)& shape, const Transform& transform, Boundary boundary) {
  Scene scene;
  scene.materials.push_back(translucent(boundary, Rgb(1, 2, 3)));
  scene.objects.push_back({"o", shape, 0, transform});
  return scene;
}

const auto kKnot = std::make_shared<const Mesh>(make_torus_knot(200, 24));

}  // namespace

TEST_CASE("a body far from the origin is hit exactly as at the origin, bit for bit") {
  const DVec3 shift(1 << 14, -(1 << 15), 1 << 14);
  const std::vector<decltype(Object::shape)> shapes{SphereShape{}, BoxShape{}, kKnot};
  for (const auto& shape : shapes) {
    const Geometry near_geometry(one_object(shape, {}, Boundary::matched), 1);
    const Geometry far_geometry(one_object(shape, {shift, DVec3(0), DVec3(1)}, Boundary::matched), 1);
    int hits = 0;
    for (std::uint32_t i = 0; i < 5000; ++i) {
      Random random = stream(1, 0, i);
      const double x = 2.4 * random.next() - 1.2;
      const double y = 2.4 * random.next() - 1.2;
      const Ray ray{
          {std::ldexp(std::round(std::ldexp(x, 20)), -20), std::ldexp(std::round(std::ldexp(y, 20)), -20), 5},
          {0, 0, -1}};
      const auto a = near_geometry.closest_hit(ray);
      const auto b = far_geometry.closest_hit({ray.origin + shift, ray.direction});
      REQUIRE(a.has_value() == b.has_value());
      if (!a) continue;
      ++hits;
      CHECK(a->point == b->point);
      CHECK(a->distance == b->distance);
    }
    CHECK(hits > 500);
  }
}

TEST_CASE("a camera ten thousand sizes away still hits a sphere's surface to the last digits") {
  const Geometry geometry(one_object(SphereShape{}, {}, Boundary::matched), 1);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    Random random = stream(2, 0, i);
    const double x = 1.8 * random.next() - 0.9;
    const DVec3 from(0, 0, 20000);
    const DVec3 target(x * 0.5, 0.3 * x, 0);
    const auto hit = geometry.closest_hit({from, Vec3(glm::normalize(target - from))});
    REQUIRE(hit);
    CHECK(glm::length(DVec3(hit->point)) == doctest::Approx(1).epsilon(3e-7));
    CHECK(hit->entering);
  }
}

TEST_CASE("transforms scale, rotate and move, in that order") {
  const Transform transform{{10, 0, 0}, {0, 0, 90}, {2, 1, 1}};
  const Geometry geometry(one_object(BoxShape{}, transform, Boundary::matched), 1);
  const auto hit = geometry.closest_hit({{10, 9, 0}, {0, -1, 0}});
  REQUIRE(hit);
  CHECK(hit->distance == doctest::Approx(7));  // the long axis, of half-length 2, now points along y
  CHECK(hit->normal.y == doctest::Approx(1));
  const auto side = geometry.closest_hit({{20, 0, 0}, {-1, 0, 0}});
  REQUIRE(side);
  CHECK(side->distance == doctest::Approx(9));
}

TEST_CASE("matched bodies let light through with their own transmittance, everything else stops it") {
  for (const decltype(Object::shape)& shape :
       std::vector<decltype(Object::shape)>{SphereShape{}, BoxShape{}, SlabShape{}}) {
    const Geometry matched(one_object(shape, {}, Boundary::matched), 1);
    const Geometry diffuse(one_object(shape, {}, Boundary::diffuse), 1);
    const Ray down{{0, 5, 0}, {0, -1, 0}};
    const Rgb through = matched.transmittance(down, std::numeric_limits<double>::infinity());
    for (int c = 0; c < 3; ++c) CHECK(through[c] == doctest::Approx(std::exp(-2.0 * (c + 1))).epsilon(1e-5));
    CHECK(matched.transmittance(down, 3.9) == Rgb(1));
    CHECK(matched.transmittance(down, 4.5).x == doctest::Approx(std::exp(-0.5)).epsilon(1e-5));
    CHECK(matched.transmittance({{0, 0, 0}, {0, 1, 0}}, 0.25).x ==
          doctest::Approx(std::exp(-0.25)).epsilon(1e-5));
    CHECK(diffuse.transmittance(down, 100) == Rgb(0));
    CHECK(diffuse.transmittance(down, 3.9) == Rgb(1));
    CHECK(diffuse.transmittance({{0, Real(1.000001), 0}, {0, 1, 0}}, 100) == Rgb(1));
  }
}

TEST_CASE("a concave mesh lets light through with the length inside it, wall by wall") {
  const Geometry geometry(one_object(kKnot, {}, Boundary::matched), 1);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    Random random = stream(3, 0, i);
    const Real u1 = random.next();
    const Real u2 = random.next();
    const Vec3 d = sample_sphere({u1, u2});
    const DVec3 from = DVec3(0.3, 0.1, 0.2) - 3.0 * DVec3(d);
    // The same length by marching from hit to hit.
    double inside = 0;
    double at = 0;
    double entered = 0;
    while (const auto hit = geometry.closest_hit({from + at * DVec3(d), d})) {
      if (hit->entering)
        entered = at + hit->distance;
      else
        inside += at + hit->distance - entered;
      at += hit->distance + 1e-6;
    }
    const Rgb through = geometry.transmittance({from, d}, std::numeric_limits<double>::infinity());
    CHECK(through.x == doctest::Approx(std::exp(-inside)).epsilon(1e-4));
  }
}

TEST_CASE("a ray that skims a mesh's rim never takes itself to be inside") {
  Geometry geometry(one_object(kKnot, {}, Boundary::matched), 1);
  int hits = 0;
  for (std::uint32_t i = 0; i < 300000; ++i) {
    Random random = stream(4, 0, i);
    // At corners and at the middles of edges, nearly tangentially: where a ray may slip between two
    // triangles.
    const Triangle& t = kKnot->triangles[random.next_bits() % kKnot->triangles.size()];
    const DVec3& a = kKnot->positions[t[0]];
    const DVec3& b = kKnot->positions[t[1]];
    const DVec3 target = random.next() < Real(0.5) ? a : 0.5 * (a + b);
    const Vec3 normal(glm::normalize(glm::cross(b - a, kKnot->positions[t[2]] - a)));
    const Real u1 = random.next();
    const Real u2 = random.next();
    const Vec3 any = sample_sphere({u1, u2});
    const Vec3 d = glm::normalize(any - (1 - Real(1e-3) * random.next()) * glm::dot(any, normal) * normal);
    const auto hit = geometry.closest_hit({target - 4.0 * DVec3(d), d});
    if (!hit) continue;
    ++hits;
    REQUIRE(hit->entering);
  }
  CHECK(hits > 100000);
}

TEST_CASE("a camera inside a body sees its far side") {
  for (const auto& shape : std::vector<decltype(Object::shape)>{SphereShape{}, BoxShape{}, kKnot}) {
    const Geometry geometry(one_object(shape, {}, Boundary::matched), 1);
    const auto hit = geometry.closest_hit({{0.8, 0, 0}, {0, 0, 1}});
    REQUIRE(hit);
    CHECK_FALSE(hit->entering);
  }
}

TEST_CASE("a ray off the inner side of a convex body meets it again, one off its outer side does not") {
  const Transform turned{{3, -2, 7}, {20, 30, 40}, {1, 0.5, 2}};
  for (const auto& shape : std::vector<decltype(Object::shape)>{SphereShape{}, BoxShape{}, SlabShape{}})
    for (const double side : {1.0, -1.0}) {
      Scene scene = one_object(shape, turned, Boundary::matched);
      scene.materials[0].kind = DiffuseMaterial{};
      const Geometry geometry(scene, 1);
      const DVec3& center = turned.translate;
      const DVec3 up = linear_part(turned)[1];
      const auto seen = geometry.closest_hit({center + (side > 0 ? 3.0 : 0.0) * up, Vec3(-side * up)});
      REQUIRE(seen);
      CHECK(seen->entering == (side > 0));
      const Vec3 normal = static_cast<Real>(side) * seen->normal;
      const Departure departure{0, geometry.offset(0, seen->point) * normal};
      CHECK(geometry.closest_hit({center + DVec3(seen->point), normal, departure}).has_value() == (side < 0));
    }
}

TEST_CASE("an unbounded slab is met far from its middle, on its very face") {
  const Geometry geometry(one_object(SlabShape{}, {{0, -1, 0}, DVec3(0), DVec3(1)}, Boundary::diffuse), 1);
  const auto hit = geometry.closest_hit({{0, 1, 0}, glm::normalize(Vec3(1, Real(-1e-4), 0))});
  REQUIRE(hit);
  CHECK(hit->point.y == 1);
  CHECK(hit->distance == doctest::Approx(1e4).epsilon(1e-3));
}

TEST_CASE("bodies that overlap or nest are named, bodies that touch or stand apart are not") {
  const auto count = [](const decltype(Object::shape)& shape, const DVec3& shift, double scale) {
    Scene scene = one_object(SphereShape{}, {}, Boundary::matched);
    scene.objects.push_back({"second", shape, 0, {shift, DVec3(0), DVec3(scale)}});
    return overlap_warnings(scene, Geometry(scene, 1)).size();
  };
  CHECK(count(SphereShape{}, {1.5, 0, 0}, 1) == 1);
  CHECK(count(SphereShape{}, {0.1, 0, 0}, 0.3) == 1);
  CHECK(count(BoxShape{}, {0, 1.5, 0}, 1) == 1);
  CHECK(count(kKnot, {0, 0, 0}, 1) == 1);
  CHECK(count(SphereShape{}, {2, 0, 0}, 1) == 0);
  CHECK(count(BoxShape{}, {0, 2, 0}, 1) == 0);
  CHECK(count(kKnot, {0, 3, 0}, 1) == 0);
}

TEST_CASE(
    "an edit shares the hierarchies of the meshes that stand as they stood, and outlives the geometry "
    "before") {
  Scene scene = one_object(kKnot, {}, Boundary::matched);
  scene.objects.push_back({"twin", kKnot, 0, {{4, 0, 0}, {}, DVec3(1)}});
  auto before = std::make_unique<const Geometry>(scene, 1);
  const auto body_of = [](const Geometry& geometry, std::size_t object) {
    return geometry.with_body(object, [](const auto& world) { return static_cast<const void*>(&world); });
  };
  const void* const body = body_of(*before, 0);
  CHECK(body_of(*before, 1) == body);

  Scene edited = scene;
  edited.objects[0].transform.translate = {0, 3, 0};             // a move is no new hierarchy
  edited.objects[1].transform.rotate = {0, 30, 0};               // a turn is one
  edited.materials[0] = translucent(Boundary::diffuse, Rgb(5));  // and the flags are the new scene's
  const Geometry after(edited, 1, before.get());
  const Geometry fresh(edited, 1);
  CHECK(body_of(after, 0) == body);
  CHECK(body_of(after, 1) != body);
  before.reset();
  int hits = 0;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    Random random = stream(9, 0, i);
    const double x = 7 * random.next() - 1.5;
    const double y = 5.5 * random.next() - 1.25;
    const Ray ray{{x, y, 5}, {0, 0, -1}};
    const auto a = after.closest_hit(ray);
    const auto b = fresh.closest_hit(ray);
    REQUIRE(a.has_value() == b.has_value());
    CHECK(after.transmittance(ray, 10) == fresh.transmittance(ray, 10));
    if (!a) continue;
    ++hits;
    CHECK(a->object == b->object);
    CHECK(a->distance == b->distance);
    CHECK(a->point == b->point);
    CHECK(a->shading_normal == b->shading_normal);
  }
  CHECK(hits > 100);

  edited.objects[0].shape = std::make_shared<const Mesh>(*kKnot);  // an equal mesh, but another one
  const Geometry replaced(edited, 1, &after);
  CHECK(body_of(replaced, 0) != body);
}
