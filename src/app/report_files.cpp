#include "app/report_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/run_stats.h"
#include "core/error.h"

namespace meander {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// One column: its name, and its value in row `row` of a run; null where it has none.
struct Column {
  const char* name;
  std::function<Json(const ReportRun& run, const ReportRow& row)> value;
};

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json per_second(std::uint64_t count, const ReportRow& row) {
  return row.seconds > 0 ? finite(static_cast<double>(count) / row.seconds) : Json(nullptr);
}

// Whether the noise can be relied upon, or why not.
Json noise_word(const ReportRow& row) {
  if (!std::isfinite(row.noise)) return nullptr;
  switch (row.noise_doubt) {
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

// What is measured at every budget.
const std::vector<Column>& row_columns() {
  static const std::vector<Column> columns{
      {"spp", [](auto&, auto& row) { return Json(row.spp); }},
      {"seconds", [](auto&, auto& row) { return Json(row.seconds); }},
      {"noise", [](auto&, auto& row) { return finite(row.noise); }},
      {"noise_is", [](auto&, auto& row) { return noise_word(row); }},
      {"error", [](auto&, auto& row) { return finite(row.error.rms()); }},
      {"error_low", [](auto&, auto& row) { return finite(row.error.rms_low()); }},
      {"error_high", [](auto&, auto& row) { return finite(row.error.rms_high()); }},
      {"reference_error",
       [](auto&, auto& row) {
         return row.error.reference_mse ? finite(row.error.reference_rms()) : Json(nullptr);
       }},
      {"reference_suffices",
       [](auto&, auto& row) {
         return row.error.reference_mse ? Json(row.error.reference_suffices()) : Json(nullptr);
       }},
      {"rmse", [](auto&, auto& row) { return finite(row.plain.rmse); }},
      {"relative_rmse", [](auto&, auto& row) { return finite(row.plain.relative_rmse); }},
      {"relmse", [](auto&, auto& row) { return finite(row.plain.relmse); }},
      {"mae", [](auto&, auto& row) { return finite(row.plain.mae); }},
      {"psnr", [](auto&, auto& row) { return finite(row.plain.psnr); }},
      {"mean_signed", [](auto&, auto& row) { return finite(row.plain.mean_signed); }},
      {"walks", [](auto&, auto& row) { return Json(row.counters.walks); }},
      {"steps", [](auto&, auto& row) { return Json(row.counters.steps); }},
      {"walks_per_second", [](auto&, auto& row) { return per_second(row.counters.walks, row); }},
      {"steps_per_second", [](auto&, auto& row) { return per_second(row.counters.steps, row); }},
      {"efficiency", [](auto&, auto& row) { return finite(row.efficiency()); }},
      {"seconds_to_1_percent", [](auto&, auto& row) { return finite(row.seconds_to_one_percent()); }},
      {"seconds_to_1_percent_is",
       [](auto&, auto& row) {
         return std::isfinite(row.noise) ? Json(row.noise <= 0.01 ? "measured" : "extrapolated")
                                         : Json(nullptr);
       }},
  };
  return columns;
}

// What is measured once a run.
const std::vector<Column>& run_columns() {
  static const std::vector<Column> columns{
      {"bias_test",
       [](auto& run, auto&) {
         return run.bias ? Json(run.bias->passed ? "passed" : "failed") : Json(nullptr);
       }},
      {"bias_p", [](auto& run, auto&) { return run.bias ? finite(bias_p(*run.bias)) : Json(nullptr); }},
      {"bias_block_p", [](auto& run, auto&) { return run.bias ? finite(run.bias->block_p) : Json(nullptr); }},
      {"bias_image_p", [](auto& run, auto&) { return run.bias ? finite(run.bias->image_p) : Json(nullptr); }},
      {"contribution_p99_99",
       [](auto& run, auto&) { return run.fireflies ? finite(run.fireflies->quantile) : Json(nullptr); }},
      {"contribution_largest",
       [](auto& run, auto&) { return run.fireflies ? finite(run.fireflies->largest) : Json(nullptr); }},
      {"contribution_samples",
       [](auto& run, auto&) { return run.fireflies ? Json(run.fireflies->samples) : Json(nullptr); }},
      {"leaked_walks", [](auto& run, auto&) { return Json(run.last.counters.leaked_walks); }},
      {"non_finite", [](auto& run, auto&) { return Json(run.last.non_finite); }},
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

Json json_of(const std::vector<Column>& columns, const ReportRun& run, const ReportRow& row) {
  Json object;
  for (const Column& column : columns) object[column.name] = column.value(run, row);
  return object;
}

Json run_json(const Report& report, const ReportRun& run) {
  Json object;
  object["name"] = run_name(report, run);
  object["estimator"] = estimator_name(run.estimator);
  object["walk"] = run.walk;
  object["threads"] = run.threads;
  object.update(json_of(run_columns(), run, run.rows.back()));
  object["bias_test_is"] = bias_word(report, run);
  object["rows"] = Json::array();
  for (const ReportRow& row : run.rows) object["rows"].push_back(json_of(row_columns(), run, row));
  return object;
}

void write_text(const std::string& path, const std::string& text) {
  write_file(path, std::as_bytes(std::span(text)));
}

void write_linear(const std::string& path, const Image& image, const ImageAttributes& attributes,
                  const Job& job) {
  const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  const Tile area = area_of(job);
  const FilmSize& film = job.scene->film;
  write_exr(path, image, std::span(channels).first(static_cast<std::size_t>(image.channels)), attributes,
            {area.x0, area.y0, film.width, film.height});
}

}  // namespace

std::string report_csv(const Report& report) {
  std::string text = "run,estimator,walk,threads";
  for (const auto* columns : {&row_columns(), &run_columns()})
    for (const Column& column : *columns) text += std::string(",") + column.name;
  text += ",bias_test_is\n";
  for (const ReportRun& run : report.runs) {
    for (const ReportRow& row : run.rows) {
      text += run_name(report, run) + "," + std::string(estimator_name(run.estimator)) + "," + run.walk +
              "," + std::to_string(run.threads);
      for (const Column& column : row_columns()) text += "," + cell(column.value(run, row));
      const bool last = &row == &run.rows.back();
      for (const Column& column : run_columns()) text += "," + (last ? cell(column.value(run, row)) : "");
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
  object["reference"] = {{"source", report.reference.source}};
  if (report.reference.rendering.spp > 0) {
    object["reference"]["spp"] = report.reference.rendering.spp;
    object["reference"]["seconds"] = report.reference.rendering.seconds;
  }
  object["runs"] = Json::array();
  for (const ReportRun& run : report.runs) object["runs"].push_back(run_json(report, run));
  return object.dump(2) + "\n";
}

void check_folder(const std::string& folder) {
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
    throw Error(Fault::input, "cannot write a report into " + folder + ": it is not a folder");
  fs::path nearest = fs::absolute(folder, ignored);
  while (!fs::exists(nearest, ignored) && nearest.has_relative_path()) nearest = nearest.parent_path();
  if (!fs::is_directory(nearest, ignored))
    throw Error(Fault::input,
                "cannot write a report into " + folder + ": " + nearest.string() + " is not a folder");
  if (access(nearest.c_str(), W_OK | X_OK) != 0)
    throw Error(Fault::input, "cannot write a report into " + folder + ": " + nearest.string() + ": " +
                                  std::system_category().message(errno));
}

void write_report_data(const Report& report, const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(Fault::input, "cannot make the folder " + folder + ": " + failed.message());
  write_text(folder + "/report.csv", report_csv(report));
  write_text(folder + "/report.json", report_json(report));
  Job reference = report.job;
  ImageAttributes attributes{{{"meander/scene", report.job.scene->name},
                              {"meander/version", version_text()},
                              {"meander/reference", report.reference.source}},
                             {}};
  if (report.reference.rendering.spp > 0) {
    reference.seed += 1;
    attributes = image_attributes(reference, report.reference.rendering);
  }
  write_linear(folder + "/reference.exr", report.reference.image, attributes, report.job);
  for (const ReportRun& run : report.runs)
    write_linear(folder + "/" + run_name(report, run) + ".exr", run.image,
                 image_attributes(report.job, run.last), report.job);
}

}  // namespace meander
