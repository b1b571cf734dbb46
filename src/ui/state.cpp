#include "ui/state.h"

namespace meander {
namespace {

bool close_something(UiState& state) {
  if (state.browser != BrowserUse::closed) {
    state.browser = BrowserUse::closed;
    return true;
  }
  const bool was_open = state.help || state.hidden;
  if (state.help) {
    state.help = false;
  } else {
    state.hidden = false;
  }
  return was_open;
}

void open_browser(UiState& state, BrowserUse use) {
  state.browser = use;
  state.hidden = false;
  state.help = false;
  state.path.clear();
}

}  // namespace

bool carry_out(UiState& state, const Command& command) {
  switch (command.kind) {
    case CommandKind::help:
      state.help = !state.help;
      return true;
    case CommandKind::hide_interface:
      state.hidden = !state.hidden;
      return true;
    case CommandKind::open_browser:
      open_browser(state, BrowserUse::open);
      return true;
    case CommandKind::save_browser:
      open_browser(state, BrowserUse::save_scene);
      return true;
    case CommandKind::save_picture_browser:
      open_browser(state, BrowserUse::save_picture);
      return true;
    case CommandKind::quit:
      return close_something(state);
    default:
      return false;
  }
}

}  // namespace meander
