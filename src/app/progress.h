// How far the work is: a bar on a terminal, plain lines otherwise.
#pragma once

#include "film/plan.h"
#include "render/progressive.h"

namespace meander {

class ProgressReport {
 public:
  ProgressReport(const Budget& budget, bool quiet);

  /// After a pass.
  void show(const Rendering& rendering);
  /// Ends the bar's line.
  void finish();

 private:
  [[nodiscard]] double fraction(const Rendering& rendering) const;

  Budget budget_;
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  double next_line_ = 5;  // seconds at which the next plain line is due
};

}  // namespace meander
