// The folder of a report: what is checked before the work, and what is written after it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/report.h"

namespace meander {

/// The names of all files that a report of these runs may write.
[[nodiscard]] std::vector<std::string> report_file_names(std::span<const ReportMethod> methods,
                                                         std::span<const int> threads);

/// Refuses before long work what writing files of these names there would refuse after it: a folder that
/// cannot be made or written, a name that is a directory's or a read-only file's. Leaves nothing behind.
/// Error (input).
void check_folder(const std::string& folder, std::span<const std::string> names);

/// Makes the folder, and writes the table and the images, then what tells of them all: report.json and last
/// index.html. The images of an earlier report there, as its report.json names them, go, and so does its
/// plot. Error (runtime) when it fails, which then leaves no index.html.
void write_report(const Report& report, const std::string& folder);

/// Adds the plot to a report that is written: report.png, and index.html once more, with it. Error (runtime).
void add_report_plot(const Report& report, const Image8& plot, const std::string& folder);

}  // namespace meander
