#include <doctest/doctest.h>

#include <vector>

#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "support/csv.h"
#include "walk/walk_tally.h"

using namespace meander;

namespace {

WalkModel grey(double albedo, double g, Estimator estimator = Estimator::implicit) {
  return {{Rgb(1), Rgb(static_cast<Real>(albedo)), static_cast<Real>(g)}, estimator};
}

// Many z-scores against references: none may be beyond chance for the whole family.
void check_family(const std::vector<double>& scores) {
  const double threshold = two_sided_threshold(sidak_level(1e-3, scores.size()));
  for (const double z : scores) {
    CAPTURE(z);
    CHECK(std::abs(z) < threshold);
  }
}

// A world without a surface.
struct InfiniteWorld {
  Crossing first_crossing(const Vec3& p, const Vec3& d, Real t) const noexcept {
    return {CrossingKind::none, t, p + t * d, {}, {}};
  }
};

}  // namespace

TEST_CASE("slabs reflect and transmit what adding-doubling says, by both estimators") {
  const CsvTable table = reference_table("a_slab.csv");
  std::vector<double> scores;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.number(row, "eta") != 1.0 || table.number(row, "tau") > 10 || row % 2 != 0) continue;
    const bool diffuse = table.text(row, "incidence") == "diffuse";
    const Real mu = diffuse ? 0 : static_cast<Real>(table.number(row, "mu0"));
    for (const Estimator estimator : {Estimator::implicit, Estimator::analog}) {
      const auto tally = tally_walks(SlabWorld{static_cast<Real>(table.number(row, "tau"))},
                                     grey(table.number(row, "alpha"), table.number(row, "g"), estimator),
                                     60000, row, enter(0, mu));
      CAPTURE(row);
      scores.push_back(z_score(tally.back.mean, table.number(row, "R_total"), tally.back.standard_error()));
      const double transmitted = table.number(row, "T_total");
      if (transmitted * 60000 > 50)
        scores.push_back(z_score(tally.through.mean, transmitted, tally.through.standard_error()));
      const double direct = table.number(row, "T_unscattered");
      if (direct * 60000 > 50)
        scores.push_back(z_score(tally.unscattered.mean, direct, tally.unscattered.standard_error()));
    }
  }
  REQUIRE(scores.size() > 20);
  check_family(scores);
}

TEST_CASE("half-spaces reflect what Chandrasekhar's H-function says") {
  const CsvTable table = reference_table("b2_halfspace_iso_vs_albedo.csv");
  std::vector<double> scores;
  for (std::size_t row = 0; row < table.rows.size(); row += 3) {
    const double albedo = table.number(row, "alpha");
    if (albedo > 0.995) continue;
    const auto normal = tally_walks(HalfSpaceWorld{}, grey(albedo, 0), 60000, 10 + row, enter(0, 1));
    scores.push_back(z_score(normal.back.mean, table.number(row, "R_mu0_1"), normal.back.standard_error()));
    const auto oblique = tally_walks(HalfSpaceWorld{}, grey(albedo, 0), 60000, 50 + row, enter(0, Real(0.1)));
    scores.push_back(
        z_score(oblique.back.mean, table.number(row, "R_mu0_0.1"), oblique.back.standard_error()));
    const auto diffuse = tally_walks(HalfSpaceWorld{}, grey(albedo, 0), 60000, 90 + row, enter(0, 0));
    scores.push_back(
        z_score(diffuse.back.mean, table.number(row, "R_diffuse"), diffuse.back.standard_error()));
  }
  check_family(scores);
}

TEST_CASE("spheres let out what the Peierls equation says") {
  const CsvTable table = reference_table("f1_sphere_iso.csv");
  std::vector<double> scores;
  for (std::size_t row = 0; row < table.rows.size(); row += 4) {
    const Real radius = static_cast<Real>(table.number(row, "optical_radius"));
    if (radius > 20) continue;
    const auto tally =
        tally_walks(SphereWorld{radius}, grey(table.number(row, "alpha"), 0), 60000, row, enter(radius, 0));
    const double escaped = tally.back.mean + tally.through.mean;
    const double error = std::hypot(tally.back.standard_error(), tally.through.standard_error());
    scores.push_back(z_score(escaped, table.number(row, "escape_fraction"), error));
    scores.push_back(z_score(tally.absorbed.mean, table.number(row, "absorbed_fraction"),
                             tally.absorbed.standard_error()));
  }
  check_family(scores);
}

TEST_CASE("without absorption the mean path in a sphere is 4V/S, whatever the medium") {
  std::vector<double> scores;
  for (const double g : {-0.5, 0.0, 0.9}) {
    for (const double sigma : {0.1, 1.0, 10.0}) {
      WalkModel model = grey(1, g);
      model.medium.sigma_t = Rgb(static_cast<Real>(sigma));
      const auto tally = tally_walks(SphereWorld{1}, model, 60000, 7, enter(1, 0));
      scores.push_back(z_score(tally.path.mean, 4.0 / 3, tally.path.standard_error()));
      scores.push_back(z_score(tally.order.mean, sigma * 4 / 3, tally.order.standard_error()));
      CHECK(tally.back.mean + tally.through.mean == doctest::Approx(1).epsilon(1e-6));
    }
  }
  check_family(scores);
}

TEST_CASE("free paths and deflections in an infinite medium have the moments of theory") {
  const CsvTable table = reference_table("e2_walk_moments.csv");
  std::vector<double> scores;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto paths = static_cast<std::uint32_t>(table.number(row, "n_free_paths"));
    if (paths > 20) continue;
    const Real g = static_cast<Real>(table.number(row, "g"));
    Moments z;
    Moments r2;
    for (std::uint32_t i = 0; i < 60000; ++i) {
      Random random = stream(3, static_cast<std::uint32_t>(row), i);
      Walker walker;
      for (std::uint32_t n = 0; n < paths; ++n) {
        if (n > 0) scatter_direction(walker, g, random);
        walker.position += sample_free_path(1, random.next()) * walker.direction;
      }
      z.add(walker.position.z);
      r2.add(glm::dot(walker.position, walker.position));
    }
    scores.push_back(z_score(z.mean, table.number(row, "mean_z_times_sigma_t"), z.standard_error()));
    scores.push_back(z_score(r2.mean, table.number(row, "mean_r2_times_sigma_t2"), r2.standard_error()));
  }
  check_family(scores);
}

TEST_CASE("analog walks in an infinite medium are absorbed where theory says") {
  const CsvTable table = reference_table("e2b_walk_to_absorption.csv");
  std::vector<double> scores;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const WalkModel model = grey(table.number(row, "alpha"), table.number(row, "g"), Estimator::analog);
    Moments z;
    Moments r2;
    Moments collisions;
    for (std::uint32_t i = 0; i < 20000; ++i) {
      Random random = stream(4, static_cast<std::uint32_t>(row), i);
      Walker walker;
      TallyEvents events;
      const WalkResult result = random_walk(InfiniteWorld{}, model, walker, random, events);
      REQUIRE(result.end == WalkEnd::absorbed);
      z.add(walker.position.z);
      r2.add(glm::dot(walker.position, walker.position));
      collisions.add(walker.weight.order + 1);
    }
    scores.push_back(
        z_score(z.mean, table.number(row, "mean_z_of_absorption_times_sigma_t"), z.standard_error()));
    scores.push_back(
        z_score(r2.mean, table.number(row, "mean_r2_of_absorption_times_sigma_t2"), r2.standard_error()));
    scores.push_back(z_score(collisions.mean, table.number(row, "mean_number_of_collisions_incl_absorption"),
                             collisions.standard_error()));
  }
  check_family(scores);
}

TEST_CASE("a chromatic walk gives each channel what a grey walk gives it, with weights of at most 3") {
  const WalkModel model{{Rgb(Real(0.5), 2, 8), Rgb(Real(0.95), Real(0.8), Real(0.5)), Real(0.4)},
                        Estimator::implicit};
  const SlabWorld slab{1};
  Moments reflected[3];
  Moments transmitted[3];
  Real largest_weight = 0;
  for (std::uint32_t i = 0; i < 300000; ++i) {
    Random random = stream(11, 0, i);
    Walker walker;
    walker.direction = {0, 0, -1};
    walker.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
    TallyEvents events;
    const WalkResult result = random_walk(slab, model, walker, random, events);
    const bool exited = result.end == WalkEnd::exited;
    const Rgb free_path = exited ? walker.weight.free_path_weight() : Rgb(0);
    largest_weight = std::max(largest_weight, largest(free_path));
    const Rgb weight = walker.weight.carried() * free_path;
    const bool back = result.crossing.normal.z > 0;
    for (int c = 0; c < 3; ++c) {
      reflected[c].add(back ? weight[c] : 0);
      transmitted[c].add(back ? 0 : weight[c]);
    }
  }
  CHECK(largest_weight <= Real(3.00001));
  CHECK(largest_weight > 2);
  std::vector<double> scores;
  for (int c = 0; c < 3; ++c) {
    WalkModel one = grey(model.medium.albedo[c], model.medium.g);
    one.medium.sigma_t = Rgb(model.medium.sigma_t[c]);
    const auto tally = tally_walks(slab, one, 300000, 20 + c, enter(0, 1));
    scores.push_back(two_sample_z(reflected[c].mean, reflected[c].standard_error(), tally.back.mean,
                                  tally.back.standard_error()));
    scores.push_back(two_sample_z(transmitted[c].mean, transmitted[c].standard_error(), tally.through.mean,
                                  tally.through.standard_error()));
  }
  check_family(scores);
}

TEST_CASE("what is reflected, transmitted and absorbed adds up to 1 on every analog walk") {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Random random = stream(5, 1, i);
    Walker walker;
    walker.direction = {0, 0, -1};
    TallyEvents events;
    const auto result = random_walk(SlabWorld{3}, grey(0.8, 0.5, Estimator::analog), walker, random, events);
    const double out = result.end == WalkEnd::exited ? double{walker.weight.carried().x} : 0;
    REQUIRE(out + events.absorptance == 1.0);
  }
}

TEST_CASE("a walk asks whether to stop every 1024 steps, and ends there") {
  struct StoppingEvents : TallyEvents {
    int asked = 0;
    bool stop() noexcept { return ++asked == 3; }
  } events;
  Random random = stream(1, 2, 3);
  Walker walker;
  const auto result = random_walk(InfiniteWorld{}, grey(1, 0), walker, random, events);
  CHECK(result.end == WalkEnd::interrupted);
  CHECK(walker.steps == 3 * kStopInterval);
}

TEST_CASE("directions stay unit over 100000 scatterings") {
  for (const Real g : {Real(0.9999), Real(0.5), Real(-0.9)}) {
    Random random = stream(9, 9, 9);
    Walker walker;
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
      scatter_direction(walker, g, random);
      worst = std::max(worst, std::abs(double{glm::dot(walker.direction, walker.direction)} - 1));
    }
    CHECK(worst < 1e-5);
  }
}

TEST_CASE("a vacuum is crossed in one step") {
  WalkModel model{{Rgb(0), Rgb(0), 0}, Estimator::implicit};
  Random random = stream(0, 0, 0);
  Walker walker;
  walker.direction = {0, 0, -1};
  TallyEvents events;
  const auto result = random_walk(SlabWorld{5}, model, walker, random, events);
  CHECK(result.end == WalkEnd::exited);
  CHECK(walker.steps == 1);
  CHECK(walker.weight.free_path_weight() == Rgb(1));
}
