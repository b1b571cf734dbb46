#include "scene/environment_image.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "support/check_sampler.h"

using namespace meander;

namespace {

// Texel (x, y) is (x + 1, y + 1, 1): every texel tells where it is from.
Image numbered(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<float>(x + 1);
      image.at(x, y)[1] = static_cast<float>(y + 1);
      image.at(x, y)[2] = 1;
    }
  return image;
}

// Black but for one texel, which is (30, 10, 5).
Image one_texel(int width, int height, int x, int y) {
  Image image(width, height, 3);
  const float bright[] = {30, 10, 5};
  std::copy(bright, bright + 3, image.at(x, y));
  return image;
}

// Luminances over three decades, no two alike.
Image uneven(int width, int height) {
  Image image(width, height, 4);
  Random random = stream(11, 0, 0);
  for (float& value : image.values) value = static_cast<float>(std::pow(10, 3 * random.next() - 2));
  return image;
}

DMat3 turn_about_y(double degrees) {
  const double c = std::cos(glm::radians(degrees));
  const double s = std::sin(glm::radians(degrees));
  return {DVec3(c, 0, -s), DVec3(0, 1, 0), DVec3(s, 0, c)};  // columns
}

// Where a direction lies in an unrotated picture: from the left and from the top, both in [0, 1].
std::array<double, 2> place_of(const Vec3& d) {
  const double x = std::atan2(double{d.x}, -double{d.z}) / (2 * glm::pi<double>()) + 0.5;
  return {x, std::atan2(std::hypot(double{d.x}, double{d.z}), double{d.y}) / glm::pi<double>()};
}

Vec3 direction_to(double x, double y) {
  const double phi = 2 * glm::pi<double>() * (x - 0.5);
  const double theta = glm::pi<double>() * y;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

// Density over the places of a picture.
double place_density(const EnvironmentImage& environment, double x, double y) {
  const double jacobian = 2 * glm::pi<double>() * glm::pi<double>() * std::sin(glm::pi<double>() * y);
  return environment.pdf(direction_to(x, y)) * jacobian;
}

}  // namespace

TEST_CASE("the centre of the picture is seen along -z, its right toward +x, its first row at the zenith") {
  const EnvironmentImage environment(numbered(9, 5));
  CHECK(environment.radiance({0, 0, -1}) == Rgb(5, 3, 1));
  CHECK(environment.radiance({1, 0, 0}) == Rgb(7, 3, 1));
  CHECK(environment.radiance({-1, 0, 0}) == Rgb(3, 3, 1));
  CHECK(environment.radiance(glm::normalize(Vec3(Real(0.01), 0, 1))) == Rgb(9, 3, 1));
  CHECK(environment.radiance(glm::normalize(Vec3(Real(-0.01), 0, 1))) == Rgb(1, 3, 1));
  CHECK(environment.radiance({0, 1, 0}).y == 1);
  CHECK(environment.radiance({0, -1, 0}).y == 5);
  // Rows are of equal angle: the first of five ends 36 degrees from the zenith.
  CHECK(environment.radiance(direction_to(0.5, 0.199)) == Rgb(5, 1, 1));
  CHECK(environment.radiance(direction_to(0.5, 0.201)) == Rgb(5, 2, 1));
}

TEST_CASE("a rotation turns the surround about y: by 90 degrees, what was along -z is along -x") {
  const EnvironmentImage quarter(numbered(9, 5), 90);
  CHECK(quarter.radiance({-1, 0, 0}) == Rgb(5, 3, 1));
  CHECK(quarter.radiance({0, 0, -1}) == Rgb(7, 3, 1));
  const EnvironmentImage plain(uneven(9, 5));
  for (const double degrees : {90.0, -33.0, 360.0, 400.0, -1234.5}) {
    const EnvironmentImage turned(uneven(9, 5), degrees);
    const DMat3 turn = turn_about_y(degrees);
    for (std::uint32_t i = 0; i < 2000; ++i) {
      Random random = stream(1, 0, i);
      const Real u1 = random.next();
      const Vec2 u(u1, random.next());
      const auto from = plain.sample(u);
      const auto to = turned.sample(u);
      CHECK(glm::length(DVec3(to.direction) - turn * DVec3(from.direction)) < 1e-6);
      CHECK(to.radiance == from.radiance);
      const auto [x, y] = place_of(from.direction);
      if (std::abs(9 * x - std::round(9 * x)) < 1e-4 || std::abs(5 * y - std::round(5 * y)) < 1e-4) continue;
      CHECK(turned.radiance(to.direction) == from.radiance);
      CHECK(turned.pdf(to.direction) == from.pdf);
    }
  }
}

TEST_CASE("a scale multiplies the radiance and leaves the density alone") {
  const EnvironmentImage plain(uneven(8, 4));
  const EnvironmentImage bright(uneven(8, 4), 0, 4);
  for (const auto& u : {Vec2(0.1, 0.1), Vec2(0.5, 0.7), Vec2(0.9, 0.3)}) {
    const auto sample = bright.sample(u);
    CHECK(sample.radiance == Real(4) * plain.sample(u).radiance);
    CHECK(sample.direction == plain.sample(u).direction);
    CHECK(sample.pdf == doctest::Approx(plain.pdf(sample.direction)).epsilon(1e-6));
  }
  CHECK(EnvironmentImage(uneven(8, 4), 0, 0).sample({Real(0.5), Real(0.5)}).pdf == 0);
}

TEST_CASE("samples of a picture follow its density, which integrates to 1") {
  TestFamily family;
  for (const auto& [width, height] :
       {std::array{9, 5}, std::array{16, 8}, std::array{1, 7}, std::array{6, 1}}) {
    const EnvironmentImage environment(uneven(width, height));
    const auto sample = [&](const Vec2& u) { return place_of(environment.sample(u).direction); };
    const auto density = [&](double x, double y) { return place_density(environment, x, y); };
    const CellGrid grid{{0, 0}, {1, 1}, 2 * width, 3 * height};  // no cell spans two texels
    family.add("picture " + std::to_string(width), chi_square_p(sample, density, grid, 400'000));
  }
  family.check();
}

TEST_CASE("the density is luminance over its integral: a closed form for two rows") {
  Image image(3, 2, 3);
  for (int x = 0; x < 3; ++x)
    for (int c = 0; c < 3; ++c) {
      image.at(x, 0)[c] = 3;
      image.at(x, 1)[c] = 1;
    }
  const EnvironmentImage environment(image);  // each row is half the sphere
  CHECK(environment.pdf({0, Real(0.6), Real(0.8)}) == doctest::Approx(0.75 / (2 * glm::pi<double>())));
  CHECK(environment.pdf({Real(0.8), Real(-0.6), 0}) == doctest::Approx(0.25 / (2 * glm::pi<double>())));
}

TEST_CASE("a sample carries its own texel's radiance and density, at the extremes too") {
  const EnvironmentImage environment(uneven(33, 17), 20);
  check_extremes<2>(
      [&](const std::array<Real, 2>& u) {
        return environment.sample({u[0], u[1]});
      },
      [](const EnvironmentImage::Sample& s) {
        return std::abs(glm::length(s.direction) - 1) < 1e-6 && s.pdf > 0 && s.radiance.x > 0;
      });
  int elsewhere = 0;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    Random random = stream(2, 0, i);
    const Real u1 = random.next();
    const auto sample = environment.sample({u1, random.next()});
    if (environment.radiance(sample.direction) != sample.radiance) {
      ++elsewhere;  // on a texel's border, where rounding decides
      continue;
    }
    CHECK(environment.pdf(sample.direction) == sample.pdf);
  }
  CHECK(elsewhere < 20);
}

TEST_CASE("black texels are never drawn: all samples fall on the one that shines") {
  const int width = 4096;
  const int height = 2048;
  for (const auto& [x, y] : {std::array{0, 0}, std::array{width - 1, height - 1}, std::array{1234, 1},
                             std::array{width / 2, height / 2}, std::array{17, height - 2}}) {
    CAPTURE(x);
    CAPTURE(y);
    const EnvironmentImage environment(one_texel(width, height, x, y));
    const double step = glm::pi<double>() / height;
    const double angle = 2 * glm::pi<double>() / width * (std::cos(y * step) - std::cos((y + 1) * step));
    double worst = 0;
    const auto check = [&](const Vec2& u) {
      const auto sample = environment.sample(u);
      CHECK(sample.radiance == Rgb(30, 10, 5));
      CHECK(sample.pdf == doctest::Approx(1 / angle).epsilon(1e-5));
      const auto place = place_of(sample.direction);
      worst = larger_error(worst, std::abs(place[1] * height - (y + 0.5)) - 0.5);
      const double off = std::abs(place[0] * width - (x + 0.5));
      const bool pole = std::hypot(sample.direction.x, sample.direction.z) < 1e-12;
      if (!pole) worst = larger_error(worst, std::min(off, width - off) - 0.5);
    };
    for (const Real u1 : {Real(0), Real(0.3), kLargestRandom})
      for (const Real u2 : {Real(0), Real(0.6), kLargestRandom}) check({u1, u2});
    CHECK(worst < 1e-3);  // of a texel
  }
}

TEST_CASE("a row's samples are uniform in solid angle, down to the pole") {
  const EnvironmentImage environment(one_texel(8, 512, 3, 0));
  const double edge = glm::pi<double>() / 512;
  const double p = kolmogorov_p(
      [&](Real u) {
        const Vec3 d = environment.sample({Real(0.5), u}).direction;
        return std::hypot(double{d.x}, double{d.z});
      },
      [&](double sine) {  // area of the cap below that angle
        const double ratio = std::sin(0.5 * std::asin(sine)) / std::sin(0.5 * edge);
        return std::min(ratio * ratio, 1.0);
      },
      20'000);
  CHECK(p > 1e-3);
}

TEST_CASE("a black picture shines nowhere and is never a light") {
  const EnvironmentImage black(Image(4, 2, 3));
  CHECK(black.pdf({0, 1, 0}) == 0);
  CHECK(black.radiance({0, 1, 0}) == Rgb(0));
  const auto sample = black.sample({Real(0.5), Real(0.5)});
  CHECK(sample.radiance == Rgb(0));
  CHECK(sample.pdf == 0);
  CHECK(glm::length(sample.direction) == 1);
}

TEST_CASE("a picture of one texel is a constant surround") {
  const EnvironmentImage environment(one_texel(1, 1, 0, 0), 45);
  TestFamily family;
  family.add("height", kolmogorov_p(
                           [&](Real u) {
                             return environment.sample({Real(0.25), u}).direction.y;
                           },
                           [](double y) { return 0.5 * (y + 1); }, 10'000));
  family.check();
  for (const Vec3& d : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(Real(0.6), 0, Real(-0.8)), Vec3(0, 0, 1)}) {
    CHECK(environment.radiance(d) == Rgb(30, 10, 5));
    CHECK(environment.pdf(d) == doctest::Approx(1 / (4 * glm::pi<double>())));
  }
}

TEST_CASE("a texel that is no radiance is refused with its place") {
  const auto message = [](float value, double scale) -> std::string {
    Image image = numbered(4, 2);
    image.at(2, 1)[1] = value;
    try {
      const EnvironmentImage environment(image, 0, scale);
    } catch (const Error& error) {
      CHECK(error.exit_code() == 2);
      return error.what();
    }
    return "none";
  };
  const std::string rule = ", but radiance must be finite, 0 or more and at most 1e+30";
  CHECK(message(-0.5f, 1) == "pixel (2, 1) is [3, -0.5, 1]" + rule);
  CHECK(message(-0.5f, 0) == "pixel (2, 1) is [3, -0.5, 1] times 0" + rule);
  CHECK(message(std::numeric_limits<float>::quiet_NaN(), 1) == "pixel (2, 1) is [3, nan, 1]" + rule);
  CHECK(message(std::numeric_limits<float>::infinity(), 1) == "pixel (2, 1) is [3, inf, 1]" + rule);
  CHECK(message(1e20f, 1e20) == "pixel (2, 1) is [3, 1e+20, 1] times 1e+20" + rule);
  CHECK(message(1e20f, 1) == "none");
}
