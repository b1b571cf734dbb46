// A small dense square matrix of doubles and the few decompositions the half-space solver needs.
#pragma once

#include <cstddef>
#include <vector>

namespace meander {

/// n x n, row by row; zero when made.
struct SquareMatrix {
  int n = 0;
  std::vector<double> values;

  explicit SquareMatrix(int size) : n(size), values(static_cast<std::size_t>(size) * size, 0.0) {}
  [[nodiscard]] double* row(int i) noexcept { return values.data() + static_cast<std::size_t>(i) * n; }
  [[nodiscard]] const double* row(int i) const noexcept {
    return values.data() + static_cast<std::size_t>(i) * n;
  }
  [[nodiscard]] double& at(int i, int j) noexcept { return row(i)[j]; }
  [[nodiscard]] double at(int i, int j) const noexcept { return row(i)[j]; }
};

[[nodiscard]] SquareMatrix transpose(const SquareMatrix& a);
[[nodiscard]] SquareMatrix multiply(const SquareMatrix& a, const SquareMatrix& b);

/// Lower triangle L with L L^T = a; a must be symmetric and positive definite.
[[nodiscard]] SquareMatrix cholesky(const SquareMatrix& a);

/// Gauss-Jordan elimination with partial pivoting; a must be regular.
[[nodiscard]] SquareMatrix invert(SquareMatrix a);

/// The orthogonal factor U of the polar decomposition a = H U, H symmetric and positive: Newton's iteration
/// with Frobenius scaling (Higham 1986, "Computing the Polar Decomposition - with Applications"). a must be
/// regular.
[[nodiscard]] SquareMatrix polar_factor(SquareMatrix a);

}  // namespace meander
