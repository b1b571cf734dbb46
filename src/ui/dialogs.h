// What comes up over everything else.
#pragma once

#include "ui/layout.h"
#include "ui/widgets.h"

namespace meander {

/// The keys, from the table that they are read from.
void help_overlay(const Ui& ui, const Area& window);
/// Choosing a file: to open, or a name to save under.
void browser_dialog(const Ui& ui, const BrowserModel& model, const Area& window);
/// Messages over the lower end of the picture, the last at the bottom.
void message_toasts(const Ui& ui, const std::vector<Message>& messages, const Area& image);

/// A folder's path and a name as one path; a name that is a path of its own wins.
[[nodiscard]] std::string joined_path(const std::string& folder, const std::string& name);
[[nodiscard]] std::string parent_folder(const std::string& folder);

}  // namespace meander
