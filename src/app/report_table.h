// A report in words and figures, for the console and the page alike.
#pragma once

#include <string>
#include <vector>

#include "app/report.h"

namespace meander {

struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header
};

/// One row a budget. An error in doubt (error_doubt) is followed by "?", and so is its interval; what has no
/// value is "-".
[[nodiscard]] TextTable budget_table(const Report& report);

/// One row a run: what is found once it is complete.
[[nodiscard]] TextTable run_table(const Report& report);

/// What is to be said about the tables, one sentence each; first, what the errors are measured from.
[[nodiscard]] std::vector<std::string> report_notes(const Report& report);

/// All of it in columns.
[[nodiscard]] std::string report_text(const Report& report);

}  // namespace meander
