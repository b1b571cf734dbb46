#include "film/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meander {

namespace {

constexpr std::uint64_t kLeastBelievedSpp = 16;
constexpr double kPassOfTime = 0.05;     // of the time given: a pass that the end breaks off is lost
constexpr double kLeastLongest = 0.05;   // seconds
constexpr double kUnreliablePart = 0.5;  // of the error asked for, at which an unreliable noise is believed

/// `pass`, but at most `limit`, which may lie beyond the integers or be infinite, and at least 1.
std::uint64_t limited(std::uint64_t pass, double limit) noexcept {
  if (!(limit < static_cast<double>(pass))) return pass;
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::max(0.0, limit)));
}

/// The noise at which the estimate, as reliable as it is, is believed to have reached `error`.
double believed_error(const Progress& progress, double error) noexcept {
  return progress.reliable ? error : kUnreliablePart * error;
}

/// Samples until noise that falls as 1/sqrt(spp) is `error`; not rounded.
double samples_by_law(const Progress& progress, double error) noexcept {
  const double ratio = progress.noise / error;
  return static_cast<double>(progress.spp) * std::max(ratio * ratio - 1, 0.0);
}

/// Samples in the next pass as far as `error` limits them: to where the noise is predicted to reach it, and
/// beyond that, while the noise is unreliable, to where it is believed nevertheless.
double samples_to_error(const Progress& progress, double error) noexcept {
  const double to_belief = static_cast<double>(kLeastBelievedSpp) - static_cast<double>(progress.spp);
  const double aim = progress.noise <= error ? believed_error(progress, error) : error;
  return std::max(std::ceil(samples_by_law(progress, aim)), to_belief);
}

bool reached_error(const Progress& progress, double error) noexcept {
  return progress.spp >= kLeastBelievedSpp && progress.noise <= believed_error(progress, error);
}

double seconds_per_sample(const Progress& progress) noexcept {
  return progress.seconds / static_cast<double>(progress.spp);
}

/// Whether the time left is too short for one more sample.
bool reached_time(const Progress& progress, double seconds) noexcept {
  if (progress.spp == 0) return false;
  const double left = seconds - progress.seconds;
  return !(left > 0) || left / seconds_per_sample(progress) + 0.5 < 1;
}

}  // namespace

std::uint64_t next_pass(const Progress& progress, const Budget& budget, double longest) noexcept {
  if (ended_by(progress, budget) != Ending::none) return 0;
  if (progress.spp == 0) return 1;

  const double rate = seconds_per_sample(progress);
  std::uint64_t pass = progress.spp;
  if (budget.seconds) longest = std::min(longest, std::max(kPassOfTime * *budget.seconds, kLeastLongest));
  if (rate > 0) pass = limited(pass, std::floor(longest / rate));
  if (budget.spp) pass = std::min(pass, *budget.spp - progress.spp);
  if (budget.error) pass = limited(pass, samples_to_error(progress, *budget.error));
  if (budget.seconds && rate > 0)
    pass = limited(pass, std::floor((*budget.seconds - progress.seconds) / rate + 0.5));
  return pass;
}

Ending ended_by(const Progress& progress, const Budget& budget) noexcept {
  if (budget.error && reached_error(progress, *budget.error)) return Ending::error;
  if (budget.spp && progress.spp >= *budget.spp) return Ending::spp;
  if (budget.seconds && reached_time(progress, *budget.seconds)) return Ending::seconds;
  return Ending::none;
}

std::optional<double> seconds_to_error(const Progress& progress, double error) noexcept {
  if (!(progress.noise > 0 && progress.seconds > 0 && error > 0) || std::isinf(progress.noise))
    return std::nullopt;
  const double ratio = progress.noise / error;
  return progress.seconds * std::max(ratio * ratio - 1, 0.0);
}

Forecast forecast(const Progress& progress, const Budget& budget) noexcept {
  Forecast first{Ending::none, std::numeric_limits<double>::infinity(), progress.noise};
  if (progress.spp == 0) return first;
  const auto consider = [&](Ending ending, double seconds) {
    if (seconds < first.seconds) first = {ending, std::max(seconds, 0.0), 0};
  };
  const double rate = seconds_per_sample(progress);
  if (budget.error)
    if (const auto seconds = seconds_to_error(progress, believed_error(progress, *budget.error)))
      consider(Ending::error, std::max(*seconds, rate * (static_cast<double>(kLeastBelievedSpp) -
                                                         static_cast<double>(progress.spp))));
  if (budget.spp)
    consider(Ending::spp, rate * (static_cast<double>(*budget.spp) - static_cast<double>(progress.spp)));
  if (budget.seconds) consider(Ending::seconds, *budget.seconds - progress.seconds);
  const double all = progress.seconds + first.seconds;
  first.noise = all > 0 ? progress.noise * std::sqrt(progress.seconds / all) : progress.noise;
  return first;
}

double longest_live_pass(double seconds) noexcept { return std::clamp(seconds / 4, 0.1, kLongestPass); }

}  // namespace meander
