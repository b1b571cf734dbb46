#include "core/error.h"

#include <algorithm>
#include <vector>

namespace meander {
namespace {

std::string at_place(const Place& place, const std::string& message) {
  if (place.file.empty()) return message;
  std::string text = place.file;
  if (place.line > 0) {
    text += ':';
    text += std::to_string(place.line);
    if (place.column > 0) text += ':' + std::to_string(place.column);
  }
  text += ": ";
  text += message;
  return text;
}

// A message may quote what a file or a command line holds: control characters, which would break the line or
// drive the terminal, are spelt out.
std::string one_line(const std::string& message) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string line;
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      line += c;
    } else {
      line += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return line;
}

// Levenshtein 1966, one row at a time.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

Error::Error(Fault fault, const std::string& message)
    : std::runtime_error(one_line(message)), fault_(fault) {}

Error::Error(const Place& place, const std::string& message)
    : std::runtime_error(one_line(at_place(place, message))), fault_(Fault::input) {}

std::string nearest_name(const std::string& name, std::span<const std::string_view> known) {
  std::string best;
  std::size_t best_distance = name.size() / 3 + 2;
  for (const std::string_view candidate : known) {
    const std::size_t distance = edit_distance(name, std::string(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string list_names(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

}  // namespace meander
