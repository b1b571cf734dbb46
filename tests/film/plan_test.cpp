#include "film/plan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace meander {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Runs the plan on an image whose every sample takes `rate` seconds and whose noise is `noise` / sqrt(spp).
struct Run {
  double rate = 0;
  double noise = 1;
  Progress progress{};
  std::vector<std::uint64_t> passes{};

  void go(const Budget& budget, int most = 100000) {
    while (const std::uint64_t pass = next_pass(progress, budget)) {
      REQUIRE(static_cast<int>(passes.size()) < most);
      passes.push_back(pass);
      progress.spp += pass;
      progress.seconds = rate * static_cast<double>(progress.spp);
      progress.noise = progress.spp < 2 ? kInfinity : noise / std::sqrt(static_cast<double>(progress.spp));
    }
  }
};

Budget spp(std::uint64_t n) { return {n, {}, {}}; }
Budget seconds(double s) { return {{}, s, {}}; }
Budget error(double e) { return {{}, {}, e}; }

}  // namespace

TEST_CASE("passes double the total and stop at the sample budget exactly") {
  Run run;
  run.go(spp(64));
  CHECK(run.passes == std::vector<std::uint64_t>{1, 1, 2, 4, 8, 16, 32});
  Run odd;
  odd.go(spp(21));
  CHECK(odd.passes == std::vector<std::uint64_t>{1, 1, 2, 4, 8, 5});
  CHECK(next_pass({}, spp(0)) == 0);
  CHECK(next_pass({64, 1, 0}, spp(64)) == 0);
  CHECK(next_pass({70, 1, 0}, spp(64)) == 0);
}

TEST_CASE("without a budget the plan never ends") {
  CHECK(next_pass({}, {}) == 1);
  CHECK(next_pass({1024, 0.001, 0}, {}) == 1024);
  CHECK(next_pass({1ull << 40, 1e12, 0}, {}) == 1);
}

TEST_CASE("no pass past the first is predicted to take over half a second, unless one sample does") {
  Run run;
  run.rate = 0.06;
  run.go(spp(64));
  CHECK(run.passes == std::vector<std::uint64_t>{1, 1, 2, 4, 8, 8, 8, 8, 8, 8, 8});
  Run slow;
  slow.rate = 3;
  slow.go(spp(4));
  CHECK(slow.passes == std::vector<std::uint64_t>{1, 1, 1, 1});
}

TEST_CASE("a time budget is kept within half a sample's time") {
  for (const double rate : {1e-4, 0.003, 0.04, 0.7, 1.9}) {
    for (const double budget : {1.0, 2.5, 10.0}) {
      CAPTURE(rate);
      CAPTURE(budget);
      Run run;
      run.rate = rate;
      run.go(seconds(budget));
      CHECK(std::abs(run.progress.seconds - budget) <= std::max(0.5 * rate, rate - budget) * 1.000001);
    }
  }
}

TEST_CASE("the last pass fills the time that is left with the nearest number of samples") {
  // 1000 samples took 1 s: 1 ms each.
  CHECK(next_pass({1000, 1.0, 1}, seconds(1.0311)) == 31);
  CHECK(next_pass({1000, 1.0, 1}, seconds(1.0309)) == 31);
  CHECK(next_pass({1000, 1.0, 1}, seconds(1.0006)) == 1);
  CHECK(next_pass({1000, 1.0, 1}, seconds(1.0004)) == 0);
  CHECK(next_pass({1000, 1.0, 1}, seconds(1.0)) == 0);
  CHECK(next_pass({1000, 1.0, 1}, seconds(0.5)) == 0);
}

TEST_CASE("no pass takes more than a twentieth of the time given, but for short ones") {
  CHECK(next_pass({1000, 1.0, 1}, seconds(kInfinity)) == 500);
  CHECK(next_pass({1000, 1.0, 1}, seconds(100)) == 500);
  CHECK(next_pass({1000, 1.0, 1}, seconds(4)) == 200);
  CHECK(next_pass({500, 0.5, 1}, seconds(1)) == 50);
  CHECK(next_pass({100, 0.1, 1}, seconds(0.2)) == 50);
  CHECK(next_pass({10, 1.0, 1}, seconds(1.31)) == 1);
}

TEST_CASE("an image takes its first sample whatever the time, and a clock that stood still limits nothing") {
  CHECK(next_pass({}, seconds(0)) == 1);
  CHECK(next_pass({}, seconds(1e-9)) == 1);
  CHECK(next_pass({4, 0, 1}, seconds(1)) == 4);
}

TEST_CASE("an error budget ends the image at the first sample count that meets it, not far beyond") {
  for (const double target : {0.1, 0.03, 0.02}) {
    CAPTURE(target);
    Run run;
    run.go(error(target), 60);
    CHECK(run.progress.noise <= target);
    const double needed = 1 / (target * target);
    CHECK(static_cast<double>(run.progress.spp) >= needed - 1e-6);
    CHECK(static_cast<double>(run.progress.spp) <= needed + 2);
  }
}

TEST_CASE("a pass takes no more samples than the noise still calls for") {
  CHECK(next_pass({64, 0.01, 0.1}, error(0.08)) == 36);  // 64 (0.1/0.08)^2 = 100
  CHECK(next_pass({64, 0.01, 0.1}, error(0.0999999)) == 1);
  CHECK(next_pass({64, 0.01, 0.1}, error(0.01)) == 64);
  CHECK(next_pass({64, 0.01, 0.1}, error(0)) == 64);
  CHECK(next_pass({64, 0.01, kInfinity}, error(0.1)) == 64);
  CHECK(next_pass({64, 0.01, 0.1}, error(0.1)) == 0);
}

TEST_CASE("noise is not believed before 16 samples") {
  CHECK(next_pass({8, 0.01, 0}, error(0.1)) == 8);
  CHECK(next_pass({14, 0.01, 0}, error(0.1)) == 2);
  CHECK(next_pass({15, 0.01, 0.09}, error(0.1)) == 1);
  CHECK(next_pass({16, 0.01, 0}, error(0.1)) == 0);
  Run constant;
  constant.noise = 0;
  constant.go(error(0.01));
  CHECK(constant.progress.spp == 16);
}

TEST_CASE("of several budgets the first that is met ends the image") {
  const Progress progress{16, 1.6, 0.05};
  CHECK(next_pass(progress, Budget{16, 100.0, 0.001}) == 0);
  CHECK(next_pass(progress, Budget{1000, 1.5, 0.001}) == 0);
  CHECK(next_pass(progress, Budget{1000, 100.0, 0.06}) == 0);
  CHECK(next_pass(progress, Budget{1000, 100.0, 0.001}) == 5);
  CHECK(next_pass(progress, Budget{19, 100.0, 0.001}) == 3);
  CHECK(next_pass(progress, Budget{1000, 1.8, 0.001}) == 1);
  CHECK(next_pass(progress, Budget{1000, 100.0, 0.049}) == 1);
}

TEST_CASE("an unreliable noise ends the image at half the error, and a reliable one at once") {
  CHECK(next_pass({64, 0.01, 0.09, false}, error(0.1)) == 64);
  CHECK(next_pass({64, 0.01, 0.06, false}, error(0.1)) == 29);  // 64 (0.06/0.05)^2 = 92.2
  CHECK(next_pass({64, 0.01, 0.05, false}, error(0.1)) == 0);
  CHECK(next_pass({64, 0.01, 0.09, true}, error(0.1)) == 0);
  // Above the error the pass goes to the error first: it may be reliable there.
  CHECK(next_pass({64, 0.01, 0.11, false}, error(0.1)) == 14);
  CHECK(next_pass({64, 0.01, 0.09, false}, Budget{64, {}, 0.1}) == 0);
}

TEST_CASE("what ended an image") {
  CHECK(ended_by({64, 1, 0.05}, spp(64)) == Ending::spp);
  CHECK(ended_by({64, 1, 0.05}, spp(65)) == Ending::none);
  CHECK(ended_by({64, 1, 0.05}, seconds(1)) == Ending::seconds);
  CHECK(ended_by({64, 1, 0.05}, seconds(1.007)) == Ending::seconds);  // under half a sample is left
  CHECK(ended_by({64, 1, 0.05}, seconds(1.01)) == Ending::none);
  CHECK(ended_by({64, 1, 0.05}, error(0.05)) == Ending::error);
  CHECK(ended_by({64, 1, 0.05, false}, error(0.05)) == Ending::none);
  CHECK(ended_by({64, 1, 0.05}, {64, 1.0, 0.05}) == Ending::error);
  CHECK(ended_by({64, 1, 0.05}, {}) == Ending::none);
}

TEST_CASE("the forecast names the budget that is met first, when, and the noise then") {
  const Progress progress{100, 2, 0.04};  // 20 ms a sample; 1 % takes 1600 samples, 32 s
  const auto check = [&](const Budget& budget, Ending ending, double in, double noise) {
    const Forecast end = forecast(progress, budget);
    CHECK(end.ending == ending);
    CHECK(end.seconds == doctest::Approx(in));
    CHECK(end.noise == doctest::Approx(noise));
  };
  check(spp(400), Ending::spp, 6, 0.02);
  check(seconds(18), Ending::seconds, 16, 0.04 / 3);
  check(error(0.01), Ending::error, 30, 0.01);
  check({400, 18.0, 0.01}, Ending::spp, 6, 0.02);
  check({1000, 18.0, 0.01}, Ending::seconds, 16, 0.04 / 3);
  check({10000, 60.0, 0.01}, Ending::error, 30, 0.01);
  check({50, {}, {}}, Ending::spp, 0, 0.04);
  check(error(0.05), Ending::error, 0, 0.04);
  CHECK(forecast(progress, {}).ending == Ending::none);
  CHECK(forecast({}, spp(5)).ending == Ending::none);
}

TEST_CASE("a forecast knows when noise is believed") {
  CHECK(forecast({100, 2, 0.04, false}, error(0.01)).seconds == doctest::Approx(126));  // to 0.5 %
  CHECK(forecast({8, 0.8, 0.04}, error(0.1)).seconds == doctest::Approx(0.8));
  CHECK(forecast({1, 0.8, kInfinity}, error(0.1)).ending == Ending::none);
  CHECK(forecast({1, 0.8, kInfinity}, Budget{{}, 8.0, 0.1}).ending == Ending::seconds);
  CHECK(seconds_to_error({100, 2, 0.04}, 0.02) == doctest::Approx(6));
  CHECK(seconds_to_error({100, 2, 0.04}, 0.05) == 0);
  CHECK_FALSE(seconds_to_error({100, 2, kInfinity}, 0.05));
  CHECK_FALSE(seconds_to_error({100, 2, 0.04}, 0));
}

TEST_CASE("a forecast holds: the image ends then, and there") {
  for (const Budget& budget : {Budget{300, 100.0, 0.001}, {100000, 3.0, 0.001}, {100000, 100.0, 0.03}}) {
    Run run;
    run.rate = 0.01;
    run.go(spp(32));
    const Forecast end = forecast(run.progress, budget);
    const double before = run.progress.seconds;
    run.go(budget);
    CHECK(ended_by(run.progress, budget) == end.ending);
    CHECK(run.progress.seconds - before == doctest::Approx(end.seconds).epsilon(0.02));
    CHECK(run.progress.noise == doctest::Approx(end.noise).epsilon(0.01));
  }
}

TEST_CASE("a live image's passes are short at first and grow to the longest") {
  CHECK(longest_live_pass(0) == 0.1);
  CHECK(longest_live_pass(1.2) == doctest::Approx(0.3));
  CHECK(longest_live_pass(1000) == kLongestPass);
  const Progress progress{64, 0.64, 1};  // 10 ms a sample
  CHECK(next_pass(progress, {}) == 50);
  CHECK(next_pass(progress, {}, 0.1) == 10);
  CHECK(next_pass(progress, {}, 0.001) == 1);  // never less than one sample
}

}  // namespace meander
