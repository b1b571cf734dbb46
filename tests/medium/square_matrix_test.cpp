#include "medium/square_matrix.h"

#include <doctest/doctest.h>

#include <cmath>

namespace meander {

namespace {

/// Full, regular and not symmetric; needs row exchanges.
SquareMatrix example(int n) {
  SquareMatrix a(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) a.at(i, j) = std::sin(1.0 + 3 * i + 7 * j * j) + (i + j == n - 1 ? 4 : 0);
  }
  return a;
}

double largest_difference(const SquareMatrix& a, const SquareMatrix& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    result = std::max(result, std::abs(a.values[i] - b.values[i]));
  }
  return result;
}

SquareMatrix identity(int n) {
  SquareMatrix result(n);
  for (int i = 0; i < n; ++i) result.at(i, i) = 1;
  return result;
}

}  // namespace

TEST_CASE("a matrix times its inverse is the identity, from both sides") {
  for (const int n : {1, 2, 7, 24}) {
    const SquareMatrix a = example(n);
    const SquareMatrix inverse = invert(a);
    CHECK(largest_difference(multiply(a, inverse), identity(n)) < 1e-12);
    CHECK(largest_difference(multiply(inverse, a), identity(n)) < 1e-12);
  }
}

TEST_CASE("the Cholesky factor is lower triangular and multiplies back to the matrix") {
  const SquareMatrix b = example(9);
  const SquareMatrix a = multiply(b, transpose(b));
  const SquareMatrix lower = cholesky(a);
  CHECK(largest_difference(multiply(lower, transpose(lower)), a) < 1e-12);
  for (int i = 0; i < 9; ++i) {
    CHECK(lower.at(i, i) > 0);
    for (int j = i + 1; j < 9; ++j) CHECK(lower.at(i, j) == 0);
  }
}

TEST_CASE(
    "the polar factor is orthogonal and leaves a symmetric positive factor, however badly scaled the "
    "matrix") {
  SquareMatrix a = example(12);
  for (int j = 0; j < 12; ++j) a.at(3, j) *= 1e-7;
  const SquareMatrix u = polar_factor(a);
  CHECK(largest_difference(multiply(u, transpose(u)), identity(12)) < 1e-13);
  const SquareMatrix h = multiply(a, transpose(u));
  CHECK(largest_difference(h, transpose(h)) < 1e-13);
  // The rounding of h itself may take its least eigenvalue, about 1e-7, nowhere near 0.
  const SquareMatrix lower = cholesky(h);
  for (int i = 0; i < 12; ++i) CHECK(lower.at(i, i) > 1e-8);
}

}  // namespace meander
