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

bool has_doubt(const ReportRow& row) {
  return std::isfinite(row.noise) && row.noise_doubt != NoiseDoubt::none;
}

// Where there is an error to be doubted; that the reference's own is unknown is a note of its own.
bool is_doubted(const Report& report, const ReportRun& run, const ReportRow& row) {
  const ErrorDoubt doubt = error_doubt(report, run, row);
  return std::isfinite(row.error.mse) && doubt != ErrorDoubt::none && doubt != ErrorDoubt::reference_unknown;
}

template <class Has>
bool any_row(const Report& report, const Has& has) {
  return std::ranges::any_of(report.runs, [&](const ReportRun& run) {
    return std::ranges::any_of(run.rows, [&](const ReportRow& row) { return has(run, row); });
  });
}

// Either may be so where both are; a row is marked once.
bool any_rare(const Report& report) {
  return any_row(report, [&](const ReportRun& run, const ReportRow& row) {
    return is_doubted(report, run, row) && error_doubt(report, run, row) == ErrorDoubt::rare_bright_samples;
  });
}

bool any_insufficient(const Report& report) {
  return any_row(report, [&](const ReportRun& run, const ReportRow& row) {
    return is_doubted(report, run, row) && report.reference.noise && !reference_suffices(report, row);
  });
}

std::string interval_text(const DebiasedError& error, const std::string& mark) {
  if (!std::isfinite(error.rms_high())) return "-";
  return percent(error.rms_low()) + " - " + percent(error.rms_high()) + mark;
}

std::string reference_error(const ReportRow& row) {
  return row.error.reference_mse ? percent(row.error.reference_rms()) : "-";
}

std::string bias_text(const Report& report, const ReportRun& run) {
  if (!run.bias) return "not made";
  return std::string(run.bias->passed ? "passed" : "FAILED") + (bias_is_reliable(report, run) ? "" : "?") +
         ", p " + number(run.bias->p, "%.2g");
}

std::string one_percent_text(const ReportRun& run) {
  const std::optional<TimeToNoise> time = time_to_one_percent(run);
  if (!time) return "-";
  const std::string seconds = plain(time->seconds) + (time->reliable ? "" : "?");
  switch (time->basis) {
    case TimeToNoise::Basis::at_most:
      return "<= " + seconds;
    case TimeToNoise::Basis::measured:
      return seconds + " measured";
    case TimeToNoise::Basis::extrapolated:
      break;
  }
  return seconds + " extrapolated";
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
      const std::string mark = is_doubted(report, run, row) ? "?" : "";
      table.rows.push_back(
          {std::string(method_name(run.method)), std::to_string(run.threads), std::to_string(row.spp),
           number(row.seconds, "%.2f"), percent(row.noise) + (has_doubt(row) ? "?" : ""),
           percent(row.error.rms()) + mark, interval_text(row.error, mark), reference_error(row),
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
    table.rows.push_back({std::string(method_name(run.method)), std::to_string(run.threads),
                          one_percent_text(run), bias_text(report, run),
                          found ? plain(found->quantile) + " x mean" : "-",
                          found ? plain(found->largest) + " x mean" : "-",
                          found ? std::to_string(found->samples) : "too few", run.walk});
  }
  return table;
}

std::vector<std::string> report_notes(const Report& report) {
  std::vector<std::string> notes{"Reference: " + report.reference.source + "."};
  if (any_row(report, [](auto&, const ReportRow& row) { return row.error.reference_mse.has_value(); }))
    notes.push_back("The reference's own error, a column of the table, is subtracted from the others.");
  if (any_row(report, [](auto&, const ReportRow& row) { return has_doubt(row); }))
    notes.push_back("noise?: too few samples, too few pixels or rare bright samples make it unreliable.");
  if (any_rare(report))
    notes.push_back(
        "error?: rare bright samples, of the run or of the reference, make it and its interval too low.");
  if (any_insufficient(report))
    notes.push_back(
        "error?: the reference's own is above a third of it, or is not well known; --reference-spp makes "
        "that smaller.");
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
