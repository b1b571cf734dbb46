// How a measurement is printed: plain lines, JSON, or rows of CSV.
#pragma once

#include <string>
#include <vector>

#include "render/measure.h"

namespace meander {

struct MeasuredCase {
  MeasureJob job;
  Measurement result;
};

[[nodiscard]] std::string measurement_text(const MeasuredCase& measured);

/// An object, or a list of objects where a range was given.
[[nodiscard]] std::string measurement_json(const std::vector<MeasuredCase>& cases, bool list);

/// A header and one row a case; each quantity is followed by its standard error.
[[nodiscard]] std::string measurement_csv(const std::vector<MeasuredCase>& cases);

}  // namespace meander
