#include "math/rough_dielectric.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "math/frame.h"
#include "math/fresnel.h"
#include "math/ggx.h"
#include "math/warp.h"
#include "single_facet.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/moments.h"
#include "support/check_sampler.h"

namespace meander {
namespace {

constexpr Real kAlphas[] = {kLeastGgxAlpha, Real(0.01), Real(0.1), Real(0.3), Real(0.7), Real(1)};
constexpr Real kIndices[] = {Real(1.33), Real(1.5), Real(1 / 1.5)};
constexpr double kAngles[] = {0, 45, 80, 89, 91, 110, 150, 180};  // above 90 from inside

Vec3 travel(double degrees, double azimuth = 0) {
  const double angle = degrees * kDoublePi / 180;
  const double sine = std::abs(std::sin(angle));
  return {static_cast<Real>(sine * std::cos(azimuth)), static_cast<Real>(sine * std::sin(azimuth)),
          static_cast<Real>(-std::cos(angle))};
}

std::string name_of(const RoughDielectric& r, double degrees) {
  return "alpha " + std::to_string(r.alpha) + " eta " + std::to_string(r.eta) + " at " +
         std::to_string(degrees);
}

template <class Visit>
void for_each_case(const Visit& visit) {
  for (const Real alpha : kAlphas) {
    for (const Real eta : kIndices) {
      for (const double degrees : kAngles) visit(RoughDielectric{alpha, eta}, degrees);
    }
  }
}

}  // namespace

TEST_CASE("Everything that arrives leaves, on the side it says, from every direction") {
  for (const Real alpha : {kLeastGgxAlpha, Real(0.01), Real(0.3), Real(1)}) {
    for (const Real eta : {Real(1), Real(1.0001), Real(1.33), Real(1.5), Real(3), Real(1 / 1.5)}) {
      for (const double degrees : {0.0, 30.0, 80.0, 89.0, 89.99, 90.0, 90.01, 91.0, 120.0, 180.0}) {
        const RoughDielectric surface{alpha, eta};
        Vec3 incoming = travel(degrees);
        if (degrees == 90) incoming.z = 0;
        Random random = stream(21, 0, 0);
        bool sound = true;
        for (int i = 0; i < 2000; ++i) {
          const InterfaceSample s = sample_rough_dielectric(surface, incoming, random);
          const bool outside = incoming.z <= 0;
          sound = sound && std::abs(glm::length(s.direction) - 1) < 2 * kRealEpsilon &&
                  (s.collisions == 0) == (eta == 1) &&
                  (eta == 1 || (s.direction.z != 0 && (s.direction.z > 0) == (s.transmitted != outside)));
          const Real value = eval_rough_dielectric(surface, incoming, s.direction, random);
          const Real weight = weigh_rough_dielectric(surface, incoming, s.direction, 1, random);
          const bool narrow = std::abs(eta - 1) < Real(1e-3);
          sound = sound && std::isfinite(value) && value >= 0 && std::isfinite(weight) && weight >= 0 &&
                  s.density > 0 && std::isinf(s.density) == narrow && !(narrow && (value > 0 || weight > 0));
        }
        INFO(name_of(surface, degrees));
        CHECK(sound);
      }
    }
  }
}

TEST_CASE("Samples follow what is evaluated, cell by cell, from both sides") {
  // What sampling leaves to the other technique is what that one brings, direction by direction.
  constexpr int kCount = 100'000;
  TestFamily family;
  for_each_case([&](const RoughDielectric& surface, double degrees) {
    const Arrival at(surface, travel(degrees));
    Random random = stream(22, static_cast<std::uint32_t>(degrees), 0);
    Cells left, brought;
    for (int i = 0; i < kCount; ++i) {
      const InterfaceSample s = sample_rough_dielectric(surface, at.incoming, random);
      const double p = proposal_density(at, s.direction);
      left.add(cell_of(at, s.direction), p / (p + s.density));
      const Proposal other = propose(at, random);
      if (!other.usable) continue;
      const auto density = static_cast<Real>(other.density);
      brought.add(cell_of(at, other.direction),
                  weigh_rough_dielectric(surface, at.incoming, other.direction, density, random));
    }
    family.add(name_of(surface, degrees), same_cells_p(left, brought));
  });
  family.check();
}

TEST_CASE("Evaluation integrates to 1 over both sides") {
  constexpr int kCount = 100'000;
  TestFamily family;
  for_each_case([&](const RoughDielectric& surface, double degrees) {
    const Arrival at(surface, travel(degrees));
    Random random = stream(30, static_cast<std::uint32_t>(degrees), 0);
    Moments total;
    for (int i = 0; i < kCount; ++i) {
      const Proposal p = propose(at, random);
      const double value =
          p.usable ? eval_rough_dielectric(surface, at.incoming, p.direction, random) / p.density : 0;
      total.add(value);
    }
    family.add(name_of(surface, degrees), two_sided_p(z_score(total.mean, 1, total.standard_error())));
  });
  family.check();
}

TEST_CASE("A light's weight is the evaluation over its density, where sampling would never find it") {
  for (const double out : {20.0, 80.0, 110.0, 170.0}) {
    const RoughDielectric surface{Real(0.7), Real(1.5)};
    const Real large = Real(1e12);
    for (std::uint32_t i = 0; i < 100; ++i) {
      Random one = stream(31, i, 0);
      Random other = stream(31, i, 0);
      const Real value = eval_rough_dielectric(surface, travel(50), travel(out, 1), one);
      const Real weight = weigh_rough_dielectric(surface, travel(50), travel(out, 1), large, other);
      CHECK(weight * large == doctest::Approx(value).epsilon(1e-5));
    }
  }
}

TEST_CASE("What meets one facet is what the height-correlated Smith quadrature says") {
  constexpr int kCount = 200'000;
  TestFamily family;
  for_each_case([&](const RoughDielectric& surface, double degrees) {
    const Arrival at(surface, travel(degrees));
    const auto expected = single_facet_fractions(surface.alpha, at.eta, at.away());
    std::array<int, 2> counts{};
    Random random = stream(23, static_cast<std::uint32_t>(degrees), 0);
    for (int i = 0; i < kCount; ++i) {
      const InterfaceSample s = sample_rough_dielectric(surface, at.incoming, random);
      if (s.collisions == 1) ++counts[s.transmitted];
    }
    for (const int through : {0, 1}) {
      const double p = expected[through];
      const double measured = double(counts[through]) / kCount;
      // A few counts have no normal law, and 2e-5 is what the quadrature leaves at its kinks.
      if (p * kCount < 25 || (1 - p) * kCount < 25) {
        INFO(name_of(surface, degrees), ": ", measured, " for ", p);
        CHECK(std::abs(measured - p) < 50.0 / kCount);
        continue;
      }
      const double error = std::sqrt(p * (1 - p) / kCount) + 2e-5;
      family.add(name_of(surface, degrees) + (through ? " through" : " back"),
                 two_sided_p(z_score(measured, p, error)));
    }
  });
  family.check();
}

TEST_CASE("As the roughness vanishes the interface is Fresnel's and Snell's") {
  constexpr int kCount = 100'000;
  TestFamily family;
  for (const Real eta : kIndices) {
    for (const double degrees : {0.0, 45.0, 80.0, 110.0, 150.0, 180.0}) {
      const Arrival at({kLeastGgxAlpha, eta}, travel(degrees));
      const DVec3 away = at.away();
      const Fresnel f = eval_fresnel(static_cast<Real>(away.z), static_cast<Real>(at.eta));
      Random random = stream(24, static_cast<std::uint32_t>(degrees), 0);
      int reflected = 0, astray = 0;
      for (int i = 0; i < kCount; ++i) {
        const InterfaceSample s = sample_rough_dielectric(at.surface, at.incoming, random);
        reflected += !s.transmitted;
        const DVec3 ideal = s.transmitted ? DVec3(-away.x / at.eta, -away.y / at.eta, -f.cos_t)
                                          : DVec3(-away.x, -away.y, away.z);
        // Slopes have the tail P(> t alpha) = 1 / (1 + t^2), which bending and grazing widen a few times.
        astray += glm::distance(at.local(s.direction), ideal) > 300 * kLeastGgxAlpha;
      }
      const double expected = f.reflectance;
      CAPTURE(degrees);
      CHECK(astray < 200);
      if (expected == 1) {
        CHECK(reflected == kCount);
      } else {
        const double error = std::sqrt(expected * (1 - expected) / kCount);
        family.add(name_of(at.surface, degrees),
                   two_sided_p(z_score(double(reflected) / kCount, expected, error)));
      }
    }
  }
  family.check();
}

TEST_CASE("Equal indices let light straight through a rough interface") {
  for (const double degrees : {0.0, 60.0, 89.0, 91.0, 150.0}) {
    const Vec3 incoming = travel(degrees, 0.5);
    Random random = stream(25, 0, 0);
    bool straight = true;
    for (int i = 0; i < 20'000; ++i) {
      const InterfaceSample s = sample_rough_dielectric({Real(0.7), 1}, incoming, random);
      straight = straight && s.transmitted && glm::distance(s.direction, incoming) < Real(1e-5);
    }
    CAPTURE(degrees);
    CHECK(straight);
  }
}

TEST_CASE("Reversed light carries the same power over the square of the index") {
  constexpr int kCount = 200'000;
  TestFamily family;
  for (const Real alpha : {Real(0.3), Real(1)}) {
    const RoughDielectric surface{alpha, Real(1.5)};
    for (const double in : {30.0, 75.0, 140.0}) {
      for (const double out : {20.0, 80.0, 110.0, 170.0}) {
        const Vec3 incoming = travel(in);
        const Vec3 outgoing = travel(out, 2.5);
        std::array<Moments, 2> ways;
        Random random = stream(26, 0, 0);
        for (int i = 0; i < kCount; ++i) {
          ways[0].add(eval_rough_dielectric(surface, incoming, outgoing, random));
          ways[1].add(eval_rough_dielectric(surface, -outgoing, -incoming, random));
        }
        const double index_in = incoming.z < 0 ? 1 : double{surface.eta};
        const double index_out = outgoing.z > 0 ? 1 : double{surface.eta};
        const double there = index_in * index_in * std::abs(incoming.z);
        const double back = index_out * index_out * std::abs(outgoing.z);
        family.add(name_of(surface, in) + " to " + std::to_string(out),
                   two_sided_p(two_sample_z(there * ways[0].mean, there * ways[0].standard_error(),
                                            back * ways[1].mean, back * ways[1].standard_error())));
      }
    }
  }
  family.check();
}

TEST_CASE("Diffuse light in equilibrium on both sides stays so: eta^2 inside to 1 outside, cosine on both") {
  constexpr int kCount = 300'000;
  TestFamily family;
  for (const Real alpha : kAlphas) {
    for (const Real eta : kIndices) {
      Random random = stream(27, 0, 0);
      const Real inside = eta * eta / (1 + eta * eta);
      std::array<std::vector<double>, 2> cdf;
      for (int i = 0; i < kCount; ++i) {
        const Real first = random.next();
        Vec3 incoming = sample_cosine_hemisphere({first, random.next()});
        if (random.next() >= inside) incoming.z = -incoming.z;
        const Vec3 out = sample_rough_dielectric({alpha, eta}, incoming, random).direction;
        cdf[out.z > 0].push_back(double{out.z} * out.z);
      }
      const std::string name = name_of({alpha, eta}, 0);
      const double error = std::sqrt(double{inside} * (1 - inside) / kCount);
      family.add(name + " fraction",
                 two_sided_p(z_score(double(cdf[0].size()) / kCount, double{inside}, error)));
      for (auto& values : cdf) {
        std::sort(values.begin(), values.end());
        family.add(name + " cosine", kolmogorov_smirnov(values).p);
      }
    }
  }
  family.check();
}

TEST_CASE("A light found by its own samples, by the interface's and by both gives one and the same") {
  // Uniform light of a cone about an axis; the fraction of the power that leaves into it.
  constexpr int kCount = 200'000;
  const Real one_minus_cos = Real(0.05);
  const Real p = pdf_cone(one_minus_cos);
  TestFamily family;
  for (const Real alpha : {Real(0.05), Real(0.3), Real(1)}) {
    for (const double degrees : {40.0, 85.0, 150.0}) {
      const RoughDielectric surface{alpha, Real(1.4)};
      const Vec3 incoming = travel(degrees);
      Vec3 to_light = incoming;  // near the mirror direction
      to_light.z = -to_light.z + Real(0.1);
      const Frame frame = make_frame(glm::normalize(to_light));
      Moments light_alone, found_alone, both;
      Random random = stream(28, 0, 0);
      for (int i = 0; i < kCount; ++i) {
        const Real first = random.next();
        const Vec3 o = frame.to_world(sample_cone(one_minus_cos, {first, random.next()}));
        light_alone.add(eval_rough_dielectric(surface, incoming, o, random) / p);
        const InterfaceSample s = sample_rough_dielectric(surface, incoming, random);
        const bool found = glm::dot(s.direction, frame.normal) > 1 - one_minus_cos;
        found_alone.add(found ? 1 : 0);
        both.add(weigh_rough_dielectric(surface, incoming, o, p, random) +
                 (found ? 1 / (1 + p / s.density) : 0));
      }
      const std::string name = name_of(surface, degrees);
      family.add(name + " light", two_sided_p(two_sample_z(light_alone.mean, light_alone.standard_error(),
                                                           both.mean, both.standard_error())));
      family.add(name + " found", two_sided_p(two_sample_z(found_alone.mean, found_alone.standard_error(),
                                                           both.mean, both.standard_error())));
      CAPTURE(name);
      CHECK(both.standard_error() < 1.1 * found_alone.standard_error());
    }
  }
  family.check();
}

}  // namespace meander
