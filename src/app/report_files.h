// A report as the texts of its files.
#pragma once

#include <string>

#include "app/report.h"

namespace meander {

/// A header and one row a budget of each run. Empty where there is no value: a noise below two samples, a
/// time or an efficiency without error, and what is found once a run (bias test, fireflies) outside its last
/// row.
[[nodiscard]] std::string report_csv(const Report& report);

/// The same by run, with what the report is of and made by; null where there is no value.
[[nodiscard]] std::string report_json(const Report& report);

}  // namespace meander
