#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace meander {
namespace {

std::string text(const char* format, double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string percent_text(double noise) { return text("%.3g %%", 100 * noise); }

std::string seconds_text(double seconds) {
  if (seconds < 600) return text("%.1f s", seconds);
  if (seconds < 3600 * 10) return text("%.0f min", seconds / 60);
  return text("%.3g h", seconds / 3600);
}

// The part of the budget that is done, 0 to 1.
double fraction(const Progress& progress, const Budget& budget) {
  const double left = forecast(progress, budget).seconds;
  if (!std::isfinite(left)) return 0;
  const double all = progress.seconds + left;
  return all > 0 ? std::clamp(progress.seconds / all, 0.0, 1.0) : 1.0;
}

}  // namespace

const char* ending_name(Ending ending) noexcept {
  switch (ending) {
    case Ending::spp:
      return "spp";
    case Ending::seconds:
      return "time";
    case Ending::error:
      return "error";
    case Ending::none:
      break;
  }
  return "interrupt";
}

std::string progress_line(const Progress& progress, const Budget& budget) {
  char line[96];
  std::snprintf(line, sizeof line, "%5.1f %%  %llu spp  noise ", 100 * fraction(progress, budget),
                static_cast<unsigned long long>(progress.spp));
  std::string result = line;
  result += std::isfinite(progress.noise) ? text("%.2f %%", 100 * progress.noise) : "?";
  if (std::isfinite(progress.noise) && !progress.reliable) result += " (unreliable)";
  result += text("  %.1f s", progress.seconds);
  const Forecast end = forecast(progress, budget);
  if (end.ending == Ending::none) return result;
  result += "  " + seconds_text(end.seconds) + " to go (" + ending_name(end.ending) + ")";
  if (std::isfinite(end.noise) && end.noise > 0) result += ", " + text("%.2f %%", 100 * end.noise) + " then";
  return result;
}

std::string closing_line(const Progress& progress, const Budget& budget) {
  if (!budget.error || !std::isfinite(progress.noise)) return "";
  const Ending ending = ended_by(progress, budget);
  std::string line = "reached " + percent_text(progress.noise) + " in " + seconds_text(progress.seconds) +
                     " (" + ending_name(ending) + ")";
  if (ending == Ending::error || progress.noise <= *budget.error) return line;
  if (const auto more = seconds_to_error(progress, *budget.error))
    line += "; " + percent_text(*budget.error) + " would take " + (progress.reliable ? "" : "at least ") +
            seconds_text(*more) + " more";
  return line;
}

bool LineTimes::due(const Progress& progress) noexcept {
  constexpr double kBetween = 5;
  constexpr double kWorthSaying = 1;
  const Forecast end = forecast(progress, budget_);
  const bool known = progress.reliable && end.ending != Ending::none && std::isfinite(end.noise);
  const bool first = !foreseen_ && known && end.seconds >= kWorthSaying;
  if (!first && progress.seconds < next_) return false;
  foreseen_ = true;
  next_ = progress.seconds + kBetween;
  return true;
}

ProgressReport::ProgressReport(const Budget& budget, bool quiet)
    : budget_(budget), quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), lines_(budget) {}

void ProgressReport::show(const Rendering& rendering) {
  if (quiet_) return;
  const Progress progress = progress_of(rendering);
  if (!terminal_ && !lines_.due(progress)) return;
  const std::string line = progress_line(progress, budget_);
  if (!terminal_) {
    std::fprintf(stderr, "%s\n", line.c_str());
    return;
  }
  constexpr int kCells = 20;
  const int filled = static_cast<int>(fraction(progress, budget_) * kCells);
  const std::string bar = std::string(filled, '#') + std::string(kCells - filled, '.');
  std::fprintf(stderr, "\r[%s] %s\x1b[K", bar.c_str(), line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressReport::finish() {
  if (drawn_) std::fputc('\n', stderr);
  drawn_ = false;
}

}  // namespace meander
