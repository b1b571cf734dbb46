// The whole interface of a frame.
#pragma once

#include "ui/actions.h"
#include "ui/layout.h"
#include "ui/models.h"
#include "ui/state.h"

namespace meander {

/// Between Interface::begin_frame and end_frame. Nothing is drawn while the interface is hidden, save
/// messages and the help. The layout is that of the window and state.hidden.
[[nodiscard]] UiActions draw_interface(const UiModel& model, UiState& state, const Layout& layout);

/// One section of the panel alone, open, over the whole window.
[[nodiscard]] UiActions draw_panel(PanelName name, const UiModel& model, UiState& state, const Area& window);

}  // namespace meander
