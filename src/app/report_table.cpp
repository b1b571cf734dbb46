#include "app/report_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace meander {
namespace {

std::string number(double value, const char* format = "%.3g") {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Three digits that count, without an exponent.
std::string plain(double value) { return number(value, value >= 99.95 ? "%.0f" : "%.3g"); }
std::string percent(double fraction) { return plain(100 * fraction); }

bool is_unsure(const ReportRow& row) { return row.error.reference_mse && !row.error.reference_suffices(); }

bool has_doubt(const ReportRow& row) {
  return std::isfinite(row.noise) && row.noise_doubt != NoiseDoubt::none;
}

bool any_row(const Report& report, bool (*has)(const ReportRow&)) {
  return std::ranges::any_of(report.runs,
                             [&](const ReportRun& run) { return std::ranges::any_of(run.rows, has); });
}

std::string reference_error(const ReportRow& row) {
  return row.error.reference_mse ? percent(row.error.reference_rms()) : "-";
}

std::string bias_text(const Report& report, const ReportRun& run) {
  if (!run.bias) return "not made";
  return std::string(run.bias->passed ? "passed" : "FAILED") + (bias_is_reliable(report, run) ? "" : "?") +
         ", p " + number(bias_p(*run.bias), "%.2g");
}

std::string one_percent_text(const ReportRow& last) {
  if (!std::isfinite(last.noise)) return "-";
  return plain(last.seconds_to_one_percent()) + (last.noise <= 0.01 ? " measured" : " extrapolated");
}

void append_columns(const TextTable& table, std::string& text) {
  std::vector<std::size_t> widths;
  for (const std::string& name : table.header) widths.push_back(name.size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  // Names to the left, figures to the right.
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string fill(widths[i] - cells[i].size(), ' ');
      text += i == 0 ? cells[i] + fill : "  " + fill + cells[i];
    }
    text += '\n';
  };
  line(table.header);
  for (const auto& row : table.rows) line(row);
}

}  // namespace

TextTable budget_table(const Report& report) {
  TextTable table{{"run", "threads", "spp", "seconds", "noise %", "error %", "95 % interval", "reference %",
                   "Mwalks/s", "Msteps/s", "1/(MSE s)"},
                  {}};
  for (const ReportRun& run : report.runs) {
    for (const ReportRow& row : run.rows) {
      table.rows.push_back(
          {std::string(estimator_name(run.estimator)), std::to_string(run.threads), std::to_string(row.spp),
           number(row.seconds, "%.2f"), percent(row.noise) + (has_doubt(row) ? "?" : ""),
           percent(row.error.rms()) + (is_unsure(row) ? "?" : ""),
           percent(row.error.rms_low()) + " - " + percent(row.error.rms_high()), reference_error(row),
           number(static_cast<double>(row.counters.walks) / row.seconds / 1e6),
           number(static_cast<double>(row.counters.steps) / row.seconds / 1e6), number(row.efficiency())});
    }
  }
  return table;
}

TextTable run_table(const Report& report) {
  TextTable table{{"run", "threads", "s to 1 % noise", "bias test", "99.99 % of samples below", "largest",
                   "of samples", "walk"},
                  {}};
  for (const ReportRun& run : report.runs) {
    const auto& found = run.fireflies;
    table.rows.push_back({std::string(estimator_name(run.estimator)), std::to_string(run.threads),
                          one_percent_text(run.rows.back()), bias_text(report, run),
                          found ? plain(found->quantile) + " x mean" : "-",
                          found ? plain(found->largest) + " x mean" : "-",
                          found ? std::to_string(found->samples) : "too few", run.walk});
  }
  return table;
}

std::vector<std::string> report_notes(const Report& report) {
  std::vector<std::string> notes{"Reference: " + report.reference.source + "."};
  if (any_row(report, [](const ReportRow& row) { return row.error.reference_mse.has_value(); }))
    notes.push_back("The reference's own error, a column of the table, is subtracted from the others.");
  if (any_row(report, has_doubt))
    notes.push_back("noise?: too few samples, too few pixels or rare bright samples make it unreliable.");
  if (any_row(report, is_unsure))
    notes.push_back(
        "error?: the reference's own is above a third of it; --reference-spp makes that smaller.");
  if (std::ranges::any_of(report.runs,
                          [&](const ReportRun& run) { return run.bias && !bias_is_reliable(report, run); }))
    notes.push_back(
        "bias test?: it goes by variances that rare bright samples make too small; a sound image may fail.");
  if (report.interrupted) notes.push_back("Interrupted: this is what was complete.");
  return notes;
}

std::string report_text(const Report& report) {
  std::string text;
  append_columns(budget_table(report), text);
  text += '\n';
  append_columns(run_table(report), text);
  text += '\n';
  for (const std::string& note : report_notes(report)) text += note + '\n';
  return text;
}

}  // namespace meander
