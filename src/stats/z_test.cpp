#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "stats/counted_pixels.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "stats/image_error.h"

namespace meander {
namespace {

constexpr double kRounding = 1e-6;  // standard error granted to a value, relative to |a| + |b|
constexpr double kLost = 0x1p-74;   // and in each image: a variance below 2^-149 is stored as 0

// A sum of differences with its two kinds of error: independent noise, whose variances add, and rounding,
// which may lean the same way everywhere, so that its standard errors add.
struct Difference {
  double sum = 0;
  double variance_a = 0;
  double variance_b = 0;
  double rounding = 0;
  std::size_t count = 0;

  void add(const Difference& other) {
    sum += other.sum;
    variance_a += other.variance_a;
    variance_b += other.variance_b;
    rounding += other.rounding;
    count += other.count;
  }
  [[nodiscard]] double z() const {
    return z_score(sum, 0, std::sqrt(variance_a + variance_b + rounding * rounding));
  }
};

// Empty (count 0) when a value or a variance is not finite, or a variance negative.
Difference difference_at(const Image& a, const Image& b, std::size_t pixel, int channel) {
  const float* in_a = &a.values[pixel * a.channels];
  const float* in_b = &b.values[pixel * b.channels];
  const double x = in_a[channel];
  const double y = in_b[channel];
  const double variance_a = in_a[channel + 3];
  const double variance_b = in_b[channel + 3];
  const bool usable = std::isfinite(x) && std::isfinite(y) && std::isfinite(variance_a + variance_b) &&
                      std::min(variance_a, variance_b) >= 0;
  if (!usable) return {};
  return {x - y, variance_a, variance_b, kRounding * (std::abs(x) + std::abs(y)) + 2 * kLost, 1};
}

// z of a single value. The mean variance of the block, raised as blocks are, stands in where it is larger.
// Values without any variance are deterministic and stay so.
double value_z(Difference value, const Difference& block) {
  if (value.variance_a + value.variance_b > 0) {
    const double count = static_cast<double>(block.count);
    value.variance_a = std::max(value.variance_a, block.variance_a / count);
    value.variance_b = std::max(value.variance_b, block.variance_b / count);
  }
  return value.z();
}

void keep_worst(double& worst, double z) {
  if (std::abs(z) > std::abs(worst)) worst = z;
}

using Channels = std::array<Difference, 3>;

// The images and their division into blocks, row by row of blocks.
struct Comparison {
  const Image& a;
  const Image& b;
  CountedPixels counted;
  int block;

  [[nodiscard]] int across() const { return (a.width + block - 1) / block; }
  [[nodiscard]] int down() const { return (a.height + block - 1) / block; }

  // Calls visit(block index, pixel index, channel, difference) for every counted value.
  template <class Visit>
  void for_each_place(const Visit& visit) const {
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * a.width + x;
        if (!counted.counts(pixel)) continue;
        const std::size_t home = static_cast<std::size_t>(y / block) * across() + x / block;
        for (int channel = 0; channel < 3; ++channel)
          visit(home, pixel, channel, difference_at(a, b, pixel, channel));
      }
    }
  }

  // The same for those that need not know where.
  template <class Visit>
  void for_each_value(const Visit& visit) const {
    for_each_place([&](std::size_t home, std::size_t, int channel, const Difference& value) {
      visit(home, channel, value);
    });
  }
};

std::vector<Channels> sum_blocks(const Comparison& images, ZTest& test) {
  std::vector<Channels> blocks(static_cast<std::size_t>(images.across()) * images.down());
  images.for_each_value([&](std::size_t block, int channel, const Difference& value) {
    ++test.values;
    test.non_finite += value.count == 0;
    blocks[block][channel].add(value);
  });
  return blocks;
}

// The variance of A over that of B in a block, and its weight.
struct BlockRatio {
  double ratio = 0;
  double weight = 0;
};

// Variance of A over that of B where both have some: the median over the blocks, each weighing as the lesser
// of both. A sum over the sums would go by the brightest firefly, and so would weights that grow with the
// variance in either image; a plain median would go by blocks of rare events, which most images of few
// samples miss. NaN where no block has both.
double variance_ratio(const std::vector<Channels>& blocks, int channel) {
  std::vector<BlockRatio> ratios;
  double total = 0;
  for (const Channels& block : blocks) {
    const Difference& d = block[channel];
    if (d.variance_a <= 0 || d.variance_b <= 0) continue;
    ratios.push_back({d.variance_a / d.variance_b, std::min(d.variance_a, d.variance_b)});
    total += ratios.back().weight;
  }
  std::ranges::sort(ratios, {}, &BlockRatio::ratio);
  double below = 0;
  for (const BlockRatio& r : ratios) {
    below += r.weight;
    if (below >= total / 2) return r.ratio;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Few samples of a skewed quantity that miss its rare bright ones give a mean and a variance that are both
// too low. But under the hypothesis each image knows the other's variance, up to the ratio of their samples:
// a block has at least what the other image says.
std::vector<Channels> raise_variances(std::vector<Channels> blocks) {
  for (int channel = 0; channel < 3; ++channel) {
    const double ratio = variance_ratio(blocks, channel);
    if (!(ratio > 0 && std::isfinite(ratio))) continue;
    for (Channels& block : blocks) {
      Difference& d = block[channel];
      const double a = std::max(d.variance_a, ratio * d.variance_b);
      d.variance_b = std::max(d.variance_b, d.variance_a / ratio);
      d.variance_a = a;
    }
  }
  return blocks;
}

void test_values(const Comparison& images, const std::vector<Channels>& blocks, const ZTestOptions& options,
                 ZTest& test) {
  test.pixel_threshold = two_sided_threshold(sidak_level(options.alpha, test.values));
  const double values = static_cast<double>(test.values);
  std::vector<double> sizes;
  sizes.reserve(test.values);
  images.for_each_value([&](std::size_t block, int channel, const Difference& value) {
    if (value.count == 0) return;
    const double z = value_z(value, blocks[block][channel]);
    sizes.push_back(std::abs(z));
    keep_worst(test.worst_pixel_z, z);
  });
  const auto failed = std::ranges::count_if(sizes, [&](double z) { return z > test.pixel_threshold; });
  test.failed_fraction = static_cast<double>(failed) / std::max(values, 1.0);
  // The first value in order of size that may not fail decides.
  const auto allowed = static_cast<std::size_t>((1 - options.pixels_passing) * values + 1e-9);
  test.pixels_passed = static_cast<std::size_t>(failed) <= allowed;
  if (allowed >= sizes.size()) return;
  std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(allowed), std::greater{});
  test.pixels_p = sidak_p(two_sided_p(sizes[allowed]), test.values);
}

// The sums to be judged as blocks. A block the mask leaves mostly empty has too few variances behind its
// standard error for the normal's tail, so such blocks are pooled until half a block has come together.
std::vector<Difference> pool_small_blocks(const std::vector<Channels>& blocks, int channel,
                                          std::size_t least) {
  std::vector<Difference> sums;
  Difference pool;
  for (const Channels& block : blocks) {
    Difference& target = block[channel].count < least ? pool : sums.emplace_back();
    target.add(block[channel]);
    if (pool.count < least) continue;
    sums.push_back(pool);
    pool = {};
  }
  if (pool.count == 0) return sums;
  if (sums.empty()) sums.emplace_back();
  sums.back().add(pool);
  return sums;
}

void test_blocks(const std::vector<Channels>& blocks, std::size_t least, double level, ZTest& test) {
  std::size_t count = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const std::vector<Difference> sums = pool_small_blocks(blocks, channel, least);
    count += sums.size();
    for (const Difference& sum : sums) keep_worst(test.worst_block_z, sum.z());
  }
  test.block_threshold = two_sided_threshold(sidak_level(level, count));
  test.block_p = sidak_p(two_sided_p(test.worst_block_z), count);
  test.blocks_passed = std::abs(test.worst_block_z) <= test.block_threshold;
}

void test_image(const std::vector<Channels>& blocks, double level, ZTest& test) {
  double worst = 0;
  for (int channel = 0; channel < 3; ++channel) {
    Difference total;
    for (const Channels& block : blocks) total.add(block[channel]);
    test.image_z[channel] = total.z();
    keep_worst(worst, test.image_z[channel]);
  }
  test.image_threshold = two_sided_threshold(sidak_level(level, 3));
  test.image_p = sidak_p(two_sided_p(worst), 3);
  test.image_passed = std::abs(worst) <= test.image_threshold;
}

}  // namespace

ZTest z_test(const Image& a, const Image& b, std::span<const std::uint8_t> mask,
             const ZTestOptions& options) {
  assert(options.block > 0 && options.alpha > 0 && options.alpha < 1);
  const Comparison images{a, b, CountedPixels(a, b, mask, 6), options.block};
  ZTest test;
  const std::vector<Channels> blocks = sum_blocks(images, test);
  const std::vector<Channels> raised = raise_variances(blocks);
  test_values(images, raised, options, test);
  const double level = sidak_level(options.alpha, 2);
  const std::size_t half_block = (static_cast<std::size_t>(options.block) * options.block + 1) / 2;
  test_blocks(raised, half_block, level, test);
  test_image(blocks, level, test);
  test.passed = test.non_finite == 0 && test.pixels_passed && test.blocks_passed && test.image_passed;
  test.p = std::min(test.pixels_p, sidak_p(std::min(test.block_p, test.image_p), 2));
  if (test.non_finite > 0) test.p = 0;
  return test;
}

ZScores z_scores(const Image& a, const Image& b, std::span<const std::uint8_t> mask,
                 const ZTestOptions& options) {
  assert(options.block > 0);
  const Comparison images{a, b, CountedPixels(a, b, mask, 6), options.block};
  ZTest ignored;
  const std::vector<Channels> blocks = raise_variances(sum_blocks(images, ignored));
  ZScores scores{Image(a.width, a.height, 3), Image(images.across(), images.down(), 3)};
  images.for_each_place([&](std::size_t block, std::size_t pixel, int channel, const Difference& value) {
    if (value.count == 0) return;
    scores.values.values[pixel * 3 + channel] = static_cast<float>(value_z(value, blocks[block][channel]));
  });
  for (std::size_t block = 0; block < blocks.size(); ++block)
    for (int channel = 0; channel < 3; ++channel)
      if (blocks[block][channel].count > 0)
        scores.blocks.values[block * 3 + channel] = static_cast<float>(blocks[block][channel].z());
  return scores;
}

}  // namespace meander
