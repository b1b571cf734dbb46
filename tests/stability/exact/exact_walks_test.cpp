// The float walks, scalar and in lanes, against the walks in double precision and against theory.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "stability/exact/exact_lanes.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "support/csv.h"

using namespace meander;

namespace {

// Steps a case: a hundredth of the oracle's, or what MEANDER_STABILITY_STEPS says.
double steps_of_a_case() {
  const char* asked = std::getenv("MEANDER_STABILITY_STEPS");
  return asked ? std::atof(asked) : 2e5;
}

const CsvTable& oracle() {
  static const CsvTable table =
      read_csv(std::string(MEANDER_SOURCE_DIR) + "/tests/stability/exact/double_walks.csv");
  return table;
}

// A row of the oracle.
struct Row {
  std::size_t number;
  std::string quantity;
  double value;
  double deviation;  // of one walk
  double walks;
};

std::vector<Row> rows_of(std::size_t number) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < oracle().rows.size(); ++i) {
    if (static_cast<std::size_t>(oracle().number(i, "case")) != number) continue;
    const double walks = oracle().number(i, "walks");
    rows.push_back({number, oracle().text(i, "quantity"), oracle().number(i, "value"),
                    oracle().number(i, "standard_error") * std::sqrt(walks), walks});
  }
  return rows;
}

// What the sum of a walk's float weights may be off by.
constexpr double kRounding = 2e-6;

struct Score {
  std::size_t number;
  std::string what;
  double z;
};

class Scores {
 public:
  void add(const ExactCase& of, const Row& row, const ExactResults& results) {
    const auto* const place = std::ranges::find(kExactQuantities, row.quantity);
    const Moments& m = results[static_cast<std::size_t>(place - kExactQuantities.begin())];
    REQUIRE(m.count > 1);
    // By the oracle's spread, which so few walks of their own know badly.
    const double own = row.deviation / std::sqrt(static_cast<double>(m.count));
    const double rounding = kRounding * std::abs(row.value);
    const std::string what = describe(of) + " " + row.quantity;
    if (const auto exact = exact_value(of, row.quantity)) {
      scores_.push_back({row.number, what + " exactly", z_score(m.mean, *exact, std::hypot(own, rounding))});
      return;
    }
    const double error = std::hypot(own, row.deviation / std::sqrt(row.walks));
    scores_.push_back({row.number, what, z_score(m.mean, row.value, std::hypot(error, rounding))});
  }

  // Each within the bound of the whole family, and all of them as spread out as chance has it.
  void check() const {
    REQUIRE(scores_.size() > 250);
    const double count = static_cast<double>(scores_.size());
    const double threshold = two_sided_threshold(sidak_level(1e-3, scores_.size()));
    double squares = 0;
    double worst = 0;
    for (const Score& score : scores_) {
      CAPTURE(score.number);
      CAPTURE(score.what);
      CHECK(std::abs(score.z) < threshold);
      squares += score.z * score.z;
      worst = std::max(worst, std::abs(score.z));
    }
    MESSAGE(scores_.size() << " z, largest " << worst << " of " << threshold << ", mean of z^2 "
                           << squares / count);
    // Rows of one walk hang together, up to four of them.
    CHECK(squares / count < 1 + 3.3 * std::sqrt(2 * 4 / count));
  }

 private:
  std::vector<Score> scores_;
};

}  // namespace

TEST_CASE("hard cases: the float scalar walk agrees with the walk in double precision") {
  const std::vector<ExactCase> cases = exact_cases();
  Scores scores;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const ExactResults results =
        walk_scalar(cases[i], walks_within(cases[i], steps_of_a_case()), 2'000'000 + i);
    for (const Row& row : rows_of(i)) scores.add(cases[i], row, results);
  }
  scores.check();
}

TEST_CASE("hard cases: walks in lanes agree with the walk in double precision") {
  const std::vector<ExactCase> cases = exact_cases();
  Scores scores;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!walks_in_lanes(cases[i])) continue;
    const ExactResults results =
        walk_lanes(cases[i], walks_within(cases[i], 2 * steps_of_a_case()), 3'000'000 + i);
    for (const Row& row : rows_of(i)) scores.add(cases[i], row, results);
  }
  scores.check();
}
