#include "film/noise.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/random.h"

namespace meander {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Pixel make_pixel(std::initializer_list<Rgb> samples) {
  Pixel pixel;
  for (const Rgb& sample : samples) pixel.add(sample);
  return pixel;
}

double noise(const Film& film, const std::vector<std::uint8_t>& mask) {
  return estimate_noise(film, mask).noise;
}

// A film whose samples are 1 but for one in `rarity`, which is `bright`.
Film rare_film(int size, int samples, int rarity, Real bright) {
  Film film(size, size);
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    Random random = stream(5, static_cast<std::uint32_t>(i), 0);
    for (int k = 0; k < samples; ++k)
      film.pixels[i].add(Rgb(random.next() * static_cast<Real>(rarity) < 1 ? bright : Real(1)));
  }
  return film;
}

double true_noise(int samples, double rarity, double bright) {
  const double p = 1 / rarity;
  const double mean = 1 + p * (bright - 1);
  return std::sqrt(p * (1 - p) * (bright - 1) * (bright - 1) / samples / (mean * mean + 1e-4));
}

}  // namespace

TEST_CASE("relative noise is the documented root mean over channels and masked pixels") {
  Film film(2, 1);
  film.at(0, 0) = make_pixel({Rgb(1, 0, 2), Rgb(3, 0, 2)});    // means 2, 0, 2; variances 1, 0, 0
  film.at(1, 0) = make_pixel({Rgb(-1, 4, 4), Rgb(1, 6, 12)});  // means 0, 5, 8; variances 1, 1, 16
  const double left = 1 / (4 + 1e-4);
  const double right = 1 / 1e-4 + 1 / (25 + 1e-4) + 16 / (64 + 1e-4);
  const double both = 2 / (1 + 1e-4) + 1 / (6.25 + 1e-4) + 16 / (25 + 1e-4);  // means 1, 2.5, 5
  CHECK(noise(film, {1, 0}) == doctest::Approx(std::sqrt(left / 3)).epsilon(1e-13));
  CHECK(noise(film, {0, 255}) == doctest::Approx(std::sqrt(right / 3)).epsilon(1e-13));
  for (const std::vector<std::uint8_t>& all : {std::vector<std::uint8_t>{1, 1}, {}, {0, 0}}) {
    CHECK(noise(film, all) == doctest::Approx(std::sqrt(both / 6)).epsilon(1e-13));
    CHECK(estimate_noise(film, all).own == doctest::Approx(std::sqrt((left + right) / 6)).epsilon(1e-13));
  }
  CHECK(noise({}, {}) == 0);
}

TEST_CASE("the mean is that of the counted pixels among the nine") {
  Film film(4, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) film.at(x, y) = make_pixel({Rgb(Real(x + 10 * y)), Rgb(Real(x + 10 * y))});
  film.at(1, 1) = make_pixel({Rgb(10), Rgb(12)});  // 11 as well, variance 1
  const auto expected = [](double mean, int pixels) {
    return doctest::Approx(std::sqrt(1 / (mean * mean + 1e-4) / pixels)).epsilon(1e-13);
  };
  CHECK(noise(film, {}) == expected(11, 12));  // the nine are 0 1 2, 10 11 12, 20 21 22
  CHECK(noise(film, {0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 1}) ==
        expected(11, 4));  // column 3 is none of the nine
  CHECK(noise(film, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}) == expected(5.5, 2));
}

TEST_CASE("noise is infinite while a counted pixel has fewer than two samples, and only then") {
  Film film(2, 1);
  CHECK(noise(film, {}) == kInfinity);
  film.at(0, 0) = make_pixel({Rgb(1), Rgb(1)});
  film.at(1, 0) = make_pixel({Rgb(1)});
  CHECK(noise(film, {1, 1}) == kInfinity);
  CHECK(estimate_noise(film, std::vector<std::uint8_t>{1, 1}).doubt == NoiseDoubt::too_few_samples);
  CHECK(noise(film, {1, 0}) == 0);
  CHECK(estimate_noise(film, std::vector<std::uint8_t>{1, 0}).reliable());  // nothing varies: nothing to doubt
}

TEST_CASE("ordinary noise is met within its standard error and not doubted") {
  const NoiseEstimate estimate = estimate_noise(rare_film(32, 64, 2, 3), {});
  const double truth = true_noise(64, 2, 3);
  CHECK(estimate.reliable());
  CHECK(estimate.standard_error < 0.01);
  CHECK(std::abs(estimate.noise - truth) < 4 * estimate.standard_error * truth + 0.01 * truth);
}

TEST_CASE("noise that rare bright samples carry is doubted, and its own division hides it") {
  // One sample in 3000 is 1000: on average one pixel in 47 has met one.
  const NoiseEstimate estimate = estimate_noise(rare_film(32, 64, 3000, 1000), {});
  CHECK(estimate.doubt == NoiseDoubt::rare_bright_samples);
  CHECK(estimate.own < 0.2 * true_noise(64, 3000, 1000));
  CHECK(estimate.own <= 1);
  // Where every pixel has met many of them there is nothing to doubt.
  CHECK(estimate_noise(rare_film(16, 60000, 3000, 1000), {}).reliable());
}

TEST_CASE("a handful of pixels cannot tell their noise, a single one never") {
  const Film film = rare_film(32, 4, 2, 3);
  std::vector<std::uint8_t> mask(film.pixels.size(), 0);
  mask[0] = 1;
  CHECK(estimate_noise(film, mask).standard_error == kInfinity);
  mask[1] = mask[2] = 1;
  CHECK(estimate_noise(film, mask).doubt == NoiseDoubt::too_few_pixels);
}

TEST_CASE("the noise of a resolved film is that of the film, and the hand-computed one") {
  const Film film = rare_film(12, 40, 10, 5);
  std::vector<std::uint8_t> mask(film.pixels.size(), 1);
  for (std::size_t i = 0; i < 30; ++i) mask[i * 3] = 0;
  const NoiseEstimate direct = estimate_noise(film, mask);
  const NoiseEstimate resolved = estimate_noise(resolve(film), mask);
  CHECK(resolved.noise == doctest::Approx(direct.noise).epsilon(1e-6));
  CHECK(resolved.own == doctest::Approx(direct.own).epsilon(1e-6));
  CHECK(resolved.standard_error == doctest::Approx(direct.standard_error).epsilon(1e-5));
  // Two pixels, means (1, 2, 0) and (-1, 5, 3): own v / (m^2 + 1e-4) is 0.25 / 1.0001, 0.04 / 4.0001,
  // 1e-4 / 1e-4 | 0, 0, 0.09 / 9.0001. The means of both are (0, 3.5, 1.5), so that v / (m^2 + 1e-4) is
  // 0.25 / 1e-4, 0.04 / 12.2501, 1e-4 / 2.2501 | 0, 0, 0.09 / 2.2501.
  Image image(2, 1, 6);
  image.values = {1, 2, 0, 0.25f, 0.04f, 1e-4f, -1, 5, 3, 0, 0, 0.09f};
  const double own = 0.25 / 1.0001 + 0.04 / 4.0001 + 1 + 0.09 / 9.0001;
  const double shared = 2500 + 0.04 / 12.2501 + 1e-4 / 2.2501 + 0.09 / 2.2501;
  const NoiseEstimate both = estimate_noise(image, {});
  CHECK(both.own == doctest::Approx(std::sqrt(own / 6)).epsilon(1e-6));
  CHECK(both.noise == doctest::Approx(std::sqrt(shared / 6)).epsilon(1e-6));
  const std::vector<std::uint8_t> only_first = {1, 0};
  const double first = 0.25 / 1.0001 + 0.04 / 4.0001 + 1;
  CHECK(estimate_noise(image, only_first).noise == doctest::Approx(std::sqrt(first / 3)).epsilon(1e-6));
}

}  // namespace meander
