#include "app/report_files.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/run_stats.h"
#include "core/error.h"

namespace meander {
namespace {

using Json = nlohmann::ordered_json;

// Where a value stands: in a row of a run of a report.
struct Cell {
  const Report& report;
  const ReportRun& run;
  const ReportRow& row;
};

// One column: its name, and its value; null where it has none.
struct Column {
  const char* name;
  std::function<Json(const Cell&)> value;
};

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json per_second(std::uint64_t count, const ReportRow& row) {
  return row.seconds > 0 ? finite(static_cast<double>(count) / row.seconds) : Json(nullptr);
}

// Whether the noise can be relied upon, or why not.
Json noise_word(double noise, NoiseDoubt doubt) {
  if (!std::isfinite(noise)) return nullptr;
  switch (doubt) {
    case NoiseDoubt::too_few_samples:
      return "too few samples";
    case NoiseDoubt::rare_bright_samples:
      return "rare bright samples";
    case NoiseDoubt::too_few_pixels:
      return "too few pixels";
    case NoiseDoubt::none:
      break;
  }
  return "reliable";
}

// Whether the error can be relied upon, or why not.
Json error_word(const Cell& at) {
  if (!std::isfinite(at.row.error.mse)) return nullptr;
  switch (error_doubt(at.report, at.run, at.row)) {
    case ErrorDoubt::rare_bright_samples:
      return "rare bright samples";
    case ErrorDoubt::reference_noise:
      return "reference too noisy";
    case ErrorDoubt::reference_unknown:
      return "reference of unknown error";
    case ErrorDoubt::none:
      break;
  }
  return "reliable";
}

Json basis_word(const std::optional<TimeToNoise>& time) {
  if (!time) return nullptr;
  switch (time->basis) {
    case TimeToNoise::Basis::at_most:
      return "at most";
    case TimeToNoise::Basis::measured:
      return "measured";
    case TimeToNoise::Basis::extrapolated:
      break;
  }
  return "extrapolated";
}

// What is measured at every budget.
const std::vector<Column>& row_columns() {
  static const std::vector<Column> columns{
      {"spp", [](const Cell& at) { return Json(at.row.spp); }},
      {"seconds", [](const Cell& at) { return Json(at.row.seconds); }},
      {"noise", [](const Cell& at) { return finite(at.row.noise); }},
      {"noise_is", [](const Cell& at) { return noise_word(at.row.noise, at.row.noise_doubt); }},
      {"error", [](const Cell& at) { return finite(at.row.error.rms()); }},
      {"error_low", [](const Cell& at) { return finite(at.row.error.rms_low()); }},
      {"error_high", [](const Cell& at) { return finite(at.row.error.rms_high()); }},
      {"error_is", [](const Cell& at) { return error_word(at); }},
      {"reference_error",
       [](const Cell& at) {
         return at.row.error.reference_mse ? finite(at.row.error.reference_rms()) : Json(nullptr);
       }},
      {"reference_suffices",
       [](const Cell& at) {
         const bool known = at.row.error.reference_mse && std::isfinite(at.row.error.mse);
         return known ? Json(reference_suffices(at.report, at.row)) : Json(nullptr);
       }},
      {"rmse", [](const Cell& at) { return finite(at.row.plain.rmse); }},
      {"relative_rmse", [](const Cell& at) { return finite(at.row.plain.relative_rmse); }},
      {"relmse", [](const Cell& at) { return finite(at.row.plain.relmse); }},
      {"mae", [](const Cell& at) { return finite(at.row.plain.mae); }},
      {"psnr", [](const Cell& at) { return finite(at.row.plain.psnr); }},
      {"mean_signed", [](const Cell& at) { return finite(at.row.plain.mean_signed); }},
      {"walks", [](const Cell& at) { return Json(at.row.counters.walks); }},
      {"steps", [](const Cell& at) { return Json(at.row.counters.steps); }},
      {"walks_per_second", [](const Cell& at) { return per_second(at.row.counters.walks, at.row); }},
      {"steps_per_second", [](const Cell& at) { return per_second(at.row.counters.steps, at.row); }},
      {"efficiency", [](const Cell& at) { return finite(at.row.efficiency()); }},
  };
  return columns;
}

// What is measured once a run.
const std::vector<Column>& run_columns() {
  static const std::vector<Column> columns{
      {"seconds_to_1_percent",
       [](const Cell& at) {
         const auto time = time_to_one_percent(at.run);
         return time ? finite(time->seconds) : Json(nullptr);
       }},
      {"seconds_to_1_percent_is", [](const Cell& at) { return basis_word(time_to_one_percent(at.run)); }},
      {"bias_test",
       [](const Cell& at) {
         return at.run.bias ? Json(at.run.bias->passed ? "passed" : "failed") : Json(nullptr);
       }},
      {"bias_p", [](const Cell& at) { return at.run.bias ? finite(at.run.bias->p) : Json(nullptr); }},
      {"bias_block_p",
       [](const Cell& at) { return at.run.bias ? finite(at.run.bias->block_p) : Json(nullptr); }},
      {"bias_image_p",
       [](const Cell& at) { return at.run.bias ? finite(at.run.bias->image_p) : Json(nullptr); }},
      {"contribution_p99_99",
       [](const Cell& at) { return at.run.fireflies ? finite(at.run.fireflies->quantile) : Json(nullptr); }},
      {"contribution_largest",
       [](const Cell& at) { return at.run.fireflies ? finite(at.run.fireflies->largest) : Json(nullptr); }},
      {"contribution_samples",
       [](const Cell& at) { return at.run.fireflies ? Json(at.run.fireflies->samples) : Json(nullptr); }},
      {"leaked_walks", [](const Cell& at) { return Json(at.run.last.counters.leaked_walks); }},
      {"non_finite", [](const Cell& at) { return Json(at.run.last.non_finite); }},
  };
  return columns;
}

// A verdict goes by variances that may be too small.
Json bias_word(const Report& report, const ReportRun& run) {
  if (!run.bias) return nullptr;
  return bias_is_reliable(report, run) ? "reliable" : "rare bright samples";
}

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

Json json_of(const std::vector<Column>& columns, const Cell& at) {
  Json object;
  for (const Column& column : columns) object[column.name] = column.value(at);
  return object;
}

Json run_json(const Report& report, const ReportRun& run) {
  Json object;
  object["name"] = run_name(report, run);
  object["estimator"] = estimator_name(run.method.estimator);
  object["walk"] = run.walk;
  object["threads"] = run.threads;
  object.update(json_of(run_columns(), {report, run, run.rows.back()}));
  object["bias_test_is"] = bias_word(report, run);
  object["rows"] = Json::array();
  for (const ReportRow& row : run.rows) object["rows"].push_back(json_of(row_columns(), {report, run, row}));
  return object;
}

Json reference_json(const ReportReference& reference) {
  Json object;
  object["source"] = reference.source;
  object["spp"] = reference.spp ? Json(*reference.spp) : Json(nullptr);
  object["seconds"] = reference.rendering.spp > 0 ? Json(reference.rendering.seconds) : Json(nullptr);
  const auto& noise = reference.noise;
  object["noise"] = noise ? finite(noise->noise) : Json(nullptr);
  object["noise_is"] = noise ? noise_word(noise->noise, noise->doubt) : Json(nullptr);
  return object;
}

}  // namespace

std::string report_csv(const Report& report) {
  std::string text = "run,estimator,walk,threads";
  for (const auto* columns : {&row_columns(), &run_columns()})
    for (const Column& column : *columns) text += std::string(",") + column.name;
  text += ",bias_test_is\n";
  for (const ReportRun& run : report.runs) {
    for (const ReportRow& row : run.rows) {
      text += run_name(report, run) + "," + std::string(estimator_name(run.method.estimator)) + "," +
              run.walk + "," + std::to_string(run.threads);
      for (const Column& column : row_columns()) text += "," + cell(column.value({report, run, row}));
      const bool last = &row == &run.rows.back();
      for (const Column& column : run_columns())
        text += "," + (last ? cell(column.value({report, run, row})) : "");
      text += "," + (last ? cell(bias_word(report, run)) : "") + "\n";
    }
  }
  return text;
}

std::string report_json(const Report& report) {
  const Tile area = area_of(report.job);
  Json object;
  object["version"] = version_text();
  object["date"] = report.date;
  object["machine"] = report.machine;
  object["scene"] = report.job.scene->name;
  object["seed"] = report.job.seed;
  object["first_sample"] = report.job.first_sample;
  object["width"] = area.x1 - area.x0;
  object["height"] = area.y1 - area.y0;
  const auto counted = std::ranges::count(report.mask, std::uint8_t{1});
  object["object_pixels"] = counted > 0 ? Json(counted) : Json("all");
  object["interrupted"] = report.interrupted;
  object["setup_seconds"] = report.setup_seconds;
  object["reference"] = reference_json(report.reference);
  object["runs"] = Json::array();
  for (const ReportRun& run : report.runs) object["runs"].push_back(run_json(report, run));
  // A file's name need not be UTF-8.
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace meander
