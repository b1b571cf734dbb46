#include "stability/exact/exact_cases.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meander {
namespace {

constexpr std::array<double, 7> kAllG{0, 1e-7, -1e-7, 0.999, -0.999, 0.9999, -0.9999};
constexpr std::array<double, 4> kSomeG{0, -1e-7, 0.999, -0.9999};
constexpr std::array<ExactShape, 2> kBodies{ExactShape::slab, ExactShape::sphere};
constexpr double kNearlyWhite = 1 - 1e-6;

double as_float(double x) { return static_cast<double>(static_cast<float>(x)); }

struct Cases {
  std::vector<ExactCase> all;

  void add(ExactCase of) {
    for (int c = 0; c < 3; ++c) of.sigma_t[c] = as_float(of.sigma_t[c]);
    of.albedo = as_float(of.albedo);
    of.g = as_float(of.g);
    all.push_back(of);
  }
};

void add_bodies(Cases& cases) {
  for (const ExactShape shape : kBodies)
    for (const double free_path : {1e-2, 1.0})
      for (const double albedo : {1.0, kNearlyWhite}) {
        for (const double g : kAllG) cases.add({ExactKind::whole, shape, DVec3(1 / free_path), albedo, g});
        for (const double g : {0.0, 0.999, -0.9999})
          cases.add({ExactKind::whole, shape, DVec3(1 / free_path), albedo, g, Boundary::dielectric, 1.5});
      }
  for (const ExactShape shape : kBodies) {
    for (const double g : {0.0, 0.999}) cases.add({ExactKind::whole, shape, DVec3(1e4), 0.999, g});
    for (const double ior : {1.0, 1.5})
      cases.add({ExactKind::whole, shape, DVec3(1), 1, 0, Boundary::diffuse, ior});
    cases.add({ExactKind::whole, shape, DVec3(1e-2), 1, 0, Boundary::dielectric, 1.5});
  }
}

void add_half_spaces(Cases& cases) {
  for (const double g : {0.0, 1e-7, -1e-7, -0.999, -0.9999})
    cases.add({ExactKind::whole, ExactShape::half_space, DVec3(1), kNearlyWhite, g});
  for (const double g : {0.999, 0.9999})
    cases.add({ExactKind::whole, ExactShape::half_space, DVec3(1), 0.999, g});
  cases.add({ExactKind::whole, ExactShape::half_space, DVec3(1), 0.999, 0, Boundary::dielectric, 1.5});
  for (const double g : kAllG) cases.add({ExactKind::capped, ExactShape::half_space, DVec3(1), 1, g});
  for (const ExactShape shape : kBodies)
    for (const double g : kSomeG) cases.add({ExactKind::capped, shape, DVec3(1e4), 1, g});
}

void add_thin_and_chromatic(Cases& cases) {
  for (const ExactShape shape : kBodies)
    for (const double free_path : {1e2, 1e4, 1e6})
      for (const double g : kSomeG) {
        cases.add({ExactKind::thin, shape, DVec3(1 / free_path), 1, g});
        if (g == 0) cases.add({ExactKind::whole, shape, DVec3(1 / free_path), 1, g});
      }
  for (const ExactShape shape : kBodies)
    for (const DVec3& sigma_t : {DVec3(1e2, 1, 1e-2), DVec3(1e4, 1e2, 1), DVec3(1, 1e-4, 1e-4)})
      for (const double g : {0.0, 0.9}) cases.add({ExactKind::chromatic, shape, sigma_t, 0.9, g});
}

double chord_of(ExactShape shape) { return shape == ExactShape::sphere ? 4.0 / 3 : 2; }

double steps_of(const ExactCase& of, double sigma) {
  if (of.kind == ExactKind::thin) return 3;
  if (of.kind == ExactKind::capped) return std::abs(of.g) < 0.9 || of.g < 0 ? 80 : 1024;
  const double index = of.ior * of.ior;
  const double absorbing = 2.3 / std::sqrt((1 - of.albedo) * (1 - of.g)) + 10;
  const double crossing = of.shape == ExactShape::half_space ? absorbing : sigma * chord_of(of.shape);
  return index * std::min(crossing, absorbing) + 3;
}

std::string_view name_of(ExactShape shape) {
  constexpr std::array<std::string_view, 3> kNames{"slab", "half_space", "sphere"};
  return kNames[static_cast<std::size_t>(shape)];
}

std::string_view name_of(Boundary boundary) {
  constexpr std::array<std::string_view, 3> kNames{"matched", "diffuse", "dielectric"};
  return kNames[static_cast<std::size_t>(boundary)];
}

}  // namespace

std::vector<ExactCase> exact_cases() {
  Cases cases;
  add_bodies(cases);
  add_half_spaces(cases);
  add_thin_and_chromatic(cases);
  return cases.all;
}

std::string describe(const ExactCase& of) {
  std::ostringstream text;
  text.precision(9);
  text << name_of(of.shape) << ',' << of.sigma_t.x;
  if (of.kind == ExactKind::chromatic) text << ' ' << of.sigma_t.y << ' ' << of.sigma_t.z;
  text << ',' << of.albedo << ',' << of.g << ',' << of.ior << ',' << name_of(of.boundary);
  return text.str();
}

std::uint64_t walks_within(const ExactCase& of, double steps) {
  const double a_walk =
      (steps_of(of, of.sigma_t.x) + steps_of(of, of.sigma_t.y) + steps_of(of, of.sigma_t.z)) / 3;
  return static_cast<std::uint64_t>(std::max(steps / a_walk, 100.0));
}

std::optional<double> exact_value(const ExactCase& of, std::string_view quantity) {
  if (quantity == "scattered") {
    const double tau = of.sigma_t.x * (of.shape == ExactShape::sphere ? 2 : 1);
    return -std::expm1(-tau) / tau;
  }
  if (of.albedo != 1 || of.kind != ExactKind::whole) return std::nullopt;
  if (quantity == "escaped") return 1;
  if (quantity == "path") return chord_of(of.shape) * of.ior * of.ior;
  return std::nullopt;
}

}  // namespace meander
