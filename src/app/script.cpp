#include "app/script.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 16> kVerbs{"set",     "wait-spp", "wait", "key",       "move", "press",
                                                  "release", "click",    "drag", "scroll",    "text", "drop",
                                                  "size",    "snapshot", "quit", "wait-image"};
constexpr std::array<std::string_view, 3> kButtons{"left", "right", "middle"};
constexpr int kDragSteps = 12;

struct NamedKey {
  std::string_view name;
  int code;
};
constexpr std::array<NamedKey, 16> kNamedKeys{{{"space", ' '},
                                               {"escape", key::kEscape},
                                               {"esc", key::kEscape},
                                               {"enter", key::kEnter},
                                               {"tab", key::kTab},
                                               {"backspace", key::kBackspace},
                                               {"delete", key::kDelete},
                                               {"right", key::kRight},
                                               {"left", key::kLeft},
                                               {"down", key::kDown},
                                               {"up", key::kUp},
                                               {"pageup", key::kPageUp},
                                               {"pagedown", key::kPageDown},
                                               {"home", key::kHome},
                                               {"end", key::kEnd},
                                               {"plus", '+'}}};

std::string lower(std::string_view text) {
  std::string small;
  for (const char c : text) small += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return small;
}

// The words of one line, and where they stand.
class LineReader {
 public:
  LineReader(const std::string& line, const std::string& file, int number)
      : line_(line), file_(file), number_(number) {}

  [[nodiscard]] bool done() {
    at_ = line_.find_first_not_of(" \t\r", at_);
    if (at_ == std::string::npos || line_[at_] == '#') at_ = line_.size();
    return at_ == line_.size();
  }
  [[nodiscard]] std::string word(const char* wanted) {
    if (done()) fail(std::string("expected ") + wanted);
    start_ = at_;
    at_ = std::min(line_.find_first_of(" \t\r", at_), line_.size());
    return line_.substr(start_, at_ - start_);
  }
  // What is left of the line, blanks at its end aside.
  [[nodiscard]] std::string rest(const char* wanted) {
    if (done()) fail(std::string("expected ") + wanted);
    start_ = at_;
    const std::size_t last = line_.find_last_not_of(" \t\r");
    at_ = line_.size();
    return line_.substr(start_, last + 1 - start_);
  }
  [[nodiscard]] double number(const char* wanted, double low, double high) {
    const std::string text = word(wanted);
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
      fail("'" + text + "' is not " + wanted);
    return value;
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(Place{file_, number_, static_cast<int>(start_) + 1}, message);
  }

 private:
  const std::string& line_;
  const std::string& file_;
  int number_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;
};

InputEvent move_event(double x, double y) {
  InputEvent event;
  event.kind = InputKind::move;
  event.x = x;
  event.y = y;
  return event;
}

InputEvent button_event(int button, bool down) {
  InputEvent event;
  event.kind = InputKind::button;
  event.code = button;
  event.down = down;
  return event;
}

int key_code(LineReader& line, const std::string& name) {
  if (name.size() == 1 && name[0] > ' ')
    return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
  const std::string small = lower(name);
  for (const NamedKey& known : kNamedKeys)
    if (known.name == small) return known.code;
  int number = 0;
  const auto [end, code] = std::from_chars(small.data() + 1, small.data() + small.size(), number);
  if (small[0] == 'f' && code == std::errc{} && end == small.data() + small.size() && number >= 1 &&
      number <= 12)
    return key::kF1 + number - 1;
  line.fail("'" + name +
            "' is no key; keys are letters, digits, signs, F1 to F12, Space, Escape, Enter, Tab, arrows …");
}

InputEvent key_event(LineReader& line) {
  std::string chord = line.word("a key, such as Ctrl+Z");
  InputEvent event;
  event.kind = InputKind::key;
  for (std::size_t plus = chord.find('+', 1); plus != std::string::npos && plus + 1 < chord.size();
       plus = chord.find('+', 1)) {
    const std::string modifier = lower(chord.substr(0, plus));
    chord.erase(0, plus + 1);
    if (modifier == "ctrl")
      event.modifiers.control = true;
    else if (modifier == "shift")
      event.modifiers.shift = true;
    else if (modifier == "alt")
      event.modifiers.alt = true;
    else
      line.fail("'" + modifier + "' is no modifier; use Ctrl, Shift or Alt");
  }
  event.code = key_code(line, chord);
  event.down = true;
  return event;
}

int read_button(LineReader& line) {
  const std::string name = line.word("a mouse button: left, right or middle");
  for (std::size_t i = 0; i < kButtons.size(); ++i)
    if (kButtons[i] == name) return static_cast<int>(i);
  line.fail("'" + name + "' is no mouse button; use left, right or middle");
}

constexpr double kFar = 1e6;
constexpr const char* kPosition = "a position in window points";

using Steps = std::vector<ScriptStep>;

Steps read_mouse(LineReader& line, const std::string& verb) {
  if (verb == "press" || verb == "release")
    return {EventStep{button_event(read_button(line), verb == "press")}};
  const int button = verb == "drag" ? read_button(line) : 0;
  const double x = line.number(kPosition, -kFar, kFar);
  const double y = line.number(kPosition, -kFar, kFar);
  Steps steps{EventStep{move_event(x, y)}};
  if (verb == "move") return steps;
  steps.emplace_back(EventStep{button_event(button, true)});
  if (verb == "drag") {
    const double to_x = line.number(kPosition, -kFar, kFar);
    const double to_y = line.number(kPosition, -kFar, kFar);
    for (int i = 1; i <= kDragSteps; ++i) {
      const double t = static_cast<double>(i) / kDragSteps;
      steps.emplace_back(EventStep{move_event(x + t * (to_x - x), y + t * (to_y - y))});
    }
  }
  steps.emplace_back(EventStep{button_event(button, false)});
  return steps;
}

Steps read_key(LineReader& line) {
  InputEvent event = key_event(line);
  Steps steps{EventStep{event}};
  event.down = false;
  event.modifiers = {};  // released first, or a text that follows would be typed with Ctrl held
  steps.emplace_back(EventStep{event});
  return steps;
}

Steps read_text(LineReader& line) {
  Steps steps;
  for (const char c : line.rest("the text to type")) {
    if (static_cast<unsigned char>(c) >= 0x80) line.fail("text must be ASCII");
    InputEvent event;
    event.kind = InputKind::text;
    event.character = static_cast<char32_t>(c);
    steps.emplace_back(EventStep{event});
  }
  return steps;
}

SnapshotStep read_snapshot(LineReader& line) {
  const std::string path = line.rest("a file name ending in .png");
  if (lower(std::filesystem::path(path).extension().string()) != ".png")
    line.fail("'" + path + "' must end in .png");
  return {path};
}

Steps read_command(LineReader& line) {
  const std::string verb = line.word("a command");
  if (verb == "set") return {SetStep{line.rest("PATH=VALUE")}};
  if (verb == "wait-spp")
    return {WaitSppStep{static_cast<std::uint64_t>(line.number("a number of samples, 1 or more", 1, 1e9))}};
  if (verb == "wait") return {WaitStep{line.number("a number of seconds", 0, 86400)}};
  if (verb == "key") return read_key(line);
  if (verb == "move" || verb == "press" || verb == "release" || verb == "click" || verb == "drag")
    return read_mouse(line, verb);
  if (verb == "text") return read_text(line);
  if (verb == "snapshot") return {read_snapshot(line)};
  if (verb == "quit") return {QuitStep{}};
  if (verb == "wait-image") return {WaitImageStep{}};
  if (verb == "scroll") {
    InputEvent event;
    event.kind = InputKind::scroll;
    event.y = line.number("a number of wheel steps", -100, 100);
    return {EventStep{event}};
  }
  if (verb == "drop") {
    InputEvent event;
    event.kind = InputKind::drop;
    event.paths = {line.rest("a path")};
    return {EventStep{event}};
  }
  if (verb == "size") {
    const double width = line.number("a width from 1 to 16384", 1, 16384);
    const double height = line.number("a height from 1 to 16384", 1, 16384);
    return {SizeStep{static_cast<int>(width), static_cast<int>(height)}};
  }
  const std::string nearest = nearest_name(verb, kVerbs);
  line.fail("there is no command '" + verb + "'; " +
            (nearest.empty() ? "known: " + list_names(kVerbs) : "did you mean '" + nearest + "'?"));
}

}  // namespace

std::vector<ScriptLine> parse_script(const std::string& text, const std::string& file) {
  std::vector<ScriptLine> script;
  std::istringstream stream(text);
  std::string content;
  for (int number = 1; std::getline(stream, content); ++number) {
    LineReader line(content, file, number);
    if (line.done()) continue;
    for (ScriptStep& step : read_command(line)) script.push_back({std::move(step), number});
    if (!line.done()) line.fail("'" + line.word("nothing") + "' is more than this command takes");
  }
  return script;
}

std::vector<ScriptLine> load_script(const std::string& path) {
  std::error_code code;
  std::ifstream stream(path, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(path, code))
    throw Error(Place{path, 0, 0}, "cannot be read as a script");
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_script(text.str(), path);
}

}  // namespace meander
