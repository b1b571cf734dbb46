#include "app/report.h"

#include <algorithm>
#include <cmath>

#include "stats/distributions.h"
#include "stats/efficiency.h"

namespace meander {
namespace {

constexpr double kMostReferenceNoise = 0.2;
constexpr double kOnePercent = 0.01;

bool has_noise(const ReportRow& row) noexcept { return std::isfinite(row.noise); }

// Between a row above 1 % and the next, which is not.
double seconds_between(const ReportRow& above, const ReportRow& below) noexcept {
  const double share = std::log(above.noise / kOnePercent) / std::log(above.noise / below.noise);
  return above.seconds * std::pow(below.seconds / above.seconds, share);
}

}  // namespace

double ReportRow::efficiency() const noexcept { return meander::efficiency(error.mse, seconds); }

bool reference_suffices(const Report& report, const ReportRow& row) noexcept {
  const auto& noise = report.reference.noise;
  return noise && noise->reliable() && noise->noise <= kMostReferenceNoise &&
         row.error.reference_is_a_third();
}

ErrorDoubt error_doubt(const Report& report, const ReportRun& run, const ReportRow& row) noexcept {
  constexpr NoiseDoubt kRare = NoiseDoubt::rare_bright_samples;
  const auto& noise = report.reference.noise;
  // A run that meets them later has them in its first rows, too.
  if (row.noise_doubt == kRare || run.rows.back().noise_doubt == kRare || (noise && noise->doubt == kRare))
    return ErrorDoubt::rare_bright_samples;
  if (!noise) return ErrorDoubt::reference_unknown;
  return reference_suffices(report, row) ? ErrorDoubt::none : ErrorDoubt::reference_noise;
}

std::optional<TimeToNoise> time_to_one_percent(const ReportRun& run) noexcept {
  using Basis = TimeToNoise::Basis;
  const ReportRow* before = nullptr;
  for (const ReportRow& row : run.rows) {
    if (!has_noise(row)) continue;
    const bool reliable = row.noise_doubt == NoiseDoubt::none;
    if (row.noise <= kOnePercent) {
      // A noise of 0 is on no logarithmic axis.
      if (!before || !(row.noise > 0 && before->seconds > 0))
        return TimeToNoise{row.seconds, Basis::at_most, reliable};
      return TimeToNoise{seconds_between(*before, row), Basis::measured,
                         reliable && before->noise_doubt == NoiseDoubt::none};
    }
    before = &row;
  }
  if (!before) return std::nullopt;
  return TimeToNoise{seconds_to_noise(before->seconds, before->noise, kOnePercent), Basis::extrapolated,
                     before->noise_doubt == NoiseDoubt::none};
}

bool bias_is_reliable(const Report& report, const ReportRun& run) noexcept {
  return run.doubt != NoiseDoubt::rare_bright_samples &&
         report.reference.doubt != NoiseDoubt::rare_bright_samples;
}

std::string_view estimator_name(Estimator estimator) noexcept {
  return estimator == Estimator::analog ? "analog" : "implicit";
}

std::string_view method_name(const ReportMethod& method) noexcept {
  if (method.estimator == Estimator::analog) return "analog";
  return method.walk == WalkCode::batch ? "implicit" : "implicit-scalar";
}

std::string run_name(const Report& report, const ReportRun& run) {
  const bool several = std::ranges::any_of(
      report.runs, [&](const ReportRun& other) { return other.threads != report.runs.front().threads; });
  const std::string name(method_name(run.method));
  return several ? name + "-" + std::to_string(run.threads) + "t" : name;
}

}  // namespace meander
