// The resolved bins of a measurement as a table of values with units, for JSON and CSV alike.
#pragma once

#include <string>
#include <vector>

#include "app/measure_report.h"

namespace meander {

struct BinValue {
  double low;
  double high;  // infinite for the bin that holds the rest
  double value;
  double standard_error;
};

struct BinTable {
  std::string quantity;
  std::vector<BinValue> bins;
};

/// One table a quantity that was resolved, in the units that bins_csv states.
[[nodiscard]] std::vector<BinTable> bin_tables(const MeasuredCase& measured);

}  // namespace meander
