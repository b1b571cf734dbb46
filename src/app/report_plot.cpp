#include "app/report_plot.h"

namespace meander {

Plot report_plot(const Report& report) {
  Plot plot;
  plot.title = "Error against time: " + report.job.scene->name;
  plot.x_label = "rendering time";
  plot.y_label = "relative error";
  for (const ReportRun& run : report.runs) {
    PlotSeries error{run_name(report, run) + " error", {}, true};
    PlotSeries noise{run_name(report, run) + " noise", {}, false};
    for (const ReportRow& row : run.rows) {
      error.points.push_back({row.seconds, row.error.rms(), row.error.rms_low(), row.error.rms_high()});
      noise.points.push_back({row.seconds, row.noise, 0, 0});
    }
    plot.series.push_back(std::move(error));
    plot.series.push_back(std::move(noise));
  }
  return plot;
}

}  // namespace meander
