#include "medium/color_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "medium/half_space.h"
#include "medium/rough_mirror.h"

namespace meander {

namespace {

constexpr double kLargestG = 0.9999;
constexpr int kOrdinates = 32;
constexpr double kLargestIor = 4;

struct ValueAndSlope {
  double value;
  double slope;
};

/// The root in [0, 1] of an increasing function that is <= 0 at 0 and >= 0 at 1: Newton, kept inside the
/// bracket by bisection.
template <class Function>
double find_root(const Function& function, double x) {
  double low = 0;
  double high = 1;
  for (int step = 0; step < 80; ++step) {
    const ValueAndSlope f = function(x);
    if (f.value == 0) return x;
    (f.value < 0 ? low : high) = x;
    double next = x - f.value / f.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 2e-16 * x) return next;
    x = next;
  }
  return x;
}

/// sum_k c_k T_k(2 x - 1) and its derivative by x (Clenshaw 1955).
template <std::size_t N>
ValueAndSlope eval_chebyshev(const std::array<double, N>& c, double x) {
  const double y = 2 * x - 1;
  ValueAndSlope b1{0, 0};
  ValueAndSlope b2{0, 0};
  for (std::size_t k = N; k-- > 1;) {
    const ValueAndSlope b{2 * y * b1.value - b2.value + c[k], 2 * b1.value + 2 * y * b1.slope - b2.slope};
    b2 = b1;
    b1 = b;
  }
  return {y * b1.value - b2.value + c[0], 2 * (b1.value + y * b1.slope - b2.slope)};
}

/// How the interpolation variable x in [0, 1] runs over the similarity variable, s = x (1 + bend (1 - x)):
/// the curve of a strong forward peak turns within 1 - g of s = 1, that of a strong backward peak within
/// sqrt(1 + g) of s = 0.
double bend_of(double g) { return g > 0 ? 1 : g > -0.95 ? 0 : -0.9; }

double bent(double bend, double x) { return x * (1 + bend * (1 - x)); }

/// The x of s; no digits are lost near s = 0.
double unbent(double bend, double s) {
  return 2 * s / (1 + bend + std::sqrt((1 + bend) * (1 + bend) - 4 * bend * s));
}

// The isotropic half-space: s = (1 - A) over(A) / under(A), within 1.3e-6 in A of the exact H-function curve.
constexpr double kOver1 = 0.99305446, kOver2 = 0.018978894;
constexpr double kUnder1 = 2.4370427, kUnder2 = 1.2094936;

double isotropic_similarity(double color) {
  return (1 - color) * (1 + color * (kOver1 + color * kOver2)) / (1 + color * (kUnder1 + color * kUnder2));
}

/// (1 - s)/A of the same curve, where the ones have cancelled.
double isotropic_complement(double color) {
  const double linear = kUnder1 + 1 - kOver1;
  return (linear + color * (kUnder2 + kOver1 - kOver2 + color * kOver2)) /
         (1 + color * (kUnder1 + color * kUnder2));
}

/// The colour of s, given 1 - s as well: the root of the cubic that the fit is in A, sorted by powers of A.
double isotropic_color(double s, double one_minus_s) {
  return find_root(
      [&](double a) -> ValueAndSlope {
        const double first = s * kUnder1 + 1 - kOver1;
        const double second = s * kUnder2 + kOver1 - kOver2;
        return {a * (first + a * (second + a * kOver2)) - one_minus_s,
                first + a * (2 * second + 3 * a * kOver2)};
      },
      one_minus_s);
}

/// What the half-space keeps of the light that entered, on a grid that suits the surface. Backward peaks
/// need more nodes below a smooth interface, which is steep where they return the light.
class HalfSpaceAlbedo {
 public:
  HalfSpaceAlbedo(double g, const Surface& surface) : half_space_(make_grid(g, surface), g) {
    if (is_rough(surface)) rough_ = rough_mirror(half_space_.grid(), surface.roughness, surface.ior);
    for (const double mu : half_space_.grid().mu) {
      mirror_.push_back(is_mirror(surface) ? internal_reflectance(mu, surface.ior) : 0.0);
    }
  }

  [[nodiscard]] double absorbed(double albedo) const {
    if (rough_) return half_space_.absorbed_fraction(albedo, *rough_);
    return half_space_.absorbed_fraction(albedo, mirror_);
  }

 private:
  static bool is_mirror(const Surface& surface) {
    return surface.boundary == Boundary::dielectric && surface.ior > 1;
  }
  static bool is_rough(const Surface& surface) { return is_mirror(surface) && surface.roughness > 0; }
  static AngularGrid make_grid(double g, const Surface& surface) {
    if (!is_mirror(surface) || is_rough(surface)) return make_gauss_grid(kOrdinates);
    const double critical = std::sqrt((surface.ior - 1) * (surface.ior + 1)) / surface.ior;
    return make_split_grid(g < -0.7 ? kOrdinates : kOrdinates / 2, critical);
  }

  HalfSpace half_space_;
  std::vector<double> mirror_;
  std::optional<SquareMatrix> rough_;
};

}  // namespace

// The similarity variable s makes the curves of all g nearly one. What is interpolated is
// q = ((1 - A)/A) ((1 - s)/s), smooth, positive and of order 1: A = (1 - s)/((1 - s) + s q) is then right
// relatively at both ends. A diffuse boundary with an index step multiplies q by 1 / (1 - F).
ColorMap::ColorMap(double g, Surface surface)
    : g_(g), tabulated_(g != 0 || (surface.boundary != Boundary::matched && surface.ior > 1)) {
  assert(std::abs(g) < 1 && surface.ior >= 1 && surface.ior <= kLargestIor);
  if (!tabulated_) return;
  const double solved_g = std::clamp(g_, -kLargestG, kLargestG);
  const HalfSpaceAlbedo half_space(solved_g, surface);
  for (int k = 0; k < kNodes; ++k) {
    const double angle = std::numbers::pi * (k + 0.5) / kNodes;
    const double s = bent(bend_of(g_), 0.5 * (1 + std::cos(angle)));
    const double lost = half_space.absorbed((1 - s) * (1 + s) / (1 - solved_g * s * s));
    const double q = lost * (1 - s) / ((1 - lost) * s);
    for (int j = 0; j < kNodes; ++j) shape_[j] += (j == 0 ? 1 : 2) * q * std::cos(j * angle) / kNodes;
  }
  if (surface.boundary != Boundary::diffuse) return;
  for (double& c : shape_) c /= 1 - diffuse_internal_reflectance(surface.ior);
}

ColorMap::Similarity ColorMap::similarity_of(double color) const noexcept {
  const double guess = isotropic_similarity(color);
  if (!tabulated_) return {guess, color * isotropic_complement(color)};
  const double bend = bend_of(g_);
  const double x = find_root(
      [&](double t) -> ValueAndSlope {
        const ValueAndSlope q = eval_chebyshev(shape_, t);
        const double s = bent(bend, t);
        const double slope = 1 + bend - 2 * bend * t;
        return {color * s * q.value - (1 - color) * (1 - t) * (1 - bend * t),
                color * (slope * q.value + s * q.slope) + (1 - color) * slope};
      },
      unbent(bend, guess));
  return {bent(bend, x), (1 - x) * (1 - bend * x)};
}

double ColorMap::color(double albedo) const noexcept {
  assert(albedo >= 0 && albedo <= 1);
  const double s = std::sqrt((1 - albedo) / (1 - albedo * g_));
  const double one_minus = albedo * (1 - g_) / ((1 - albedo * g_) * (1 + s));
  if (!tabulated_) return isotropic_color(s, one_minus);
  return one_minus / (one_minus + s * eval_chebyshev(shape_, unbent(bend_of(g_), s)).value);
}

double ColorMap::albedo(double color) const noexcept {
  assert(color >= 0 && color <= 1);
  const Similarity similarity = similarity_of(color);
  return similarity.one_minus * (1 + similarity.s) / (1 - g_ * similarity.s * similarity.s);
}

double ColorMap::one_minus_albedo(double color) const noexcept {
  assert(color >= 0 && color <= 1);
  const double s = similarity_of(color).s;
  return s * s * (1 - g_) / (1 - g_ * s * s);
}

}  // namespace meander
