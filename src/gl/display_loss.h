// What happens when the X server goes away under an open window.
#pragma once

namespace meander {

/// As long as it lives, a lost connection to the X server ends the process with one line on the error stream
/// that names `meander capture`, and exit code 3; Xlib by itself ends it with code 1, and cannot go on either
/// way.
class DisplayLoss {
 public:
  DisplayLoss();
  DisplayLoss(const DisplayLoss&) = delete;
  DisplayLoss& operator=(const DisplayLoss&) = delete;
  ~DisplayLoss();

  /// A request that the server refuses ends the process likewise from now on: the window is gone.
  void watch_errors();

 private:
  void* old_loss_ = nullptr;
  void* old_error_ = nullptr;
  bool watches_errors_ = false;
};

}  // namespace meander
