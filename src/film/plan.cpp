#include "film/plan.h"

#include <algorithm>
#include <cmath>

namespace meander {

namespace {

constexpr std::uint64_t kLeastBelievedSpp = 8;  // below, the estimate of the noise is itself mostly noise

/// `pass`, but at most `limit`, which may lie beyond the integers or be infinite, and at least 1.
std::uint64_t limited(std::uint64_t pass, double limit) noexcept {
  if (!(limit < static_cast<double>(pass))) return pass;
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::max(0.0, limit)));
}

/// Samples still needed until the noise is `error`, as far as can be told.
double samples_to_error(const Progress& progress, double error) noexcept {
  const double done = static_cast<double>(progress.spp);
  const double to_belief = static_cast<double>(kLeastBelievedSpp) - done;
  if (progress.noise <= error) return to_belief;
  const double ratio = progress.noise / error;
  return std::max(std::ceil(done * (ratio * ratio - 1)), to_belief);
}

}  // namespace

std::uint64_t next_pass(const Progress& progress, const Budget& budget, double longest) noexcept {
  if (budget.spp && progress.spp >= *budget.spp) return 0;
  if (progress.spp == 0) return 1;
  if (budget.error && progress.spp >= kLeastBelievedSpp && progress.noise <= *budget.error) return 0;

  const double rate = progress.seconds / static_cast<double>(progress.spp);
  std::uint64_t pass = progress.spp;
  if (rate > 0) pass = limited(pass, std::floor(longest / rate));
  if (budget.spp) pass = std::min(pass, *budget.spp - progress.spp);
  if (budget.error) pass = limited(pass, samples_to_error(progress, *budget.error));
  if (budget.seconds) {
    const double left = *budget.seconds - progress.seconds;
    if (!(left > 0)) return 0;
    if (rate > 0) {
      const double fits = std::floor(left / rate + 0.5);
      if (fits < 1) return 0;
      pass = limited(pass, fits);
    }
  }
  return pass;
}

double longest_live_pass(double seconds) noexcept { return std::clamp(seconds / 4, 0.1, kLongestPass); }

}  // namespace meander
