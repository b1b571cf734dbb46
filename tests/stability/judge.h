// A case rendered with both walks, and what is to be said of it.
#pragma once

#include "stability/cases.h"
#include "walk/lanes.h"

namespace meander {

/// What one walk makes of a case.
struct Verdict {
  Reading stated;        // of the whole, first channel; of a furnace the value furthest from 1
  double deviation = 0;  // the worst z, or that value less 1
  std::uint64_t leaked = 0;
  std::uint64_t walks = 0;
  std::uint64_t non_finite = 0;
  double seconds = 0;
};

struct Outcome {
  Reading held;                      // the reference
  std::array<Verdict, 2> verdicts;   // scalar, lanes
  std::string warning;               // what the program warns of: an overlap, precision, or nothing
  std::vector<std::string> reasons;  // of failure
};

/// How many z one walk of a case is judged by.
[[nodiscard]] std::size_t z_count(const Case& row);

/// Renders the case with both walks, and in lanes with its fault planted in it, which must then fail: a case
/// that cannot is a reason of failure as well.
[[nodiscard]] Outcome judge(const Case& row, double threshold);

[[nodiscard]] std::string table_heading();
[[nodiscard]] std::string table_row(const Case& row, const Outcome& outcome);

}  // namespace meander
