// How far the work is: a bar on a terminal, plain lines otherwise.
#pragma once

#include <string>

#include "film/plan.h"
#include "render/progressive.h"

namespace meander {

/// What is done and what is to come: " 42.0 %  128 spp  noise 1.92 %  7.1 s  22.9 s to go (time), 0.94 %
/// then".
[[nodiscard]] std::string progress_line(const Progress& progress, const Budget& budget);

/// What was reached of a budget: "reached 1.30 % in 30.0 s (time); 1 % would take 20.7 s more". "" for a
/// budget without error.
[[nodiscard]] std::string closing_line(const Progress& progress, const Budget& budget);

/// "spp", "time", "error", or "interrupt" when the budget was not met.
[[nodiscard]] const char* ending_name(Ending ending) noexcept;

/// When plain lines are due: one as soon as the noise is reliable and a second or more is foreseen, and one
/// every five seconds.
class LineTimes {
 public:
  explicit LineTimes(const Budget& budget) : budget_(budget) {}

  /// Whether a line is due after a pass; taken as printed when it is.
  [[nodiscard]] bool due(const Progress& progress) noexcept;

 private:
  Budget budget_;
  bool foreseen_ = false;  // the first forecast, or a line in its stead, is printed
  double next_ = 5;        // seconds
};

class ProgressReport {
 public:
  ProgressReport(const Budget& budget, bool quiet);

  /// After a pass.
  void show(const Rendering& rendering);
  /// Ends the bar's line.
  void finish();

 private:
  Budget budget_;
  bool quiet_;
  bool terminal_;
  LineTimes lines_;
  bool drawn_ = false;
};

}  // namespace meander
