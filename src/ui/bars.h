// The fixed bars around the picture, each a window of its own at its place.
#pragma once

#include "ui/layout.h"
#include "ui/widgets.h"

namespace meander {

void toolbar(const Ui& ui, const UiModel& model, const Area& area);
void snapshot_strip(const Ui& ui, const SnapshotStrip& model, const Area& area);
void sparkline(const Ui& ui, const StatisticsModel& model, const Area& area);
void status_line(const Ui& ui, const UiModel& model, const Area& area);
/// The sections at the right.
void side_panel(const Ui& ui, const UiModel& model, const Area& area);

/// "128 spp · 6.2 s · noise 1.8 % · 1 % in 14 s · implicit".
[[nodiscard]] std::string status_text(const StatisticsModel& model, double target, bool paused);

/// Opens a window without decoration over the area; ImGui::End() closes it. Those of begin_area lie behind
/// those of begin_dialog, which have a border.
void begin_area(const char* name, const Area& area, ImU32 color, const ImVec2& padding);
void begin_dialog(const char* name, const Area& area, const ImVec2& padding);

}  // namespace meander
