// The command line: one binary, one verb.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace meander {

/// Parses the arguments and runs the verb. Returns the exit code: 0 fine, 1 a comparison that failed. Errors:
/// Error for wrong use, and whatever the verb throws.
[[nodiscard]] int run_command_line(int argc, char** argv);

/// What a verb does once the command line is parsed; returns the exit code.
using Action = std::function<int()>;

// Each adds one verb, and sets `action` when that verb is on the command line.
void add_render_command(CLI::App& app, Action& action);
void add_preview_command(CLI::App& app, Action& action);
void add_capture_command(CLI::App& app, Action& action);
void add_measure_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_convert_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_merge_command(CLI::App& app, Action& action);

/// Checks of numbers that the parser makes while it still knows the option's name.
[[nodiscard]] CLI::Validator at_least(double low);
[[nodiscard]] CLI::Validator greater_than(double low);
[[nodiscard]] CLI::Validator number_between(double low, double high);
[[nodiscard]] CLI::Validator finite_number();
/// Not empty.
[[nodiscard]] CLI::Validator file_name();
/// Digits alone, below 2^64: the parser would take -1 for a very large seed.
[[nodiscard]] CLI::Validator whole_number();

}  // namespace meander
