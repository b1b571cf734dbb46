// The command line: one binary, one verb.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
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
/// Decimal digits alone; to be given as a `transform`, for it takes leading zeros away: the parser would read
/// them as octal, and -1 as a very large seed.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
[[nodiscard]] CLI::Validator seed_number();
/// From 1 on, and no more than a pixel can count.
[[nodiscard]] CLI::Validator sample_count();
[[nodiscard]] CLI::Validator thread_count();

}  // namespace meander
