#include "medium/rough_mirror.h"

#include <algorithm>
#include <cmath>

#include "math/ggx.h"
#include "math/rough_dielectric.h"

namespace meander {
namespace {

constexpr std::uint32_t kSamples = 8192;  // a node

// The borders of the cells that the nodes stand for, node i between borders[i] and borders[i + 1]: each holds
// as much flux, 2 mu dmu, as its node.
std::vector<double> cell_borders(const AngularGrid& grid) {
  std::vector<double> borders{0};
  for (std::size_t i = 0; i < grid.mu.size(); ++i)
    borders.push_back(std::sqrt(borders[i] * borders[i] + 2 * grid.weight[i] * grid.mu[i]));
  return borders;
}

}  // namespace

SquareMatrix rough_mirror(const AngularGrid& grid, double roughness, double ior) {
  const int n = static_cast<int>(grid.mu.size());
  const RoughDielectric surface{ggx_alpha(static_cast<Real>(roughness)), static_cast<Real>(ior)};
  const std::vector<double> borders = cell_borders(grid);
  const auto flux = [&](int i) { return 2 * grid.weight[i] * grid.mu[i]; };
  SquareMatrix passed(n);
  for (int j = 0; j < n; ++j) {
    Random random = stream(0, static_cast<std::uint32_t>(j), 0);
    for (std::uint32_t k = 0; k < kSamples; ++k) {
      // As much of each cosine in the cell as there is flux, evenly.
      const double mu = std::sqrt(borders[j] * borders[j] + flux(j) * (k + 0.5) / kSamples);
      const double sine = std::sqrt(std::max((1 - mu) * (1 + mu), 0.0));
      const Vec3 up(static_cast<Real>(sine), 0, static_cast<Real>(mu));
      const double down = -double{sample_rough_dielectric(surface, up, random).direction.z};
      if (!(down > 0)) continue;
      const auto border = std::upper_bound(borders.begin(), borders.end() - 1, down);
      passed.at(static_cast<int>(border - borders.begin()) - 1, j) += flux(j) / kSamples;
    }
  }
  // Both ways carry the same flux; each was counted with a variance in proportion to its source's flux.
  SquareMatrix result(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double both = passed.at(i, j) * flux(i) + passed.at(j, i) * flux(j);
      result.at(i, j) = both / ((flux(i) + flux(j)) * std::sqrt(flux(i) * flux(j)));
    }
  }
  return result;
}

}  // namespace meander
