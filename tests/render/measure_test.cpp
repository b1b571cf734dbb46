#include <doctest/doctest.h>

#include "medium/color_map.h"
#include "render/measure.h"
#include "stats/hypothesis.h"

using namespace meander;

namespace {

const std::atomic<bool> kRun{false};

}  // namespace

TEST_CASE("van de Hulst's slab is measured within its error bars, by both estimators") {
  MeasureJob job;
  job.shape = MeasuredSlab{2};
  job.g = 0.75;
  job.walks = 400000;
  job.threads = 2;
  Measurement results[2];
  for (const Estimator estimator : {Estimator::implicit, Estimator::analog}) {
    job.estimator = estimator;
    const Measurement m = measure(job, kRun);
    results[estimator == Estimator::analog] = m;
    CHECK(m.walks == job.walks);
    CHECK(std::abs(z_score(m.reflectance.mean, 0.0973946387, m.reflectance.standard_error())) < 4);
    CHECK(std::abs(z_score(m.transmittance.mean, 0.6609577002, m.transmittance.standard_error())) < 4);
    CHECK(std::abs(z_score(m.unscattered_transmittance.mean, std::exp(-2.0),
                           m.unscattered_transmittance.standard_error())) < 4);
    CHECK(std::abs(m.absorptance.mean - 0.1 * m.mean_path_length.mean) <
          4 * std::hypot(m.absorptance.standard_error(), 0.1 * m.mean_path_length.standard_error()));
    const double sum = m.reflectance.mean + m.transmittance.mean + m.absorptance.mean;
    CHECK(sum == doctest::Approx(1).epsilon(1e-3));
  }
  CHECK(results[0].transmittance.standard_error() < results[1].transmittance.standard_error());
}

TEST_CASE("a measurement depends on its seed, not on its threads") {
  MeasureJob job;
  job.shape = MeasuredSphere{3};
  job.incidence = {true, 1};
  job.walks = 50000;
  job.threads = 1;
  const Measurement one = measure(job, kRun);
  job.threads = 3;
  const Measurement three = measure(job, kRun);
  CHECK(one.reflectance.mean == three.reflectance.mean);
  CHECK(one.reflectance.m2 == three.reflectance.m2);
  CHECK(one.steps == three.steps);
  job.seed = 1;
  CHECK(measure(job, kRun).reflectance.mean != one.reflectance.mean);
}

TEST_CASE("the mean path in a sphere without absorption is 4/3 of its optical radius") {
  MeasureJob job;
  job.shape = MeasuredSphere{10};
  job.albedo = 1;
  job.incidence = {true, 1};
  job.walks = 200000;
  job.threads = 2;
  const Measurement m = measure(job, kRun);
  CHECK(std::abs(z_score(m.mean_path_length.mean, 40.0 / 3, m.mean_path_length.standard_error())) < 4);
  CHECK(m.reflectance.mean == doctest::Approx(1));
}

TEST_CASE("a walk of a million steps loses none of its length, whoever walks it") {
  MeasureJob job;
  job.shape = MeasuredSlab{1e5};
  job.albedo = 1;
  job.walks = 200;
  job.threads = 1;
  job.seed = 1;
  job.walk = WalkCode::scalar;
  const Measurement scalar = measure(job, kRun);
  CHECK(scalar.steps > 1'000'000);
  CHECK(scalar.mean_path_length.mean * 200 ==
        doctest::Approx(static_cast<double>(scalar.steps)).epsilon(0.01));
  job.walk = WalkCode::batch;
  for (const InstructionSet set : instruction_sets()) {
    CAPTURE(name_of(set));
    job.instruction_set = set;
    const Measurement lanes = measure(job, kRun);
    CHECK(lanes.steps == scalar.steps);
    CHECK(lanes.mean_path_length.mean == doctest::Approx(scalar.mean_path_length.mean).epsilon(2e-6));
    CHECK(lanes.resolved.mean_path_reflected.value() ==
          doctest::Approx(scalar.resolved.mean_path_reflected.value()).epsilon(2e-6));
  }
}

TEST_CASE("an interrupted measurement keeps whole blocks only") {
  const std::atomic<bool> stop{true};
  MeasureJob job;
  job.shape = MeasuredHalfSpace{};
  CHECK(measure(job, stop).walks == 0);
}

TEST_CASE("a half-space under a rough interface delivers the colour it was asked for") {
  const struct {
    double color, g, ior, roughness;
  } cases[]{{0.2, 0, 1.5, 1}, {0.5, 0, 1.33, 0.2}, {0.5, 0.8, 1.5, 0.5}, {0.8, -0.5, 1.5, 0.7}};
  for (const auto& c : cases) {
    MeasureJob job;
    job.shape = MeasuredHalfSpace{};
    job.boundary = Boundary::dielectric;
    job.g = c.g;
    job.ior = c.ior;
    job.roughness = c.roughness;
    job.albedo = ColorMap(c.g, {Boundary::dielectric, c.ior, c.roughness}).albedo(c.color);
    job.incidence = {true, 1};
    job.walks = 500000;
    job.threads = 2;
    const Measurement m = measure(job, kRun);
    const double delivered = m.from_below.value();
    const double entered = 1 - m.specular_reflectance.mean;
    CHECK(delivered * entered ==
          doctest::Approx(m.reflectance.mean - m.specular_reflectance.mean).epsilon(1e-9));
    CAPTURE(c.color);
    CAPTURE(delivered);
    CHECK(std::abs(delivered - c.color) < 0.002);
    // The smooth curve would miss by more than the bound.
    const double smooth = ColorMap(c.g, {Boundary::dielectric, c.ior}).color(job.albedo);
    if (c.roughness >= 0.5) CHECK(std::abs(smooth - c.color) > 0.004);
  }
}

TEST_CASE("the standard error of a delivered colour is the spread of independent measurements") {
  MeasureJob job;
  job.shape = MeasuredHalfSpace{};
  job.boundary = Boundary::dielectric;
  job.ior = 1.5;
  job.roughness = 0.5;
  job.albedo = 0.3;  // dark: most of what comes back was mirrored, which is no part of the colour
  job.incidence = {true, 1};
  job.walks = 2000;
  Moments colors;
  Moments errors;
  for (job.seed = 0; job.seed < 200; ++job.seed) {
    const Measurement m = measure(job, kRun);
    colors.add(m.from_below.value());
    errors.add(m.from_below.standard_error());
  }
  const double spread = colors.standard_error() * std::sqrt(200.0);
  // The spread of 200 normal values is known to 5 %.
  CHECK(std::abs(spread / errors.mean - 1) < 0.2);
}

TEST_CASE("a rough interface of almost no roughness measures as the smooth one") {
  MeasureJob job;
  job.shape = MeasuredSphere{2};
  job.boundary = Boundary::dielectric;
  job.ior = 1.5;
  job.incidence = {true, 1};
  job.walks = 200000;
  job.threads = 2;
  const Measurement smooth = measure(job, kRun);
  job.roughness = 0.02;
  job.seed = 1;
  const Measurement rough = measure(job, kRun);
  const auto differ = [](const Moments& a, const Moments& b) {
    return std::abs(two_sample_z(a.mean, a.standard_error(), b.mean, b.standard_error()));
  };
  CHECK(differ(smooth.absorptance, rough.absorptance) < 4);
  CHECK(differ(smooth.specular_reflectance, rough.specular_reflectance) < 4);
}
