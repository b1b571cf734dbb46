#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "app/report_files.h"
#include "app/report_page.h"
#include "app/report_plot.h"
#include "app/report_reference.h"
#include "app/report_run.h"
#include "app/report_table.h"
#include "render/first_hits.h"
#include "render/small_scene.h"

using namespace meander;

namespace {

const std::atomic<bool> kNever{false};

Report prepared() {
  Report report;
  Scene scene = mixed_scene();
  scene.name = "<b>\"jade\" & wax</b>";
  report.job = make_job(std::move(scene), 2);
  report.mask = first_hits(report.job, kNever).mask;
  report.reference = make_reference(report.job, {32, {}, {}}, true, kNever);
  return report;
}

ReportPlan plan_to(const Budget& budget) { return {budget, {Estimator::implicit}, {2}, true}; }

}  // namespace

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
  report.runs[1].estimator = Estimator::analog;
  CHECK(run_name(report, report.runs[0]) == "implicit-1t");
  CHECK(run_name(report, report.runs[1]) == "analog-2t");
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
