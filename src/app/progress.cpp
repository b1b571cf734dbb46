#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace meander {

ProgressReport::ProgressReport(const Budget& budget, bool quiet)
    : budget_(budget), quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

double ProgressReport::fraction(const Rendering& rendering) const {
  double part = 0;
  if (budget_.spp)
    part = std::max(part, static_cast<double>(rendering.spp) / static_cast<double>(*budget_.spp));
  if (budget_.seconds) part = std::max(part, rendering.seconds / *budget_.seconds);
  // Noise falls as the root of the samples.
  if (budget_.error && rendering.noise > 0)
    part = std::max(part, *budget_.error * *budget_.error / (rendering.noise * rendering.noise));
  return std::clamp(part, 0.0, 1.0);
}

void ProgressReport::show(const Rendering& rendering) {
  if (quiet_) return;
  if (!terminal_ && rendering.seconds < next_line_) return;
  const double part = fraction(rendering);
  std::string noise = "?";
  if (std::isfinite(rendering.noise)) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", 100 * rendering.noise);
    noise = text;
  }
  char line[128];
  std::snprintf(line, sizeof line, "%5.1f %%  %llu spp  noise %s %%  %.1f s", 100 * part,
                static_cast<unsigned long long>(rendering.spp), noise.c_str(), rendering.seconds);
  if (!terminal_) {
    std::fprintf(stderr, "%s\n", line);
    next_line_ = rendering.seconds + 5;
    return;
  }
  constexpr int kCells = 32;
  const int filled = static_cast<int>(part * kCells);
  const std::string bar = std::string(filled, '#') + std::string(kCells - filled, '.');
  std::fprintf(stderr, "\r[%s] %s\x1b[K", bar.c_str(), line);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressReport::finish() {
  if (drawn_) std::fputc('\n', stderr);
  drawn_ = false;
}

}  // namespace meander
