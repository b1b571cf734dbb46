#include <doctest/doctest.h>

#include "support/check_sampler.h"
#include "walk/lobe.h"

using namespace meander;

TEST_CASE("a lobe with a tilted shading normal has the density it claims, all of it above the surface") {
  TestFamily family;
  for (const Real tilt : {Real(0), Real(0.4), Real(1.2), Real(1.5)}) {
    const LambertLobe lobe = make_lobe({0, 0, 1}, {std::sin(tilt), 0, std::cos(tilt)});
    constexpr int kRows = 31;
    constexpr int kColumns = 31;
    std::vector<double> observed(kRows * kColumns);
    std::vector<double> expected(kRows * kColumns);
    constexpr int kSamples = 200000;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      Random random = stream(1, 0, i);
      const Real u1 = random.next();
      const Real u2 = random.next();
      const Vec3 d = lobe.sample({u1, u2});
      REQUIRE(d.z >= 0);
      const int row = std::min(static_cast<int>(d.z * kRows), kRows - 1);
      const int column = std::min(static_cast<int>(invert_azimuth(d.x, d.y) * kColumns), kColumns - 1);
      observed[row * kColumns + column] += 1;
    }
    // Density over (cosine, azimuth) integrated on a fine grid of each cell.
    constexpr int kFine = 24;
    double total = 0;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        double sum = 0;
        for (int i = 0; i < kFine; ++i)
          for (int j = 0; j < kFine; ++j) {
            const double z = (row + (i + 0.5) / kFine) / kRows;
            const double phi = 2 * glm::pi<double>() * (column + (j + 0.5) / kFine) / kColumns;
            const double s = std::sqrt(1 - z * z);
            sum += lobe.eval(Vec3(s * std::cos(phi), s * std::sin(phi), z));
          }
        expected[row * kColumns + column] =
            sum / (kFine * kFine) * (2 * glm::pi<double>() / (kRows * kColumns));
        total += expected[row * kColumns + column];
      }
    CHECK(total == doctest::Approx(1).epsilon(2e-4));
    for (double& cell : expected) cell *= kSamples / total;
    family.add("tilt " + std::to_string(tilt), chi_square_test(observed, expected).p);
  }
  family.check();
}

TEST_CASE("a lobe is black below its surface, and its shading normal is turned to its side") {
  const LambertLobe lobe = make_lobe({0, 0, 1}, {0, Real(0.6), Real(-0.8)});
  CHECK(lobe.shading_normal.z > 0);
  CHECK(lobe.eval({0, 0, -1}) == 0);
  check_extremes<2>(
      [&](const auto& u) {
        return lobe.sample({u[0], u[1]});
      },
      [](const Vec3& d) { return std::abs(glm::length(d) - 1) < 1e-5 && d.z >= 0; });
}

TEST_CASE("a refracted lobe sends out what its density says, and keeps the rest") {
  // F_diffuse_internal of tests/reference/e1b_fresnel_averages.csv.
  for (const auto& [ior, kept] :
       {std::pair(Real(1.33), 0.471949148792699088), std::pair(Real(1.5), 0.59634575970771165)}) {
    for (const Real tilt : {Real(0), Real(0.5)}) {
      const RefractedLobe lobe(make_lobe({0, 0, 1}, {std::sin(tilt), 0, std::cos(tilt)}), ior);
      constexpr int kCells = 21;
      std::vector<double> observed(kCells + 1);
      constexpr int kSamples = 200000;
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        Random random = stream(2, 0, i);
        const Real u1 = random.next();
        const Real u2 = random.next();
        const auto d = lobe.sample({u1, u2}, random.next());
        if (d) REQUIRE(d->z >= 0);
        observed[d ? std::min(static_cast<int>(d->z * kCells), kCells - 1) : kCells] += 1;
      }
      std::vector<double> expected(kCells + 1);
      double total = 0;
      for (int cell = 0; cell < kCells; ++cell) {
        double sum = 0;
        constexpr int kFine = 200;
        for (int i = 0; i < kFine; ++i)
          for (int j = 0; j < kFine; ++j) {
            const double z = (cell + (i + 0.5) / kFine) / kCells;
            const double phi = 2 * glm::pi<double>() * (j + 0.5) / kFine;
            const double s = std::sqrt(1 - z * z);
            sum += lobe.eval(Vec3(s * std::cos(phi), s * std::sin(phi), z));
          }
        expected[cell] = sum / (kFine * kFine) * (2 * glm::pi<double>() / kCells);
        total += expected[cell];
      }
      expected[kCells] = kept;
      CHECK(total + kept == doctest::Approx(1).epsilon(2e-4));
      for (double& cell : expected) cell *= kSamples / (total + kept);
      CHECK(chi_square_test(observed, expected).p > 1e-4);
    }
  }
}
