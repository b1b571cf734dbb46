#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <sstream>

#include "app/report_files.h"
#include "app/report_page.h"
#include "app/report_plot.h"
#include "app/report_table.h"
#include "report_sample.h"

using namespace meander;

TEST_CASE("a report's rows are the renders of their budgets") {
  Report report = prepared();
  make_runs(report, plan_to({6, {}, {}}), kNever);
  REQUIRE(report.runs.size() == 1);
  std::vector<std::uint64_t> spp;
  for (const ReportRow& row : report.runs[0].rows) {
    spp.push_back(row.spp);
    const Rendering alone = render_spp(report.job, row.spp);
    const Image image = resolve(alone.film);
    CHECK(row.plain.relmse == image_error(image, report.reference.image, report.mask).relmse);
    CHECK(row.error.mse == debiased_error(image, report.reference.image, report.mask).mse);
    CHECK(row.noise == estimate_noise(alone.film, report.mask).noise);
    CHECK(row.counters.steps == alone.counters.steps);
  }
  CHECK(spp == std::vector<std::uint64_t>{1, 2, 4, 6});
  CHECK(report.runs[0].image.values == resolve(render_spp(report.job, 6).film).values);
  CHECK_FALSE(report.runs[0].bias);  // six samples are too few
}

TEST_CASE("the reference is another seed's, larger, and its own error is known") {
  const Report report = prepared();
  Job other = report.job;
  other.seed = 1;
  CHECK(report.reference.image.values == resolve(render_spp(other, 32).film).values);
  const Budget larger = reference_budget({8, 2.0, 0.04}, {});
  CHECK(larger.spp == 128);
  CHECK(larger.seconds == 32);
  CHECK(larger.error == 0.01);
  const Budget told = reference_budget({8, 2.0, 0.04}, 50);
  CHECK(told.spp == 50);
  CHECK_FALSE(told.seconds);
  CHECK_FALSE(told.error);
}

TEST_CASE("a report is ended by its time, and by an interrupt") {
  Report report = prepared();
  make_runs(report, plan_to({{}, 0.05, {}}), kNever);
  const std::vector<ReportRow> rows = report.runs.at(0).rows;
  CHECK(rows.back().seconds < 1);
  for (std::size_t i = 1; i < rows.size(); ++i) CHECK(rows[i].spp > rows[i - 1].spp);
  report.runs.clear();
  const std::atomic<bool> stopped{true};
  make_runs(report, plan_to({8, {}, {}}), stopped);
  CHECK(report.runs.empty());
}

TEST_CASE("runs are named after their threads where they differ in them") {
  Report report;
  report.runs.resize(2);
  CHECK(run_name(report, report.runs[1]) == "implicit");
  report.runs[1].threads = 2;
  report.runs[1].method = kReportMethods[2];
  CHECK(run_name(report, report.runs[0]) == "implicit-1t");
  CHECK(run_name(report, report.runs[1]) == "analog-2t");
}

namespace {

// A run of one row whose error is 0.1 +- a tenth, beside a reference of a given error of its own.
Report one_row(double reference_error, const NoiseEstimate& reference_noise) {
  Report report;
  report.runs.resize(1);
  ReportRow row;
  row.error = {0.01, 0.001, reference_error * reference_error, 100};
  report.runs[0].rows = {row};
  report.reference.noise = reference_noise;
  return report;
}

ErrorDoubt doubt_of(const Report& report) {
  return error_doubt(report, report.runs[0], report.runs[0].rows[0]);
}

bool says(const Report& report, const std::string& words) {
  return report_text(report).find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("an error is relied upon where the reference suffices and nothing rare is met") {
  CHECK(doubt_of(one_row(0.033, {0.19, 0.01, 0.19, NoiseDoubt::none})) == ErrorDoubt::none);
  CHECK(doubt_of(one_row(0.034, {0.19, 0.01, 0.19, NoiseDoubt::none})) == ErrorDoubt::reference_noise);
  CHECK(doubt_of(one_row(0.033, {0.21, 0.01, 0.21, NoiseDoubt::none})) == ErrorDoubt::reference_noise);
  CHECK(doubt_of(one_row(0.033, {0.19, 0.2, 0.19, NoiseDoubt::too_few_pixels})) ==
        ErrorDoubt::reference_noise);
  Report report = one_row(0.033, {0.19, 0.01, 0.1, NoiseDoubt::rare_bright_samples});
  CHECK(doubt_of(report) == ErrorDoubt::rare_bright_samples);
  report.reference.noise.reset();
  CHECK(doubt_of(report) == ErrorDoubt::reference_unknown);
  report.runs[0].rows[0].noise_doubt = NoiseDoubt::rare_bright_samples;
  CHECK(doubt_of(report) == ErrorDoubt::rare_bright_samples);
}

TEST_CASE("rare bright samples that a run meets later count for its first rows") {
  Report report = one_row(0.033, {0.1, 0.01, 0.1, NoiseDoubt::none});
  report.runs[0].rows.push_back(report.runs[0].rows[0]);
  report.runs[0].rows[1].noise_doubt = NoiseDoubt::rare_bright_samples;
  CHECK(doubt_of(report) == ErrorDoubt::rare_bright_samples);
}

TEST_CASE("an error in doubt is marked with its interval, and a line says why") {
  const Report sound = one_row(0.01, {0.1, 0.01, 0.1, NoiseDoubt::none});
  CHECK(budget_table(sound).rows[0][5] == "10");
  CHECK(budget_table(sound).rows[0][6] == "8.97 - 10.9");
  CHECK_FALSE(says(sound, "error?"));
  Report noisy = one_row(0.05, {0.1, 0.01, 0.1, NoiseDoubt::none});
  CHECK(budget_table(noisy).rows[0][5] == "10?");
  CHECK(budget_table(noisy).rows[0][6] == "8.97 - 10.9?");
  CHECK(says(noisy, "error?: the reference's own"));
  CHECK_FALSE(says(noisy, "error?: rare"));
  noisy.runs[0].rows[0].error.standard_error = std::numeric_limits<double>::quiet_NaN();
  CHECK(budget_table(noisy).rows[0][6] == "-");  // of one pixel
  const Report rare = one_row(0.01, {0.1, 0.01, 0.05, NoiseDoubt::rare_bright_samples});
  CHECK(budget_table(rare).rows[0][6] == "8.97 - 10.9?");
  CHECK(says(rare, "error?: rare bright samples"));
}

TEST_CASE("what has no value is a dash, an empty cell or null, never a word of the machine's") {
  Report report = prepared();
  report.runs.resize(1);
  ReportRow row;
  row.noise = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  row.error = {nan, nan, nan, 0};
  row.plain.rmse = row.plain.psnr = nan;
  report.runs[0].rows = {row};
  report.runs[0].image = report.reference.image;
  for (const std::size_t column : {4, 5, 6, 7, 8, 9, 10}) {
    CAPTURE(column);
    CHECK(budget_table(report).rows[0][column] == "-");
  }
  CHECK(run_table(report).rows[0][2] == "-");
  CHECK(report_json(report).find("\"error\": null") != std::string::npos);
  CHECK(report_json(report).find("\"error_is\": null") != std::string::npos);
  std::string page = report_page(report, std::nullopt);
  while (page.find("base64,") != std::string::npos) {
    const std::size_t start = page.find("base64,");
    page.erase(start, page.find('"', start) - start);
  }
  const std::regex machine_word("(^|[^A-Za-z])(nan|inf|infinity)([^A-Za-z]|$)", std::regex::icase);
  for (const std::string& text : {report_csv(report), report_json(report), report_text(report), page}) {
    std::smatch found;
    CHECK_FALSE(std::regex_search(text, found, machine_word));
    CHECK(found.str() == "");
  }
}

namespace {

ReportRun run_with_noises(std::initializer_list<std::pair<double, double>> rows) {
  ReportRun run;
  for (const auto& [seconds, noise] : rows) {
    ReportRow row;
    row.seconds = seconds;
    row.noise = noise;
    run.rows.push_back(row);
  }
  return run;
}

std::string words_of(const ReportRun& run) {
  Report report;
  report.runs = {run};
  return run_table(report).rows[0][2];
}

}  // namespace

TEST_CASE("the time to 1 % lies between two rows, at most at the first or beyond the last") {
  const double unknown = std::numeric_limits<double>::infinity();
  CHECK(words_of(run_with_noises({{1, unknown}})) == "-");
  CHECK(words_of(run_with_noises({{1, unknown}, {2, 0.04}, {4, 0.02}})) == "16 extrapolated");
  // Halfway between 2 % and 0.5 %, on logarithmic axes: sqrt(4 * 9).
  CHECK(words_of(run_with_noises({{1, unknown}, {2, 0.04}, {4, 0.02}, {9, 0.005}, {18, 0.004}})) ==
        "6 measured");
  CHECK(words_of(run_with_noises({{1, 0.02}, {4, 0.01}})) == "4 measured");
  CHECK(words_of(run_with_noises({{1, unknown}, {2, 0.008}, {4, 0.006}})) == "<= 2");
  CHECK(words_of(run_with_noises({{1, unknown}, {2, 0.0}})) == "<= 2");
  CHECK(words_of(run_with_noises({{2, 0.02}, {4, 0.0}})) == "<= 4");
  ReportRun doubtful = run_with_noises({{1, 0.02}, {4, 0.005}});
  doubtful.rows[0].noise_doubt = NoiseDoubt::rare_bright_samples;
  CHECK(words_of(doubtful) == "2? measured");
}

TEST_CASE("no bias is tested against a reference of few samples") {
  for (const std::uint64_t spp : {7, 8}) {
    Report report = prepared();
    report.reference = make_reference(report.job, {spp, {}, {}}, true, kNever);
    make_runs(report, plan_to({8, {}, {}}), kNever);
    CHECK(report.runs.at(0).bias.has_value() == (spp == 8));
  }
}

TEST_CASE("rare bright samples put a verdict of bias in doubt") {
  Report report;
  report.runs.resize(1);
  report.runs[0].rows.resize(1);
  report.runs[0].bias = ZTest{};  // failed
  CHECK(bias_is_reliable(report, report.runs[0]));
  CHECK(report_text(report).find("FAILED,") != std::string::npos);
  report.runs[0].doubt = NoiseDoubt::rare_bright_samples;
  CHECK_FALSE(bias_is_reliable(report, report.runs[0]));
  CHECK(report_text(report).find("FAILED?,") != std::string::npos);
  report.runs[0].doubt = NoiseDoubt::too_few_pixels;
  CHECK(bias_is_reliable(report, report.runs[0]));
  report.reference.doubt = NoiseDoubt::rare_bright_samples;
  CHECK_FALSE(bias_is_reliable(report, report.runs[0]));
}

TEST_CASE("every line of the CSV has the columns of its header") {
  Report report = prepared();
  make_runs(report, plan_to({8, {}, {}}), kNever);
  std::istringstream text(report_csv(report));
  std::vector<std::ptrdiff_t> commas;
  for (std::string line; std::getline(text, line);) commas.push_back(std::ranges::count(line, ','));
  REQUIRE(commas.size() == 5);
  for (const std::ptrdiff_t count : commas) CHECK(count == commas[0]);
}

TEST_CASE("the page takes a scene's name as text") {
  Report report = prepared();
  make_runs(report, plan_to({2, {}, {}}), kNever);
  const std::string page = report_page(report, std::nullopt);
  CHECK(page.find("&lt;b&gt;&quot;jade&quot; &amp; wax&lt;/b&gt;") != std::string::npos);
  CHECK(page.find("<b>") == std::string::npos);
}

TEST_CASE("the plot shows the error as measured and the noise as estimated") {
  Report report = prepared();
  make_runs(report, plan_to({4, {}, {}}), kNever);
  const Plot plot = report_plot(report);
  REQUIRE(plot.series.size() == 2);
  CHECK((plot.series[0].measured && !plot.series[1].measured));
  CHECK(plot.guide_slope == -0.5);
  for (std::size_t i = 0; i < 3; ++i) {
    const ReportRow& row = report.runs[0].rows[i];
    CHECK(plot.series[0].points[i].x == row.seconds);
    CHECK(plot.series[0].points[i].y == row.error.rms());
    CHECK(plot.series[0].points[i].y_high == row.error.rms_high());
    CHECK(plot.series[1].points[i].y == row.noise);
  }
}
