// A small report in the making.
#pragma once

#include "app/report_reference.h"
#include "app/report_run.h"
#include "render/first_hits.h"
#include "render/small_scene.h"

namespace meander {

inline const std::atomic<bool> kNever{false};

inline Report prepared() {
  Report report;
  Scene scene = mixed_scene();
  scene.name = "<b>\"jade\" & wax</b>";
  report.job = make_job(std::move(scene), 2);
  report.mask = first_hits(report.job, kNever).mask;
  report.reference = make_reference(report.job, {32, {}, {}}, true, kNever);
  return report;
}

inline ReportPlan plan_to(const Budget& budget) { return {budget, {ReportMethod{}}, {2}, true}; }

}  // namespace meander
