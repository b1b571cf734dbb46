#include "render/sample_tail.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/color.h"
#include "render/small_scene.h"

using namespace meander;

namespace {

// Every sample of a job as an image of its own.
LogHistogram tail_by_hand(Job job, const Image& reference, const std::vector<std::uint8_t>& mask, int spp) {
  LogHistogram found;
  for (int k = 0; k < spp; ++k) {
    job.first_sample = static_cast<std::uint32_t>(k);
    const Film film = render_spp(job, 1).film;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      if (!mask.empty() && mask[i] == 0) continue;
      const auto& m = film.pixels[i].mean;
      const float* r = &reference.values[3 * i];
      const double mean = luminance(Rgb(r[0], r[1], r[2]));
      found.add(luminance(Rgb(Real(m[0]), Real(m[1]), Real(m[2]))) / std::sqrt(mean * mean + 1e-4));
    }
  }
  return found;
}

}  // namespace

TEST_CASE("the tail is that of the samples that the passes take") {
  const std::atomic<bool> stop{false};
  for (const Estimator estimator : {Estimator::implicit, Estimator::analog}) {
    Job job = make_job(mixed_scene(), 2);
    job.estimator = estimator;
    job.crop = Tile{5, 3, 33, 20};
    job.seed = 7;
    Image reference(28, 17, 3);
    for (std::size_t i = 0; i < reference.values.size(); ++i)
      reference.values[i] = 0.1f + 0.01f * static_cast<float>(i % 50);
    std::vector<std::uint8_t> mask(28 * 17);
    for (std::size_t i = 0; i < mask.size(); i += 3) mask[i] = 1;
    for (const auto& counted : {mask, std::vector<std::uint8_t>{}}) {
      const auto tail = sample_tail(job, reference, counted, 5, stop);
      REQUIRE(tail);
      const LogHistogram wanted = tail_by_hand(job, reference, counted, 5);
      CHECK(tail->count() == wanted.count());
      CHECK(tail->largest() == doctest::Approx(wanted.largest()).epsilon(1e-6));
      CHECK(tail->largest() > 0);
      for (const double q : {0.5, 0.9, 0.99})
        CHECK(tail->quantile(q) == doctest::Approx(wanted.quantile(q)).epsilon(0.023));
    }
  }
}

TEST_CASE("the tail does not depend on the threads, and an interrupt leaves none") {
  std::atomic<bool> stop{false};
  const Image reference(40, 24, 3);  // black: the samples' own luminance times a hundred
  const auto one = sample_tail(make_job(mixed_scene(), 1), reference, {}, 3, stop);
  const auto two = sample_tail(make_job(mixed_scene(), 2), reference, {}, 3, stop);
  REQUIRE((one && two));
  CHECK(one->largest() == two->largest());
  CHECK(one->quantile(0.7) == two->quantile(0.7));
  CHECK(one->quantile(0.7) > 0);
  stop = true;
  CHECK_FALSE(sample_tail(make_job(mixed_scene(), 2), reference, {}, 3, stop));
}
