#include "film/film_union.h"

#include <doctest/doctest.h>

#include <cmath>

#include "film/film.h"
#include "math/random.h"

using namespace meander;

namespace {

// Uniform on a grid that a file's floats keep, 10 added or not.
Real coarse(Random& random) { return static_cast<Real>(random.next_bits() >> 16) * Real(0x1p-16); }

// Samples first to last of a pixel of two, each of a stream of its own.
Film film_of(std::uint32_t first, std::uint32_t last) {
  Film film(2, 1);
  for (std::uint32_t x = 0; x < 2; ++x)
    for (std::uint32_t k = first; k <= last; ++k) {
      Random random = stream(1, x, k);
      film.pixels[x].add(Rgb(coarse(random), 10 + coarse(random), Real(x) * coarse(random)));
    }
  return film;
}

void check_equal(const Image& a, const Image& b) {
  REQUIRE(a.channels == 6);
  REQUIRE(a.values.size() == b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(a.values[i] - b.values[i]) <= 4e-7f * std::abs(b.values[i]));
  }
}

}  // namespace

TEST_CASE("films of disjoint samples unite into the film of all, in any order and number") {
  const Image whole = resolve(film_of(0, 99));
  FilmUnion two;
  two.add(resolve(film_of(0, 29)), 30);
  two.add(resolve(film_of(30, 99)), 70);
  CHECK(two.samples() == 100);
  check_equal(two.resolve(), whole);

  FilmUnion backward;
  for (std::uint32_t first = 90;; first -= 10) {
    backward.add(resolve(film_of(first, first + 9)), 10);
    if (first == 0) break;
  }
  check_equal(backward.resolve(), whole);
}

TEST_CASE("films of one sample have no variance of their own, and add that between them") {
  FilmUnion ones;
  ones.add(resolve(film_of(0, 0)), 1);
  CHECK(ones.resolve().at(0, 0)[3] == 0);
  for (std::uint32_t k = 1; k < 12; ++k) ones.add(resolve(film_of(k, k)), 1);
  check_equal(ones.resolve(), resolve(film_of(0, 11)));
}

TEST_CASE("a pixel that never varies keeps its value and a variance of 0") {
  Image image(1, 1, 6);
  image.values = {0.1f, 0.2f, 0.7f, 0, 0, 0};
  FilmUnion same;
  for (int k = 0; k < 1000; ++k) same.add(image, 3);
  CHECK(same.samples() == 3000);
  CHECK(same.resolve().values == image.values);
}
