// The rows of the reference tables as jobs of `measure`.
#pragma once

#include <string>
#include <vector>

#include "render/measure.h"

namespace meander {

/// One number of a row. `settles`: the walks must bring its relative standard error to the target.
struct Expected {
  std::string quantity;
  double value;
  bool settles = true;
};

/// One row. The first value counts for the mean of z^2: those of one run are not independent.
struct ReferenceCase {
  std::string name;  // table:line, and :column where a line holds several runs
  MeasureJob job;
  std::vector<Expected> expected;
};

/// Every row that `measure` covers: a_slab, b1, b2, b4, f1, f3. It refuses half-spaces that do not absorb,
/// whose walks have no finite mean length (three rows of b1).
[[nodiscard]] std::vector<ReferenceCase> reference_cases();

/// The quantity of that name.
[[nodiscard]] const Moments& quantity_of(const Measurement& m, const std::string& name);

}  // namespace meander
