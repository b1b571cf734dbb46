// A report as one HTML page that needs nothing beside itself.
#pragma once

#include <optional>
#include <string>

#include "app/report.h"

namespace meander {

/// The text of a page: what the report is of, the plot where there is one, the tables, the reference and the
/// last image of every run as the scene's display shows them, each with its error map. Pictures are embedded.
[[nodiscard]] std::string report_page(const Report& report, const std::optional<Image8>& plot);

}  // namespace meander
