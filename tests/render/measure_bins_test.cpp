#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "render/measure.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "support/csv.h"

using namespace meander;

namespace {

const std::atomic<bool> kRun{false};

// Exitant radiance of a bin of the cosine, from the flux in it.
double radiance(const BinRow& row, int bin, int count, std::uint64_t walks) {
  const double low = static_cast<double>(bin) / count;
  const double high = static_cast<double>(bin + 1) / count;
  return row.mean(bin, walks) / (std::numbers::pi * (high * high - low * low));
}
double radiance_error(const BinRow& row, int bin, int count, std::uint64_t walks) {
  return row.standard_error(bin, walks) / row.mean(bin, walks) * radiance(row, bin, count, walks);
}

MeasureJob half_space(double albedo, double cosine) {
  MeasureJob job;
  job.shape = MeasuredHalfSpace{};
  job.albedo = albedo;
  job.incidence = {false, cosine};
  job.walks = 400000;
  job.threads = 2;
  return job;
}

void check_family(const std::vector<double>& scores) {
  const double threshold = two_sided_threshold(sidak_level(1e-3, scores.size()));
  for (const double z : scores) CHECK(std::abs(z) < threshold);
}

}  // namespace

TEST_CASE("the exitant radiance of an isotropic half-space is Chandrasekhar's, bin by bin") {
  const CsvTable table = reference_table("c1b_angular_bins.csv");
  std::vector<double> scores;
  for (std::size_t row = 0; row < table.rows.size();) {
    const double albedo = table.number(row, "alpha");
    const double mu0 = table.number(row, "mu0");
    const int bins = static_cast<int>(table.number(row, "bins"));
    MeasureJob job = half_space(albedo, mu0);
    job.bins.angular = bins;
    const Measurement m = measure(job, kRun);
    for (int bin = 0; bin < bins; ++bin, ++row)
      scores.push_back(z_score(radiance(m.resolved.reflected_angle, bin, bins, m.walks),
                               table.number(row, "L_over_E"),
                               radiance_error(m.resolved.reflected_angle, bin, bins, m.walks)));
  }
  REQUIRE(scores.size() == 50);
  check_family(scores);
}

TEST_CASE("the exitant radiance of anisotropic slabs is adding-doubling's, at the tabulated cosines") {
  const CsvTable table = reference_table("c2_radiance_hg_normal_incidence.csv");
  constexpr int kBins = 50;
  std::vector<double> scores;
  std::size_t row = 0;
  while (row < table.rows.size()) {
    MeasureJob job;
    job.albedo = table.number(row, "alpha");
    job.g = table.number(row, "g");
    const double tau = table.number(row, "tau");
    const bool half_space_row = !(tau < 1e5);
    if (half_space_row) job.shape = MeasuredHalfSpace{};
    if (!half_space_row) job.shape = MeasuredSlab{tau};
    job.walks = 300000;
    job.threads = 2;
    job.seed = row;
    job.bins.angular = kBins;
    const Measurement m = measure(job, kRun);
    const std::string medium = table.text(row, "alpha") + table.text(row, "g") + table.text(row, "tau");
    for (; row < table.rows.size() &&
           table.text(row, "alpha") + table.text(row, "g") + table.text(row, "tau") == medium;
         ++row) {
      // The cosine is in the middle of a bin (0.05) or between two; their average is the value itself to 1e-3
      // but near the horizon and the forward peak.
      const double mu = table.number(row, "mu");
      if (mu != 0.05 && (mu < 0.15 || mu > 0.85)) continue;
      const int last = static_cast<int>(std::lround(mu * kBins - 0.25));
      const int first = mu == 0.05 ? last : last - 1;
      const double ring = std::numbers::pi * ((last + 1) * (last + 1) - first * first) / (kBins * kBins);
      const auto score = [&](const BinRow& bins, const std::string& column) {
        if (table.text(row, column).empty()) return;
        double flux = 0;
        double variance = 0;
        for (int bin = first; bin <= last; ++bin) {
          flux += bins.mean(bin, m.walks);
          variance += std::pow(bins.standard_error(bin, m.walks), 2);
        }
        const double exact = table.number(row, column);
        scores.push_back(z_score(flux / ring, exact, std::hypot(std::sqrt(variance) / ring, 1e-3 * exact)));
      };
      score(m.resolved.reflected_angle, "reflected_radiance_per_unit_irradiance");
      if (!half_space_row)
        score(m.resolved.transmitted_angle, "transmitted_scattered_radiance_per_unit_irradiance");
    }
  }
  REQUIRE(scores.size() > 40);
  check_family(scores);
}

TEST_CASE("bins add up to the totals, and depth to absorption and fluence") {
  MeasureJob job;
  job.shape = MeasuredSlab{3};
  job.albedo = 0.8;
  job.g = 0.6;
  job.boundary = Boundary::dielectric;
  job.ior = 1.4;
  job.walks = 50000;
  job.threads = 2;
  job.bins = {8, 12, 4, 10, 3, 15, 20};
  const Measurement m = measure(job, kRun);
  const auto total = [&](const BinRow& row) {
    double sum = 0;
    for (int i = 0; i < row.size(); ++i) sum += row.mean(i, m.walks);
    return sum;
  };
  const double inside = m.reflectance.mean - m.specular_reflectance.mean;
  CHECK(total(m.resolved.reflected_radius) == doctest::Approx(inside).epsilon(1e-9));
  CHECK(total(m.resolved.reflected_path) == doctest::Approx(inside).epsilon(1e-9));
  CHECK(total(m.resolved.transmitted_radius) == doctest::Approx(m.transmittance.mean).epsilon(1e-9));
  CHECK(total(m.resolved.transmitted_path) == doctest::Approx(m.transmittance.mean).epsilon(1e-9));
  CHECK(total(m.resolved.absorbed_depth) == doctest::Approx(m.absorptance.mean).epsilon(1e-9));
  CHECK(total(m.resolved.fluence) == doctest::Approx(m.mean_path_length.mean).epsilon(1e-6));
  const double scattered = inside - (m.unscattered_reflectance.mean - m.specular_reflectance.mean);
  CHECK(total(m.resolved.reflected_angle) == doctest::Approx(scattered).epsilon(1e-9));
  // Absorption is 1 - albedo of the fluence, bin by bin.
  for (int i = 0; i < 10; ++i) {
    const double error = std::hypot(m.resolved.absorbed_depth.standard_error(i, m.walks),
                                    0.2 * m.resolved.fluence.standard_error(i, m.walks));
    CHECK(std::abs(m.resolved.absorbed_depth.mean(i, m.walks) - 0.2 * m.resolved.fluence.mean(i, m.walks)) <
          4 * error);
  }
}

TEST_CASE("rows of bins keep the standard error of independent walks") {
  BinRow row(2);
  row.add(0, 1);
  row.add(0, 1);  // twice in one walk
  row.end_walk();
  row.end_walk();
  row.add(1, 3);
  row.end_walk();
  row.end_walk();
  CHECK(row.mean(0, 4) == 0.5);
  // Values 2, 0, 0, 0: variance of one walk 1, of the mean 1/4.
  CHECK(row.standard_error(0, 4) == doctest::Approx(0.5));
  BinRow other(2);
  other.merge(row);
  CHECK(other.mean(1, 4) == 0.75);
  RatioOfSums ratio;
  ratio.add(2, 1);
  ratio.add(6, 3);
  CHECK(ratio.value() == 2);
  CHECK(ratio.standard_error() == doctest::Approx(0));
  CHECK(bin_of(2.5, 5, 5) == 2);
  CHECK(bin_of(5, 5, 5) == 5);
  CHECK(bin_of(1e300, 5, 5) == 5);
}
