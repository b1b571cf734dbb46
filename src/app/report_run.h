// The runs of a report.
#pragma once

#include "app/report.h"

namespace meander {

struct ReportPlan {
  Budget budget;  // the largest
  std::vector<ReportMethod> methods;
  std::vector<int> threads;
  bool quiet = false;
};

/// One run a method and thread count, appended to report.runs: a row at 1, 2, 4, … samples a pixel and at
/// the end of the budget. A row is what a render of that many samples gives, byte for byte, because streams
/// are addressed by sample; one progressive run therefore stands for all of them. Needs job, mask and
/// reference. Once `stop` is true the run ends with what is complete, and no other begins.
void make_runs(Report& report, const ReportPlan& plan, const std::atomic<bool>& stop);

}  // namespace meander
