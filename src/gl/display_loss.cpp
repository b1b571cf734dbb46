#include "gl/display_loss.h"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace meander {
namespace {

// Xlib's handlers as C sees them. Its functions are looked up among those that the window library brought
// along: with another window system there are none, and nothing to handle.
using Install = void* (*)(void* handler);

void* install(const char* function, void* handler) {
  const auto found = reinterpret_cast<Install>(dlsym(RTLD_DEFAULT, function));
  return found == nullptr ? nullptr : found(handler);
}

// No destructor runs: they would talk to the server that is gone.
[[noreturn]] void end_process(const char* what) {
  std::fprintf(stderr, "meander: %s; without a display, use: meander capture SCENE -o OUT.png\n", what);
  std::fflush(stderr);
  std::_Exit(3);
}

int on_loss(void*) { end_process("the connection to the display was lost"); }

int on_error(void*, void*) {
  end_process("the display refused a request, as it does when the window was destroyed");
}

}  // namespace

DisplayLoss::DisplayLoss() : old_loss_(install("XSetIOErrorHandler", reinterpret_cast<void*>(on_loss))) {}

DisplayLoss::~DisplayLoss() {
  install("XSetIOErrorHandler", old_loss_);
  if (watches_errors_) install("XSetErrorHandler", old_error_);
}

void DisplayLoss::watch_errors() {
  watches_errors_ = true;
  old_error_ = install("XSetErrorHandler", reinterpret_cast<void*>(on_error));
}

}  // namespace meander
