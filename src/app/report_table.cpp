#include <cmath>
#include <cstdio>

#include "app/report_files.h"

namespace meander {
namespace {

std::string percent(double fraction) {
  if (!std::isfinite(fraction)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", 100 * fraction);
  return text;
}

std::string number(double value, const char* format = "%.3g") {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string row_line(const std::string& name, const ReportRun& run, const ReportRow& row) {
  const double seconds = row.seconds;
  // What is not sure is marked: an error that the reference's own comes near.
  const bool unsure = row.error.reference_mse && !row.error.reference_suffices();
  const std::string interval = percent(row.error.rms_low()) + "-" + percent(row.error.rms_high());
  char text[192];
  std::snprintf(text, sizeof text, "%-12s %3d %8llu %9s %8s %8s%s %-13s %9s %9s %10s\n", name.c_str(),
                run.threads, static_cast<unsigned long long>(row.spp), number(seconds, "%.2f").c_str(),
                percent(row.noise).c_str(), percent(row.error.rms()).c_str(), unsure ? "?" : " ",
                interval.c_str(), number(static_cast<double>(row.counters.walks) / seconds / 1e6).c_str(),
                number(static_cast<double>(row.counters.steps) / seconds / 1e6).c_str(),
                number(row.efficiency()).c_str());
  return text;
}

std::string run_lines(const std::string& name, const ReportRun& run) {
  const ReportRow& last = run.rows.back();
  std::string text = name + ": ";
  if (std::isfinite(last.noise))
    text += "1 % noise after " + number(last.seconds_to_one_percent()) + " s (" +
            (last.noise <= 0.01 ? "measured" : "extrapolated") + "); ";
  if (run.bias)
    text += std::string("bias test ") + (run.bias->passed ? "passed" : "FAILED") + ", p " +
            number(bias_p(*run.bias)) + "; ";
  else
    text += "no bias test; ";
  if (run.fireflies)
    text += "one sample in 10 000 is above " + number(run.fireflies->quantile) +
            " times its pixel's mean, the "
            "largest of " +
            number(static_cast<double>(run.fireflies->samples), "%.0f") + " is " +
            number(run.fireflies->largest) + " times it\n";
  else
    text += "too few samples to tell of fireflies\n";
  return text;
}

}  // namespace

std::string report_table(const Report& report) {
  std::string text = "reference: " + report.reference.source + "\n";
  char header[192];
  std::snprintf(header, sizeof header, "%-12s %3s %8s %9s %8s %8s  %-13s %9s %9s %10s\n", "estimator", "thr",
                "spp", "seconds", "noise %", "error %", "95 %", "Mwalks/s", "Msteps/s", "1/(MSE s)");
  text += header;
  bool unsure = false;
  for (const ReportRun& run : report.runs) {
    for (const ReportRow& row : run.rows) {
      text += row_line(std::string(estimator_name(run.estimator)), run, row);
      unsure |= row.error.reference_mse && !row.error.reference_suffices();
    }
  }
  if (unsure) text += "?: the reference's own error is above a third of this one\n";
  for (const ReportRun& run : report.runs) text += run_lines(run_name(report, run), run);
  return text;
}

}  // namespace meander
