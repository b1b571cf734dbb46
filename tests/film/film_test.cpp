#include "film/film.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "math/random.h"

namespace meander {

namespace {

/// Variance of the mean by the textbook's two passes.
double two_pass(const std::vector<double>& samples) {
  const double n = static_cast<double>(samples.size());
  double sum = 0;
  for (const double x : samples) sum += x;
  double squares = 0;
  for (const double x : samples) squares += (x - sum / n) * (x - sum / n);
  return squares / (n - 1) / n;
}

Pixel make_pixel(std::initializer_list<Rgb> samples) {
  Pixel pixel;
  for (const Rgb& sample : samples) pixel.add(sample);
  return pixel;
}

}  // namespace

TEST_CASE("a pixel holds the mean, the count and the two-pass variance of its samples, per channel") {
  Random random = stream(1, 2, 3);
  Pixel pixel;
  std::vector<double> channels[3];
  for (int i = 0; i < 1000; ++i) {
    const Real u = random.next();
    const Rgb sample(u, u * u * 5, 1 - u);
    pixel.add(sample);
    for (int c = 0; c < 3; ++c) channels[c].push_back(static_cast<double>(sample[c]));
  }
  CHECK(pixel.count == 1000);
  for (int c = 0; c < 3; ++c) {
    double sum = 0;
    for (const double x : channels[c]) sum += x;
    CHECK(pixel.mean[c] == doctest::Approx(sum / 1000).epsilon(1e-13));
    CHECK(pixel.variance_of_mean()[c] == doctest::Approx(two_pass(channels[c])).epsilon(1e-12));
  }
}

TEST_CASE("the variance survives an offset of 1e8 that would drown a sum of squares") {
  Pixel pixel;
  std::vector<double> samples;
  for (int i = 0; i < 4000; ++i) {
    const Real x = Real(1e8) + Real(8 * (i % 4));  // multiples of 8: exact in float
    pixel.add(Rgb(x, 1, 0));
    samples.push_back(static_cast<double>(x));
  }
  CHECK(pixel.mean[0] == doctest::Approx(1e8 + 12).epsilon(1e-15));
  CHECK(pixel.variance_of_mean()[0] == doctest::Approx(two_pass(samples)).epsilon(1e-8));
  CHECK(pixel.variance_of_mean()[0] == doctest::Approx(80.0 / 3999).epsilon(1e-8));
  CHECK(pixel.variance_of_mean()[1] == 0);
}

TEST_CASE("below two samples the variance of the mean is 0") {
  CHECK(Pixel{}.variance_of_mean()[0] == 0);
  CHECK(make_pixel({Rgb(5)}).variance_of_mean()[1] == 0);
  CHECK(make_pixel({Rgb(5)}).mean[1] == 5);
  CHECK(make_pixel({Rgb(5), Rgb(7)}).variance_of_mean()[1] == 1);
}

TEST_CASE("a resolved film is its means and their variances, pixel by pixel") {
  Film film(3, 2);
  film.at(2, 1) = make_pixel({Rgb(1, 10, 100), Rgb(3, 14, 100)});
  film.at(1, 0) = make_pixel({Rgb(0.5, 0, 0)});
  const Image image = resolve(film);
  CHECK(image.width == 3);
  CHECK(image.height == 2);
  REQUIRE(image.channels == 6);
  const float expected[6] = {2, 12, 100, 1, 4, 0};
  for (int c = 0; c < 6; ++c) CHECK(image.at(2, 1)[c] == expected[c]);
  CHECK(image.at(1, 0)[0] == 0.5f);
  CHECK(image.at(1, 0)[3] == 0);
  CHECK(image.at(0, 0)[0] == 0);
}

TEST_CASE("the mean of a film weighs pixels equally, whatever their counts") {
  Film film(2, 1);
  film.at(0, 0) = make_pixel({Rgb(1, 2, 3)});
  film.at(1, 0) = make_pixel({Rgb(3, 0, 3), Rgb(3, 0, 3), Rgb(3, 0, 3)});
  const std::array<double, 3> mean = mean_of(film);
  CHECK(mean[0] == 2);
  CHECK(mean[1] == 1);
  CHECK(mean[2] == 3);
  CHECK(mean_of(Film{})[0] == 0);
}

TEST_CASE("planes show the mean, its variance, the samples, and paths weighed by the light they brought") {
  Film film(3, 2);
  Pixel& pixel = film.at(2, 1);
  pixel.add(Rgb(1, 2, 3));
  pixel.add(Rgb(3, 2, 7));
  pixel.paths += {2, 2 * 5, 2 * 0.25};  // luminance 2 after 5 scatterings and a length of 0.25
  pixel.paths += {6, 6 * 1, 6 * 4.25};
  Image normals(3, 2, 3);
  normals.at(2, 1)[0] = 0.5f;
  normals.at(2, 1)[1] = -0.25f;
  normals.at(2, 1)[2] = 0.75f;
  const FilmPlanes planes = resolve_planes(film, &normals);
  const auto holds = [](const Image& image, int x, int y, std::array<float, 4> expected) {
    REQUIRE(image.channels == 4);
    for (int c = 0; c < 4; ++c) CHECK(image.at(x, y)[c] == expected[c]);
  };
  holds(planes.radiance, 2, 1, {2, 2, 5, 2});
  holds(planes.error, 2, 1, {1, 0, 4, 2});  // (5 * 2 + 1 * 6) / 8
  holds(planes.features, 2, 1, {3.25f, 0.5f, -0.25f, 0.75f});
  holds(planes.radiance, 1, 1, {0, 0, 0, 0});
  holds(planes.error, 1, 1, {0, 0, 0, 0});  // no light, no paths: 0, not 0/0
  holds(planes.features, 1, 1, {0, 0, 0, 0});
  holds(resolve_planes(film, nullptr).features, 2, 1, {3.25f, 0, 0, 0});
}

TEST_CASE(
    "the variance of a stratified mean is what such means scatter by, whatever is left of the last round") {
  // Three strata that differ by more than they scatter, drawn in turns from a random one on.
  for (const int samples : {16, 24, 25, 26, 200}) {
    double reported = 0;
    double independent = 0;
    double sum = 0;
    double squares = 0;
    constexpr int kPixels = 20000;
    for (std::uint32_t i = 0; i < kPixels; ++i) {
      Random random = stream(3, i, static_cast<std::uint32_t>(samples));
      const int first = static_cast<int>(random.next() * 3);
      Pixel pixel;
      for (int k = 0; k < samples; ++k) {
        const int stratum = (first + k) % 3;
        pixel.add(Rgb(static_cast<Real>(stratum * stratum) + random.next()), stratum);
      }
      const double mean = pixel.mean[1];
      sum += mean;
      squares += mean * mean;
      reported += pixel.variance_of_mean()[1] / kPixels;
      independent += pixel.m2[1] / (samples - 1) / samples / kPixels;
    }
    const double mean = sum / kPixels;
    const double variance = squares / kPixels - mean * mean;
    INFO(samples, " samples");
    CHECK(mean == doctest::Approx(5.0 / 3 + 0.5).epsilon(5e-3));
    CHECK(reported == doctest::Approx(variance).epsilon(0.04));  // 4 standard errors of `variance`
    CHECK(independent > 5 * variance);
  }
}

TEST_CASE("a stratified mean of few samples has the variance of an independent one") {
  Pixel stratified;
  Pixel plain;
  for (int k = 0; k + 1 < static_cast<int>(kFewestStratified); ++k) {
    stratified.add(Rgb(static_cast<Real>(k % 3)), k % 3);
    plain.add(Rgb(static_cast<Real>(k % 3)));
  }
  CHECK(stratified.variance_of_mean() == plain.variance_of_mean());
  CHECK(stratified.mean == plain.mean);
  stratified.add(Rgb(0), 0);
  CHECK(stratified.variance_of_mean()[0] < plain.variance_of_mean()[0] / 10);
}

}  // namespace meander
