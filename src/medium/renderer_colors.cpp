#include "medium/renderer_colors.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "medium/coefficients.h"

namespace meander {

namespace {

// Enough halvings for a tiny colour to have all its digits.
constexpr int kHalvings = 160;

// The least colour whose albedo, which increases with it, is at least the one wanted.
template <class AlbedoOf>
double least_color(double albedo, const AlbedoOf& albedo_of_color) {
  if (!(albedo > albedo_of_color(0))) return 0;
  double low = 0;
  double high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (albedo_of_color(middle) < albedo ? low : high) = middle;
  }
  return high;
}

double polynomial(const std::array<double, 8>& coefficients, double x) {
  double sum = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * x + *c;
  return sum;
}

// The fit's six functions of g.
struct Fit {
  double a, b, c, d, e, f;
};

Fit fit_of(double g) {
  return {
      polynomial({1.8260523782, -1.28451056436, -1.79904629312, 9.19393289202, -22.8215585862, 32.0234874259,
                  -23.6264803333, 7.21067002658},
                 g),
      4.98511194385 +
          0.127355959438 * std::exp(polynomial({0, 31.1491581433, -201.847017512, 841.576016723,
                                                -2018.09288505, 2731.71560286, -1935.41424244, 559.009054474},
                                               g)),
      polynomial({1.09686102424, -0.394704063468, 1.05258115941, -8.83963712726, 28.8643230661,
                  -46.8802913581, 38.5402837518, -12.7181042538},
                 g),
      polynomial({0.496310210422, 0.360146581622, -2.15139309747, 17.8896899217, -55.2984010333, 82.065982243,
                  -58.5106008578, 15.8478295021},
                 g),
      4.23190299701 + 0.00310603949088 *
                          std::exp(polynomial({0, 76.7316253952, -594.356773233, 2448.8834203, -5576.68528998,
                                               7116.60171912, -4763.54467887, 1303.5318055},
                                              g)),
      polynomial({2.40602999408, -2.51814844609, 9.18494908356, -79.2191708682, 259.082868209, -403.613804597,
                  302.85712436, -87.4370473567},
                 g)};
}

double evaluate(const Fit& fit, double color) {
  const double blend = std::pow(color, 0.25);
  const double albedo = (1 - blend) * fit.a * std::pow(std::atan(fit.b * color), fit.c) +
                        blend * fit.d * std::pow(std::atan(fit.e * color), fit.f);
  return std::clamp(albedo, 0.0, kCyclesLargestAlbedo);
}

}  // namespace

double openpbr_albedo(double color, double g) {
  return albedo_of(coefficients_from_color(DVec3(color), DVec3(1), g, Inversion::van_de_hulst)).x;
}

double openpbr_color(double albedo, double g) {
  assert(albedo >= 0 && albedo <= 1 && std::abs(g) < 1);
  return least_color(albedo, [g](double color) { return openpbr_albedo(color, g); });
}

double cycles_albedo(double color, double g) {
  assert(color >= 0 && color <= 1 && g >= kCyclesLeastG && g <= kCyclesLargestG);
  return evaluate(fit_of(g), color);
}

double cycles_color(double albedo, double g) {
  assert(albedo >= 0 && albedo <= 1 && g >= kCyclesLeastG && g <= kCyclesLargestG);
  const Fit fit = fit_of(g);
  return least_color(std::min(albedo, kCyclesLargestAlbedo),
                     [&fit](double color) { return evaluate(fit, color); });
}

}  // namespace meander
