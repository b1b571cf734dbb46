// Runs the rows of the reference tables through `measure` and holds the z-scores to what chance allows: the
// largest |z| to the Sidak bound of the family at level 1e-3, the mean of z^2 to within 4 sqrt(2 / N) of 1.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "render/measure.h"
#include "render/parallel.h"
#include "stats/distributions.h"
#include "support/csv.h"

using namespace meander;

namespace {

struct Expected {
  const char* quantity;
  double value;
};

struct Case {
  std::string name;
  MeasureJob job;
  std::vector<Expected>
      expected;  // the first one counts for the mean of z^2: those of one run are not independent
};

Incidence incidence_of(const CsvTable& table, std::size_t row) {
  if (table.text(row, "incidence") == "diffuse") return {true, 1};
  return {false, table.number(row, "mu0")};
}

MeasureJob medium_job(double albedo, double g, double eta) {
  MeasureJob job;
  job.albedo = albedo;
  job.g = g;
  job.ior = eta;
  job.boundary = eta == 1 ? Boundary::matched : Boundary::dielectric;
  job.threads = hardware_threads();
  return job;
}

void add_slabs(std::vector<Case>& cases) {
  const CsvTable t = reference_table("a_slab.csv");
  for (std::size_t row = 0; row < t.rows.size(); ++row) {
    MeasureJob job = medium_job(t.number(row, "alpha"), t.number(row, "g"), t.number(row, "eta"));
    job.shape = MeasuredSlab{t.number(row, "tau")};
    job.incidence = incidence_of(t, row);
    cases.push_back({"a_slab:" + std::to_string(row + 2),
                     job,
                     {{"reflectance", t.number(row, "R_total")},
                      {"transmittance", t.number(row, "T_total")},
                      {"unscattered_transmittance", t.number(row, "T_unscattered")}}});
  }
}

void add_half_spaces(std::vector<Case>& cases) {
  const CsvTable b1 = reference_table("b1_halfspace.csv");
  for (std::size_t row = 0; row < b1.rows.size(); ++row) {
    MeasureJob job = medium_job(b1.number(row, "alpha"), b1.number(row, "g"), b1.number(row, "eta"));
    job.shape = MeasuredHalfSpace{};
    job.incidence = incidence_of(b1, row);
    cases.push_back(
        {"b1_halfspace:" + std::to_string(row + 2), job, {{"reflectance", b1.number(row, "R_total")}}});
  }
  const CsvTable b2 = reference_table("b2_halfspace_iso_vs_albedo.csv");
  for (std::size_t row = 0; row < b2.rows.size(); ++row) {
    const std::pair<const char*, Incidence> columns[]{{"R_diffuse", {true, 1}},
                                                      {"R_mu0_1", {false, 1}},
                                                      {"R_mu0_0.5", {false, 0.5}},
                                                      {"R_mu0_0.1", {false, 0.1}}};
    for (const auto& [column, incidence] : columns) {
      MeasureJob job = medium_job(b2.number(row, "alpha"), 0, 1);
      job.shape = MeasuredHalfSpace{};
      job.incidence = incidence;
      cases.push_back({std::string("b2_halfspace_iso:") + std::to_string(row + 2) + ":" + column,
                       job,
                       {{"reflectance", b2.number(row, column)}}});
    }
  }
  const CsvTable b4 = reference_table("b4_halfspace_hg_vs_albedo.csv");
  for (std::size_t row = 0; row < b4.rows.size(); ++row) {
    for (const bool diffuse : {true, false}) {
      const char* column = diffuse ? "R_diffuse_total" : "R_normal_total";
      MeasureJob job = medium_job(b4.number(row, "alpha"), b4.number(row, "g"), b4.number(row, "eta"));
      job.shape = MeasuredHalfSpace{};
      job.incidence = {diffuse, 1};
      cases.push_back({std::string("b4_halfspace_hg:") + std::to_string(row + 2) + ":" + column,
                       job,
                       {{"reflectance", b4.number(row, column)}}});
    }
  }
}

void add_spheres(std::vector<Case>& cases) {
  const CsvTable f1 = reference_table("f1_sphere_iso.csv");
  for (std::size_t row = 0; row < f1.rows.size(); ++row) {
    MeasureJob job = medium_job(f1.number(row, "alpha"), 0, 1);
    job.shape = MeasuredSphere{f1.number(row, "optical_radius")};
    job.incidence = {true, 1};
    cases.push_back({"f1_sphere_iso:" + std::to_string(row + 2),
                     job,
                     {{"absorptance", f1.number(row, "absorbed_fraction")},
                      {"reflectance", f1.number(row, "escape_fraction")},
                      {"unscattered_transmittance", f1.number(row, "unscattered_fraction")}}});
  }
  const CsvTable f3 = reference_table("f3_sphere_hg_eta.csv");
  for (std::size_t row = 0; row < f3.rows.size(); ++row) {
    MeasureJob job = medium_job(f3.number(row, "alpha"), f3.number(row, "g"), f3.number(row, "eta"));
    job.shape = MeasuredSphere{f3.number(row, "optical_radius")};
    job.incidence = {true, 1};
    cases.push_back({"f3_sphere_hg_eta:" + std::to_string(row + 2),
                     job,
                     {{"absorptance", f3.number(row, "absorbed_fraction")},
                      {"reflectance", f3.number(row, "escape_fraction_incl_surface_reflection")}}});
  }
}

const Moments& quantity_of(const Measurement& m, const std::string& name) {
  if (name == "transmittance") return m.transmittance;
  if (name == "unscattered_transmittance") return m.unscattered_transmittance;
  if (name == "absorptance") return m.absorptance;
  return m.reflectance;
}

// As many walks as bring the first quantity's relative standard error to `target`, by a pilot run; `limit`
// caps them.
Measurement measure_to(MeasureJob job, const Expected& expected, double target, std::uint64_t limit) {
  const std::atomic<bool> stop{false};
  job.walks = 20000;
  job.seed = 1;
  const Moments pilot = quantity_of(measure(job, stop), expected.quantity);
  const double relative = std::max(pilot.standard_error(), 1e-6) / expected.value;
  const double needed = 1.1 * 20000 * (relative / target) * (relative / target);
  job.walks = static_cast<std::uint64_t>(std::clamp(needed, 20000.0, static_cast<double>(limit)));
  job.seed = 0;
  return measure(job, stop);
}

}  // namespace

int main(int argc, char** argv) {
  const bool all = argc > 1 && std::strcmp(argv[1], "--all") == 0;
  const double target = all ? 0.002 : 0.01;
  std::vector<Case> cases;
  add_slabs(cases);
  add_half_spaces(cases);
  add_spheres(cases);
  std::ofstream file;
  if (all) file.open(std::string(MEANDER_SOURCE_DIR) + "/tests/reference/z_scores.csv");
  if (all) file << "case,quantity,exact,measured,standard_error,relative_standard_error,z,walks\n";
  std::vector<double> scores;
  double squares = 0;
  int runs = 0;
  int coarse = 0;
  for (std::size_t i = 0; i < cases.size(); i += all ? 1 : 7) {
    const Case& c = cases[i];
    const Measurement m = measure_to(c.job, c.expected[0], target, all ? 100'000'000 : 2'000'000);
    for (std::size_t k = 0; k < c.expected.size(); ++k) {
      const Expected& e = c.expected[k];
      const Moments& q = quantity_of(m, e.quantity);
      // Rare events: fewer than 50 of them are no normal variable.
      if (!(e.value * static_cast<double>(m.walks) > 50) || q.standard_error() == 0) continue;
      const double z = (q.mean - e.value) / q.standard_error();
      scores.push_back(z);
      if (k == 0) squares += z * z, ++runs;
      coarse += q.standard_error() / e.value > target;
      if (std::abs(z) > 3.5) std::printf("%s %s: z %.2f\n", c.name.c_str(), e.quantity, z);
      if (all)
        file << c.name << ',' << e.quantity << ',' << e.value << ',' << q.mean << ',' << q.standard_error()
             << ',' << q.standard_error() / e.value << ',' << z << ',' << m.walks << '\n';
    }
  }
  double worst = 0;
  for (const double z : scores) worst = std::max(worst, std::abs(z));
  const double bound = two_sided_threshold(sidak_level(1e-3, scores.size()));
  const double mean_square = squares / runs;
  const double width = 4 * std::sqrt(2.0 / runs);
  const bool passed = worst < bound && std::abs(mean_square - 1) < width;
  std::printf(
      "%zu values of %d runs: largest |z| %.2f (bound %.2f), mean of z^2 %.3f (1 +- %.3f), %d above %.1f %% "
      "relative standard error: %s\n",
      scores.size(), runs, worst, bound, mean_square, width, coarse, 100 * target,
      passed ? "passed" : "FAILED");
  return passed ? 0 : 1;
}
