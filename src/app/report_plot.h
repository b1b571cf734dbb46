// A report's errors as a plot.
#pragma once

#include "app/report.h"
#include "ui/plot.h"

namespace meander {

/// Error against seconds of every run with its 95 % interval, measured, and the noise of the same images,
/// estimated.
[[nodiscard]] Plot report_plot(const Report& report);

}  // namespace meander
