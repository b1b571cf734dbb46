#include "medium/square_matrix.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace meander {

namespace {

double frobenius_norm(const SquareMatrix& a) {
  double sum = 0;
  for (const double x : a.values) sum += x * x;
  return std::sqrt(sum);
}

/// target += factor * source over n entries.
void add_row(double* target, const double* source, double factor, int n) {
  for (int j = 0; j < n; ++j) target[j] += factor * source[j];
}

}  // namespace

SquareMatrix transpose(const SquareMatrix& a) {
  SquareMatrix result(a.n);
  for (int i = 0; i < a.n; ++i) {
    for (int j = 0; j < a.n; ++j) result.at(j, i) = a.at(i, j);
  }
  return result;
}

SquareMatrix multiply(const SquareMatrix& a, const SquareMatrix& b) {
  assert(a.n == b.n);
  SquareMatrix result(a.n);
  for (int i = 0; i < a.n; ++i) {
    for (int k = 0; k < a.n; ++k) add_row(result.row(i), b.row(k), a.at(i, k), a.n);
  }
  return result;
}

SquareMatrix cholesky(const SquareMatrix& a) {
  SquareMatrix lower(a.n);
  for (int i = 0; i < a.n; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a.at(i, j);
      for (int k = 0; k < j; ++k) sum -= lower.at(i, k) * lower.at(j, k);
      assert(i != j || sum > 0);
      lower.at(i, j) = i == j ? std::sqrt(sum) : sum / lower.at(j, j);
    }
  }
  return lower;
}

SquareMatrix invert(SquareMatrix a) {
  const int n = a.n;
  std::vector<int> pivots(n);
  for (int k = 0; k < n; ++k) {
    int p = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(a.at(i, k)) > std::abs(a.at(p, k))) p = i;
    }
    assert(a.at(p, k) != 0);
    pivots[k] = p;
    if (p != k) std::swap_ranges(a.row(k), a.row(k) + n, a.row(p));
    const double inverse = 1 / a.at(k, k);
    a.at(k, k) = 1;
    for (int j = 0; j < n; ++j) a.at(k, j) *= inverse;
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a.at(i, k);
      a.at(i, k) = 0;
      add_row(a.row(i), a.row(k), -factor, n);
    }
  }
  for (int k = n - 1; k >= 0; --k) {  // the row exchanges of a are column exchanges of its inverse
    if (pivots[k] == k) continue;
    for (int i = 0; i < n; ++i) std::swap(a.at(i, k), a.at(i, pivots[k]));
  }
  return a;
}

SquareMatrix polar_factor(SquareMatrix a) {
  double change = 1;
  for (int step = 0; step < 40 && change > 1e-9; ++step) {  // quadratic: 1e-9 now is 1e-18 after this step
    const SquareMatrix inverse_transposed = transpose(invert(a));
    const double norm = frobenius_norm(a);
    // Scaling speeds up the start and would only disturb the end.
    const double scale = change < 1e-2 ? 1 : std::sqrt(frobenius_norm(inverse_transposed) / norm);
    double difference = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      const double next = 0.5 * (scale * a.values[i] + inverse_transposed.values[i] / scale);
      difference += (next - a.values[i]) * (next - a.values[i]);
      a.values[i] = next;
    }
    change = std::sqrt(difference) / norm;
  }
  return a;
}

}  // namespace meander
