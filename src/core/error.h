// The one error type for the outside world: bad input and failures at run time.
// Our own mistakes are assertions; an expected absence is std::optional.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace meander {

/// A place in a text file; line and column count from 1, 0 means unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// What went wrong decides the exit code: 2 for wrong use or bad input, 3 for a failure at run time.
enum class Fault { input = 2, runtime = 3 };

/// One line that says what is wrong, with the wrong value and the right ones. `main` alone prints it. Control
/// characters in the message, as of a quoted file, are spelt out (\x0a).
class Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& message);
  /// Bad input at a place: the line reads `file:line:column: message`.
  Error(const Place& place, const std::string& message);

  [[nodiscard]] Fault fault() const noexcept { return fault_; }
  [[nodiscard]] int exit_code() const noexcept { return static_cast<int>(fault_); }

 private:
  Fault fault_;
};

/// The name among `known` that is nearest to `name` in edit distance; empty when none is within a third of
/// its length plus one.
[[nodiscard]] std::string nearest_name(const std::string& name, std::span<const std::string_view> known);

/// The names in one line, separated by commas: what an error message lists as allowed.
[[nodiscard]] std::string list_names(std::span<const std::string_view> names);

}  // namespace meander
