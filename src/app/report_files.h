// A report as text and as files of a folder.
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

/// Refuses before long work what writing there would refuse after it: a name that is no folder, or a folder
/// that cannot be made or written. Leaves nothing behind. Error (input).
void check_folder(const std::string& folder);

/// Makes the folder and writes report.csv, report.json, reference.exr and the last image of every run. Error
/// (input) as write_file.
void write_report_data(const Report& report, const std::string& folder);

}  // namespace meander
