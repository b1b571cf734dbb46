// The lanes' elementary functions against double precision, on every instruction set of this machine.
#include <doctest/doctest.h>
#include <hwy/aligned_allocator.h>

#include <cmath>
#include <functional>
#include <vector>

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/vector_math_test.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "math/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// 0: logarithm, 1: exponential, 2: sine, 3: cosine. `x` has a multiple of 16 values, aligned.
void evaluate(int function, const float* x, float* y, std::size_t count) {
  const hn::ScalableTag<float> d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto v = hn::Load(d, x + i);
    auto sine = hn::Zero(d);
    auto cosine = hn::Zero(d);
    sincos_turns(d, v, sine, cosine);
    switch (function) {
      case 0:
        hn::Store(log_lanes(d, v), d, y + i);
        break;
      case 1:
        hn::Store(exp_lanes(d, v), d, y + i);
        break;
      case 2:
        hn::Store(sine, d, y + i);
        break;
      default:
        hn::Store(cosine, d, y + i);
        break;
    }
  }
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {
namespace {

using Evaluate = void (*)(int, const float*, float*, std::size_t);

std::vector<Evaluate> evaluators() {
  const std::int64_t supported = hwy::SupportedTargets();
  std::vector<Evaluate> all{&N_SCALAR::evaluate};
  const auto add = [&](Evaluate evaluate, std::int64_t target) {
    if (supported & target) all.push_back(evaluate);
  };
  add(&N_SSE4::evaluate, HWY_SSE4);
  add(&N_AVX2::evaluate, HWY_AVX2);
  add(&N_AVX3::evaluate, HWY_AVX3);
  return all;
}

using Arguments = std::function<float(std::uint32_t)>;

// The largest of error(x, result) over 2^24 arguments and all instruction sets.
double worst(int function, const Arguments& argument, const std::function<double(double, double)>& error) {
  constexpr std::size_t kBlock = 4096;
  const auto x = hwy::AllocateAligned<float>(kBlock);
  const auto y = hwy::AllocateAligned<float>(kBlock);
  double largest = 0;
  for (std::uint32_t first = 0; first < (1u << 24); first += 7 * kBlock) {
    for (std::uint32_t i = 0; i < kBlock; ++i) x[i] = argument(std::min(first + 7 * i, (1u << 24) - 1));
    for (const Evaluate evaluate : evaluators()) {
      evaluate(function, x.get(), y.get(), kBlock);
      for (std::size_t i = 0; i < kBlock; ++i) {
        const double e = error(double{x[i]}, double{y[i]});
        if (!(e <= largest)) largest = e;
      }
    }
  }
  return largest;
}

// In units of the last place of the true value.
std::function<double(double, double)> ulps(double (*exact)(double)) {
  return [=](double x, double y) {
    const double truth = exact(x);
    const float nearest = static_cast<float>(truth);
    const double ulp = double{std::nextafter(std::abs(nearest), INFINITY)} - double{std::abs(nearest)};
    return std::abs(y - truth) / ulp;
  };
}

constexpr int kLogarithm = 0;
constexpr int kExponential = 1;
constexpr int kSine = 2;
constexpr int kCosine = 3;
constexpr float kGrid = 0x1p-24f;
constexpr double kTurn = 6.283185307179586476925;

}  // namespace

TEST_CASE("the lanes' logarithm is within 2 ulp wherever a free path can take it") {
  const double error = worst(
      kLogarithm, [](std::uint32_t k) { return static_cast<float>(k + 1) * kGrid; }, ulps(std::log));
  MESSAGE("log: " << error << " ulp");
  CHECK(error < 2);
}

TEST_CASE("the lanes' exponential is within 4 ulp from 0 to -87") {
  const double error = worst(
      kExponential, [](std::uint32_t k) { return -87 * (static_cast<float>(k) * kGrid); }, ulps(std::exp));
  MESSAGE("exp: " << error << " ulp");
  CHECK(error < 4);
}

TEST_CASE("the lanes' exponential is 0 far below") {
  for (const Evaluate evaluate : evaluators()) {
    const auto x = hwy::AllocateAligned<float>(16);
    const auto y = hwy::AllocateAligned<float>(16);
    for (int i = 0; i < 16; ++i) x[i] = i % 2 == 0 ? -1e30f : -INFINITY;
    evaluate(kExponential, x.get(), y.get(), 16);
    for (int i = 0; i < 16; ++i) CHECK(y[i] == 0);
  }
}

TEST_CASE("the lanes' sine and cosine of a turn are within 1.5e-7") {
  const auto turn = [](std::uint32_t k) { return static_cast<float>(k) * kGrid; };
  const double sine =
      worst(kSine, turn, [](double x, double y) { return std::abs(y - std::sin(kTurn * x)); });
  const double cosine =
      worst(kCosine, turn, [](double x, double y) { return std::abs(y - std::cos(kTurn * x)); });
  MESSAGE("sin: " << sine << ", cos: " << cosine);
  CHECK(sine < 1.5e-7);
  CHECK(cosine < 1.5e-7);
}

}  // namespace meander
#endif
