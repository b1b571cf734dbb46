// Diffuse reflection of a homogeneous half-space with Henyey-Greenstein scattering and no index step, without
// Monte Carlo noise: discrete ordinates, solved for the infinite depth in one go.
#pragma once

#include <vector>

#include "medium/square_matrix.h"

namespace meander {

/// Quadrature over the cosines (0, 1) with unit total weight. `degree` is the highest Legendre moment of the
/// phase function that the grid carries; the rule must integrate polynomials of that degree exactly.
struct AngularGrid {
  std::vector<double> mu;
  std::vector<double> weight;
  int degree = 0;
};

/// Gauss-Legendre rule of n >= 2 nodes on (0, 1), ascending, degree 2n - 1.
[[nodiscard]] AngularGrid make_gauss_grid(int n);

/// n >= 2 nodes on (0, split) and n on (split, 1), ascending; 0 < split < 1. The upper panel is Gaussian in
/// sqrt(mu - split), which smooths what starts as a square root at the split, as Fresnel transmission does at
/// the critical angle. The degree is the highest below 4n up to which the rule is exact to 1e-12.
[[nodiscard]] AngularGrid make_split_grid(int n, double split);

/// The half-space of one g (|g| < 1) on one grid, for any albedo. The azimuthal mean alone is solved, which
/// is all that fluxes need. Moments above the grid's degree are lumped: a forward peak for g > 0 (delta-M,
/// Wiscombe 1977), a backward one for g < 0.
class HalfSpace {
 public:
  HalfSpace(AngularGrid grid, double g);

  /// Reflected flux over incident flux under uniform light, in [0, 1]. albedo in [0, 1 - 1e-12]; larger ones
  /// count as that.
  [[nodiscard]] double diffuse_reflectance(double albedo) const;

  /// The part that is absorbed of the light that enters, in (0, 1], below a smooth surface with uniform light
  /// outside: `mirror` holds, per node of the grid, the fraction in [0, 1] that the surface sends back down
  /// and keeps from coming in. Full relative precision towards white. Albedo as above.
  [[nodiscard]] double absorbed_fraction(double albedo, const std::vector<double>& mirror) const;

  /// The same below a surface that turns what it sends back: `mirror` is symmetric, in coordinates where
  /// radiance is weighted by sqrt(weight mu).
  [[nodiscard]] double absorbed_fraction(double albedo, const SquareMatrix& mirror) const;

  /// The symmetric reflection function on the grid: light coming down with radiance I_j at mu_j leaves as
  /// 2 sum_j R(i, j) mu_j weight_j I_j at mu_i; 1 everywhere for a white Lambertian surface. Albedo as above.
  [[nodiscard]] SquareMatrix reflection(double albedo) const;

  [[nodiscard]] const AngularGrid& grid() const noexcept { return grid_; }

 private:
  [[nodiscard]] SquareMatrix loss(double albedo) const;

  AngularGrid grid_;
  SquareMatrix even_;  // scattering between the sums and between the differences of up and down,
  SquareMatrix odd_;   // in coordinates where radiance is weighted by sqrt(weight)
};

}  // namespace meander
