#include "io/key_depth.h"

#include <algorithm>

namespace meander {
namespace {

Place place_in(std::string_view text, std::size_t at, const std::string& file) {
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t start = before.rfind('\n') + 1;  // 0 where there is none
  return {file, static_cast<int>(line), static_cast<int>(at - start + 1)};
}

// The end of the string whose opening quote is at `at`. One that does not end, ends with its line or with
// the text: the parser says so.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string triple(3, quote);
  const bool lines = text.substr(at).starts_with(triple);
  for (std::size_t i = at + (lines ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (lines) {
      if (!text.substr(i).starts_with(triple)) continue;
      return std::min(text.find_first_not_of(quote, i), i + 5);  // its last two may be the string's own
    } else if (text[i] == quote || text[i] == '\n') {
      return i + (text[i] == quote ? 1 : 0);
    }
  }
  return text.size();
}

}  // namespace

Error deep_key(const Place& place) {
  return {place, "a key has more than " + std::to_string(kMostKeyParts) +
                     " parts; those of a scene have at most three, such as camera.look_at"};
}

std::optional<Place> find_deep_key(std::string_view text, const std::string& file) {
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '.' && ++dots >= kMostKeyParts) return place_in(text, at, file);
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots = 0;
    ++at;
  }
  return std::nullopt;
}

}  // namespace meander
