#include "reference/reference_cases.h"

#include "support/csv.h"

namespace meander {
namespace {

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
  return job;
}

std::string line_of(const char* table, std::size_t row) {
  return std::string(table) + ':' + std::to_string(row + 2);
}

void add_slabs(std::vector<ReferenceCase>& cases) {
  const CsvTable t = reference_table("a_slab.csv");
  for (std::size_t row = 0; row < t.rows.size(); ++row) {
    MeasureJob job = medium_job(t.number(row, "alpha"), t.number(row, "g"), t.number(row, "eta"));
    job.shape = MeasuredSlab{t.number(row, "tau")};
    job.incidence = incidence_of(t, row);
    cases.push_back({line_of("a_slab", row),
                     job,
                     {{"reflectance", t.number(row, "R_total")},
                      {"transmittance", t.number(row, "T_total")},
                      {"unscattered_transmittance", t.number(row, "T_unscattered"), false}}});
  }
}

void add_half_space(std::vector<ReferenceCase>& cases, const std::string& name, MeasureJob job,
                    double reflectance) {
  if (job.albedo == 1) return;
  job.shape = MeasuredHalfSpace{};
  cases.push_back({name, job, {{"reflectance", reflectance}}});
}

void add_half_spaces(std::vector<ReferenceCase>& cases) {
  const CsvTable b1 = reference_table("b1_halfspace.csv");
  for (std::size_t row = 0; row < b1.rows.size(); ++row) {
    MeasureJob job = medium_job(b1.number(row, "alpha"), b1.number(row, "g"), b1.number(row, "eta"));
    job.incidence = incidence_of(b1, row);
    add_half_space(cases, line_of("b1_halfspace", row), job, b1.number(row, "R_total"));
  }
  const CsvTable b2 = reference_table("b2_halfspace_iso_vs_albedo.csv");
  for (std::size_t row = 0; row < b2.rows.size(); ++row) {
    const std::pair<const char*, Incidence> columns[]{{"R_diffuse", {true, 1}},
                                                      {"R_mu0_1", {false, 1}},
                                                      {"R_mu0_0.5", {false, 0.5}},
                                                      {"R_mu0_0.1", {false, 0.1}}};
    for (const auto& [column, incidence] : columns) {
      MeasureJob job = medium_job(b2.number(row, "alpha"), 0, 1);
      job.incidence = incidence;
      add_half_space(cases, line_of("b2_halfspace_iso_vs_albedo", row) + ':' + column, job,
                     b2.number(row, column));
    }
  }
  const CsvTable b4 = reference_table("b4_halfspace_hg_vs_albedo.csv");
  for (std::size_t row = 0; row < b4.rows.size(); ++row) {
    for (const bool diffuse : {true, false}) {
      const char* column = diffuse ? "R_diffuse_total" : "R_normal_total";
      MeasureJob job = medium_job(b4.number(row, "alpha"), b4.number(row, "g"), b4.number(row, "eta"));
      job.incidence = {diffuse, 1};
      add_half_space(cases, line_of("b4_halfspace_hg_vs_albedo", row) + ':' + column, job,
                     b4.number(row, column));
    }
  }
}

void add_spheres(std::vector<ReferenceCase>& cases) {
  const CsvTable f1 = reference_table("f1_sphere_iso.csv");
  for (std::size_t row = 0; row < f1.rows.size(); ++row) {
    MeasureJob job = medium_job(f1.number(row, "alpha"), 0, 1);
    job.shape = MeasuredSphere{f1.number(row, "optical_radius")};
    job.incidence = {true, 1};
    cases.push_back({line_of("f1_sphere_iso", row),
                     job,
                     {{"absorptance", f1.number(row, "absorbed_fraction")},
                      {"reflectance", f1.number(row, "escape_fraction")},
                      {"unscattered_transmittance", f1.number(row, "unscattered_fraction"), false}}});
  }
  const CsvTable f3 = reference_table("f3_sphere_hg_eta.csv");
  for (std::size_t row = 0; row < f3.rows.size(); ++row) {
    MeasureJob job = medium_job(f3.number(row, "alpha"), f3.number(row, "g"), f3.number(row, "eta"));
    job.shape = MeasuredSphere{f3.number(row, "optical_radius")};
    job.incidence = {true, 1};
    cases.push_back({line_of("f3_sphere_hg_eta", row),
                     job,
                     {{"absorptance", f3.number(row, "absorbed_fraction")},
                      {"reflectance", f3.number(row, "escape_fraction_incl_surface_reflection")}}});
  }
}

}  // namespace

std::vector<ReferenceCase> reference_cases() {
  std::vector<ReferenceCase> cases;
  add_slabs(cases);
  add_half_spaces(cases);
  add_spheres(cases);
  return cases;
}

const Moments& quantity_of(const Measurement& m, const std::string& name) {
  if (name == "transmittance") return m.transmittance;
  if (name == "unscattered_transmittance") return m.unscattered_transmittance;
  if (name == "absorptance") return m.absorptance;
  return m.reflectance;
}

}  // namespace meander
