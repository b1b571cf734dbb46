#include "app/command_line.h"

#include <charconv>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

#include "core/error.h"

namespace meander {
namespace {

// A validator of one number by a predicate.
CLI::Validator number_check(const std::string& wanted, const std::function<bool(double)>& good,
                            const std::string& in_help = "") {
  return CLI::Validator(
      [wanted, good](const std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && good(value)) return {};
        return "is '" + text + "', but must be " + wanted;
      },
      in_help);
}

std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// The parser's message in one line, with the way to the help.
std::string one_line(const CLI::App& app, const std::string& message) {
  std::string text;
  for (const char c : message) text += c == '\n' ? ' ' : c;
  std::string verb;
  for (const CLI::App* used : app.get_subcommands()) verb = " " + used->get_name();
  return text + " (see: meander" + verb + " --help)";
}

// A first argument that is no verb, which the parser would report as a missing one.
void check_verb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == word) return;
    names.push_back(verb->get_name());
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string nearest = nearest_name(word, known);
  throw Error(Fault::input,
              "there is no verb '" + word + "'; " +
                  (nearest.empty() ? "known: " + list_names(known) : "did you mean '" + nearest + "'?"));
}

}  // namespace

CLI::Validator at_least(double low) {
  return number_check("a number, " + number_text(low) + " or more", [low](double v) { return v >= low; });
}
CLI::Validator greater_than(double low) {
  return number_check("a number greater than " + number_text(low), [low](double v) { return v > low; });
}
CLI::Validator number_between(double low, double high) {
  return number_check(
      "a number from " + number_text(low) + " to " + number_text(high),
      [low, high](double v) { return v >= low && v <= high; },
      "in [" + number_text(low) + ", " + number_text(high) + "]");
}
CLI::Validator finite_number() {
  return number_check("a finite number", [](double) { return true; });
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& text) -> std::string {
        return text.empty() ? "is '', but must be the name of a file or folder" : std::string();
      },
      "");
}

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
  return CLI::Validator(
      [low, high](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [parsed, failed] = std::from_chars(text.data(), end, value);
        if (failed != std::errc() || parsed != end || value < low || value > high)
          return "is '" + text + "', but must be a whole number from " + std::to_string(low) + " to " +
                 std::to_string(high);
        text = std::to_string(value);
        return {};
      },
      "in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
}
CLI::Validator seed_number() {
  return whole_number(0, std::numeric_limits<std::uint64_t>::max()).description("");
}
CLI::Validator sample_count() { return whole_number(1, std::uint64_t{1} << 31); }
CLI::Validator thread_count() { return whole_number(1, 1024); }

int run_command_line(int argc, char** argv) {
  CLI::App app("meander: random walks in translucent materials, seen at once", "meander");
  app.require_subcommand(1);
  app.set_version_flag("--version", MEANDER_VERSION);
  Action action;
  add_preview_command(app, action);
  add_render_command(app, action);
  add_capture_command(app, action);
  add_measure_command(app, action);
  add_compare_command(app, action);
  add_convert_command(app, action);
  add_report_command(app, action);
  add_merge_command(app, action);
  check_verb(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success, std::cout, std::cerr);
  } catch (const CLI::ParseError& error) {
    throw Error(Fault::input, one_line(app, error.what()));
  }
  return action();
}

}  // namespace meander
