#include "medium/half_space.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace meander {

namespace {

constexpr double kLargestAlbedo = 1 - 1e-12;

/// One parity of the scattering operator: eigenvalue g^l on the Legendre polynomial P_l for l <= degree of
/// this parity, and the constant `tail` on all that is above.
SquareMatrix scattering_operator(const AngularGrid& grid, double g, int parity) {
  const int n = static_cast<int>(grid.mu.size());
  const double tail_size = std::pow(std::abs(g), grid.degree + 1);
  const double tail = g < 0 && parity == 1 ? -tail_size : tail_size;
  SquareMatrix result(n);
  for (int i = 0; i < n; ++i) result.at(i, i) = tail;
  std::vector<double> previous(n, 0.0);
  std::vector<double> current(n);
  for (int i = 0; i < n; ++i) current[i] = std::sqrt(grid.weight[i]);
  double moment = 1;
  for (int l = 0; l <= grid.degree; ++l, moment *= g) {
    if (l % 2 == parity) {
      for (int i = 0; i < n; ++i) {
        const double factor = (2 * l + 1) * (moment - tail) * current[i];
        for (int j = 0; j < n; ++j) result.at(i, j) += factor * current[j];
      }
    }
    for (int i = 0; i < n; ++i) {
      const double next = ((2 * l + 1) * grid.mu[i] * current[i] - l * previous[i]) / (l + 1);
      previous[i] = std::exchange(current[i], next);
    }
  }
  return result;
}

/// M^(-1/2) (1 - albedo * scattering) M^(-1/2), M the diagonal of the cosines.
SquareMatrix transport_operator(const SquareMatrix& scattering, const std::vector<double>& mu,
                                double albedo) {
  SquareMatrix result(scattering.n);
  for (int i = 0; i < result.n; ++i) {
    for (int j = 0; j < result.n; ++j) {
      result.at(i, j) = ((i == j ? 1.0 : 0.0) - albedo * scattering.at(i, j)) / std::sqrt(mu[i] * mu[j]);
    }
  }
  return result;
}

/// The highest degree up to `most` for which the rule integrates every Legendre polynomial to 1e-12.
int exact_degree(const AngularGrid& grid, int most) {
  std::vector<double> previous(grid.mu.size(), 0.0);
  std::vector<double> current = grid.weight;
  double below = 0;  // P_(l-1)(0); the integral of P_l is (P_(l-1)(0) - P_(l+1)(0)) / (2l + 1)
  double at = 1;
  for (int l = 0; l <= most; ++l) {
    const double above = -l * below / (l + 1);
    const double expected = l == 0 ? 1 : (below - above) / (2 * l + 1);
    double sum = 0;
    for (const double x : current) sum += x;
    if (std::abs(sum - expected) > 1e-12) return l - 1;
    for (std::size_t i = 0; i < current.size(); ++i) {
      const double next = ((2 * l + 1) * grid.mu[i] * current[i] - l * previous[i]) / (l + 1);
      previous[i] = std::exchange(current[i], next);
    }
    below = std::exchange(at, above);
  }
  return most;
}

}  // namespace

AngularGrid make_gauss_grid(int n) {
  assert(n >= 2);
  AngularGrid grid{std::vector<double>(n), std::vector<double>(n), 2 * n - 1};
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      double previous = 1;
      double current = x;
      for (int l = 1; l < n; ++l) {
        previous = std::exchange(current, ((2 * l + 1) * x * current - l * previous) / (l + 1));
      }
      slope = n * (previous - x * current) / ((1 - x) * (1 + x));
      x -= current / slope;
    }
    grid.mu[i] = 0.5 * (1 + x);
    grid.weight[i] = 1 / ((1 - x) * (1 + x) * slope * slope);
  }
  return grid;
}

AngularGrid make_split_grid(int n, double split) {
  assert(split > 0 && split < 1);
  const AngularGrid gauss = make_gauss_grid(n);
  AngularGrid grid;
  for (int i = 0; i < n; ++i) {
    grid.mu.push_back(split * gauss.mu[i]);
    grid.weight.push_back(split * gauss.weight[i]);
  }
  for (int i = 0; i < n; ++i) {
    grid.mu.push_back(split + (1 - split) * gauss.mu[i] * gauss.mu[i]);
    grid.weight.push_back((1 - split) * 2 * gauss.mu[i] * gauss.weight[i]);
  }
  grid.degree = exact_degree(grid, 4 * n - 1);
  return grid;
}

HalfSpace::HalfSpace(AngularGrid grid, double g)
    : grid_(std::move(grid)),
      even_(scattering_operator(grid_, g, 0)),
      odd_(scattering_operator(grid_, g, 1)) {
  assert(std::abs(g) < 1);
}

// With s and d the sum and the difference of the radiance down and up, weighted by sqrt(weight mu), transfer
// reads s' = -P d, d' = -Q s, with P and Q symmetric and positive. What decays with depth obeys d = Y s with
// Y P Y = Q: Y is the geometric mean of P^-1 and Q. From the Cholesky factors P = L L^T, Q = N N^T and the
// polar factor U of L^T N, Y^-1 = L U N^-1. The reflection is (1 - Y)(1 + Y)^-1 = 1 - 2 (1 + Y^-1)^-1: the
// half-space returns all but the second term, which is 2 N (N + L U)^-1 and small without cancellation as
// albedo -> 1.
SquareMatrix HalfSpace::loss(double albedo) const {
  assert(albedo >= 0 && albedo <= 1);
  albedo = std::min(albedo, kLargestAlbedo);
  const SquareMatrix lower_p = cholesky(transport_operator(odd_, grid_.mu, albedo));
  const SquareMatrix lower_q = cholesky(transport_operator(even_, grid_.mu, albedo));
  SquareMatrix sum = multiply(lower_p, polar_factor(multiply(transpose(lower_p), lower_q)));
  for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += lower_q.values[i];
  SquareMatrix result = multiply(lower_q, invert(std::move(sum)));
  for (double& x : result.values) x *= 2;
  return result;
}

double HalfSpace::diffuse_reflectance(double albedo) const {
  const SquareMatrix lost = loss(albedo);
  double sum = 0;
  for (int i = 0; i < lost.n; ++i) {
    for (int j = 0; j < lost.n; ++j) {
      sum += lost.at(i, j) * std::sqrt(grid_.weight[i] * grid_.mu[i] * grid_.weight[j] * grid_.mu[j]);
    }
  }
  return std::clamp(1 - 2 * sum, 0.0, 1.0);
}

// The radiance going down just inside, x, is what comes in plus what the mirror sends back of (1 - loss) x.
// With T the diagonal of 1 - mirror that reads (T + (1 - T) loss) x = T incident, without cancellation.
double HalfSpace::absorbed_fraction(double albedo, const std::vector<double>& mirror) const {
  assert(mirror.size() == grid_.mu.size());
  const SquareMatrix lost = loss(albedo);
  SquareMatrix system(lost.n);
  std::vector<double> flux(lost.n);
  for (int i = 0; i < lost.n; ++i) {
    for (int j = 0; j < lost.n; ++j) system.at(i, j) = mirror[i] * lost.at(i, j);
    system.at(i, i) += 1 - mirror[i];
    flux[i] = std::sqrt(grid_.weight[i] * grid_.mu[i]);
  }
  const SquareMatrix inverse = invert(std::move(system));
  double entered = 0;
  double absorbed = 0;
  for (int i = 0; i < lost.n; ++i) {
    const double incident = (1 - mirror[i]) * flux[i];
    entered += flux[i] * incident;
    double down = 0;
    for (int j = 0; j < lost.n; ++j) down += inverse.at(i, j) * (1 - mirror[j]) * flux[j];
    for (int j = 0; j < lost.n; ++j) absorbed += flux[j] * lost.at(j, i) * down;
  }
  return absorbed / entered;
}

// As above with a full matrix M for the mirror: (1 - M + M loss) x = (1 - M) uniform, because light that is
// uniform on both sides stays so.
double HalfSpace::absorbed_fraction(double albedo, const SquareMatrix& mirror) const {
  assert(mirror.n == static_cast<int>(grid_.mu.size()));
  const SquareMatrix lost = loss(albedo);
  SquareMatrix system = multiply(mirror, lost);
  std::vector<double> flux(lost.n);
  for (int i = 0; i < lost.n; ++i) flux[i] = std::sqrt(grid_.weight[i] * grid_.mu[i]);
  std::vector<double> incident = flux;
  for (int i = 0; i < lost.n; ++i) {
    for (int j = 0; j < lost.n; ++j) {
      system.at(i, j) += (i == j ? 1.0 : 0.0) - mirror.at(i, j);
      incident[i] -= mirror.at(i, j) * flux[j];
    }
  }
  const SquareMatrix inverse = invert(std::move(system));
  double entered = 0;
  double absorbed = 0;
  for (int i = 0; i < lost.n; ++i) {
    entered += flux[i] * incident[i];
    double down = 0;
    for (int j = 0; j < lost.n; ++j) down += inverse.at(i, j) * incident[j];
    for (int j = 0; j < lost.n; ++j) absorbed += flux[j] * lost.at(j, i) * down;
  }
  return absorbed / entered;
}

SquareMatrix HalfSpace::reflection(double albedo) const {
  const SquareMatrix lost = loss(albedo);
  SquareMatrix result(lost.n);
  for (int i = 0; i < lost.n; ++i) {
    for (int j = 0; j < lost.n; ++j) {
      const double norm = 2 * std::sqrt((grid_.weight[i] * grid_.mu[i]) * (grid_.weight[j] * grid_.mu[j]));
      result.at(i, j) = ((i == j ? 1.0 : 0.0) - 0.5 * (lost.at(i, j) + lost.at(j, i))) / norm;
    }
  }
  return result;
}

}  // namespace meander
