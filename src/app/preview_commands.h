// Commands of the interface, carried out on what the previewer holds.
#pragma once

#include "app/preview_files.h"
#include "ui/actions.h"

namespace meander {

/// Carries out a command, but those that are for the previewer's own machinery: reload, pause, threads, help
/// and hide_interface. Errors: Error, with nothing changed.
void carry_out(PreviewTools& tools, const Command& command);

}  // namespace meander
