#include "app/report.h"

#include <algorithm>

#include "stats/distributions.h"
#include "stats/efficiency.h"

namespace meander {

double ReportRow::efficiency() const noexcept { return meander::efficiency(error.mse, seconds); }
double ReportRow::seconds_to_one_percent() const noexcept { return seconds_to_noise(seconds, noise, 0.01); }

bool bias_is_reliable(const Report& report, const ReportRun& run) noexcept {
  return run.doubt != NoiseDoubt::rare_bright_samples &&
         report.reference.doubt != NoiseDoubt::rare_bright_samples;
}

std::string_view estimator_name(Estimator estimator) noexcept {
  return estimator == Estimator::analog ? "analog" : "implicit";
}

std::string run_name(const Report& report, const ReportRun& run) {
  const bool several = std::ranges::any_of(
      report.runs, [&](const ReportRun& other) { return other.threads != report.runs.front().threads; });
  const std::string name(estimator_name(run.estimator));
  return several ? name + "-" + std::to_string(run.threads) + "t" : name;
}

double bias_p(const ZTest& test) noexcept { return sidak_p(std::min(test.block_p, test.image_p), 2); }

}  // namespace meander
