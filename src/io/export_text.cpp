#include "io/export_text.h"

#include <array>
#include <charconv>
#include <cstdint>

namespace meander {
namespace {

constexpr int kDigits = 9;
constexpr int kShortDigits = 4;

std::string digits_text(double value, int digits) {
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return {buffer.data(), end.ptr};
}

bool is_printable(char c) { return c >= 0x20 && c < 0x7f; }

// The first character of a text that is not empty, and how many bytes it takes.
struct Character {
  char32_t code;
  std::size_t bytes;
};

constexpr Character kInvalid{0xfffd, 1};

Character first_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return kInvalid;
  char32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xc0) != 0x80) return kInvalid;
    code = code << 6 | (next & 0x3fu);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeast[bytes] || code > 0x10ffff || surrogate) return kInvalid;
  return {code, bytes};
}

std::string python_escape(char32_t code) {
  const int width = code < 0x100 ? 2 : code < 0x10000 ? 4 : 8;
  std::string text = width == 2 ? "\\x" : width == 4 ? "\\u" : "\\U";
  for (int shift = 4 * (width - 1); shift >= 0; shift -= 4) text += "0123456789abcdef"[code >> shift & 15u];
  return text;
}

}  // namespace

std::string number_text(double value) { return digits_text(value, kDigits); }

std::string short_text(double value) { return digits_text(value, kShortDigits); }

std::string short_text(const DVec3& value) {
  return short_text(value.x) + " " + short_text(value.y) + " " + short_text(value.z);
}

std::string triple_text(const DVec3& value, std::string_view separator) {
  const std::string between(separator);
  return number_text(value.x) + between + number_text(value.y) + between + number_text(value.z);
}

std::string python_string(std::string_view text) {
  std::string literal = "\"";
  while (!text.empty()) {
    const auto [code, bytes] = first_character(text);
    const bool plain = bytes == 1 && is_printable(text[0]);
    if (plain && (code == '"' || code == '\\')) literal += '\\';
    literal += plain ? std::string(1, text[0]) : python_escape(code);
    text.remove_prefix(bytes);
  }
  return literal + '"';
}

std::string identifier_of(std::string_view text) {
  std::string identifier;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (digit && identifier.empty()) identifier += '_';
    identifier += digit || letter ? c : '_';
  }
  return identifier.empty() ? "_" : identifier;
}

std::string one_line_ascii(std::string_view text) {
  std::string line;
  for (const char c : text) line += is_printable(c) ? c : '?';
  return line;
}

std::string hash_comment(std::string_view text) { return "# " + one_line_ascii(text) + '\n'; }

std::string xml_comment(std::string_view text) {
  // Two hyphens would end the comment.
  std::string line;
  for (const char c : one_line_ascii(text)) {
    if (c == '-' && !line.empty() && line.back() == '-') line += ' ';
    line += c;
  }
  return "<!-- " + line + " -->\n";
}

}  // namespace meander
