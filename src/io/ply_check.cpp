#include "io/ply_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meander {
namespace {

struct Property {
  std::size_t size = 0;   // of a value, bytes
  std::size_t count = 0;  // of a list's count, bytes; 0: no list
};

struct Element {
  std::string name;
  std::uint64_t instances = 0;
  std::vector<Property> properties;
};

enum class Coding { ascii, little_endian, big_endian };

struct Header {
  Coding coding = Coding::ascii;
  std::vector<Element> elements;
};

// Where the line of end_header ends, its line break left out.
std::size_t find_end(std::string_view text) {
  constexpr std::string_view kEnd = "end_header";
  for (std::size_t at = text.find(kEnd, 1); at != text.npos; at = text.find(kEnd, at + 1)) {
    const std::size_t after = at + kEnd.size();
    const bool starts_line = text[at - 1] == '\n' || text[at - 1] == '\r';
    if (starts_line && after < text.size() && (text[after] == '\n' || text[after] == '\r')) return after;
  }
  throw std::runtime_error("its header has no end_header line");
}

// 0 for a type that is not known.
std::size_t size_of(const std::string& type) {
  using Known = std::pair<std::string_view, std::size_t>;
  constexpr std::array<Known, 16> kTypes{{{"char", 1},
                                          {"uchar", 1},
                                          {"int8", 1},
                                          {"uint8", 1},
                                          {"short", 2},
                                          {"ushort", 2},
                                          {"int16", 2},
                                          {"uint16", 2},
                                          {"int", 4},
                                          {"uint", 4},
                                          {"int32", 4},
                                          {"uint32", 4},
                                          {"float", 4},
                                          {"float32", 4},
                                          {"double", 8},
                                          {"float64", 8}}};
  const auto found = std::ranges::find(kTypes, type, &Known::first);
  return found == kTypes.end() ? 0 : found->second;
}

std::optional<Property> property_of(std::istringstream& words) {
  std::string type;
  words >> type;
  if (type != "list") return size_of(type) > 0 ? std::optional(Property{size_of(type), 0}) : std::nullopt;
  std::string count;
  words >> count >> type;
  const bool whole = count.find("int") != count.npos || count.find("char") != count.npos ||
                     count.find("short") != count.npos;
  if (!whole || size_of(count) == 0 || size_of(type) == 0) return std::nullopt;
  return Property{size_of(type), size_of(count)};
}

// Nothing where a line of the header is not known.
std::optional<Header> parse_header(std::string_view text) {
  constexpr std::array<std::string_view, 3> kCodings{"ascii", "binary_little_endian", "binary_big_endian"};
  Header header;
  std::string all(text);
  std::ranges::replace(all, '\r', '\n');
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    std::string second;
    words >> first;
    if (first == "format") {
      words >> second;
      const auto coding = std::ranges::find(kCodings, second);
      if (coding == kCodings.end()) return std::nullopt;
      header.coding = static_cast<Coding>(coding - kCodings.begin());
    } else if (first == "element") {
      Element element;
      if (!(words >> element.name >> element.instances)) return std::nullopt;
      header.elements.push_back(std::move(element));
    } else if (first == "property") {
      const auto property = property_of(words);
      if (!property || header.elements.empty()) return std::nullopt;
      header.elements.back().properties.push_back(*property);
    }
  }
  return header;
}

[[noreturn]] void ends_within(const Element& element, std::uint64_t instance) {
  throw std::runtime_error("it ends within " + element.name + " " + std::to_string(instance + 1) + " of " +
                           std::to_string(element.instances));
}

// `unknown`: the rest cannot be told, and is assimp's to say.
enum class Passed { whole, ends, unknown };

// What follows a header, property by property.
class BinaryBody {
 public:
  BinaryBody(std::span<const std::uint8_t> bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  [[nodiscard]] Passed pass(const Property& property) {
    if (bytes_.size() < property.count) return Passed::ends;
    const std::uint64_t values = property.count > 0 ? count_of(property.count) : 1;
    bytes_ = bytes_.subspan(property.count);
    if (values > bytes_.size() / property.size) return Passed::ends;
    bytes_ = bytes_.subspan(values * property.size);
    return Passed::whole;
  }

 private:
  [[nodiscard]] std::uint64_t count_of(std::size_t size) const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < size; ++i) count = count << 8 | bytes_[big_endian_ ? i : size - 1 - i];
    return count;
  }

  std::span<const std::uint8_t> bytes_;
  bool big_endian_;
};

class AsciiBody {
 public:
  explicit AsciiBody(std::string_view text) : text_(text) {}

  [[nodiscard]] Passed pass(const Property& property) {
    std::uint64_t values = 1;
    if (property.count > 0) {
      const std::string_view word = next();
      const auto [parsed, failed] = std::from_chars(word.data(), word.data() + word.size(), values);
      if (word.empty()) return Passed::ends;
      if (failed != std::errc() || parsed != word.data() + word.size()) return Passed::unknown;
    }
    for (std::uint64_t i = 0; i < values; ++i)
      if (next().empty()) return Passed::ends;
    return Passed::whole;
  }

 private:
  [[nodiscard]] std::string_view next() {
    constexpr std::string_view kBlanks = " \t\r\n\f\v";
    const std::size_t begin = std::min(text_.find_first_not_of(kBlanks), text_.size());
    const std::size_t end = std::min(text_.find_first_of(kBlanks, begin), text_.size());
    const std::string_view word = text_.substr(begin, end - begin);
    text_ = text_.substr(end);
    return word;
  }

  std::string_view text_;
};

template <class Body>
void check_body(const Header& header, Body body) {
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::uint64_t instance = 0; instance < element.instances; ++instance)
      for (const Property& property : element.properties) {
        const Passed passed = body.pass(property);
        if (passed == Passed::unknown) return;
        if (passed == Passed::ends) ends_within(element, instance);
      }
  }
}

}  // namespace

void check_ply(std::span<const std::uint8_t> content) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  const std::size_t end = find_end(text);
  const auto header = parse_header(text.substr(0, end));
  if (!header) return;
  // The line breaks of the whole header are alike; what looks like one more byte of them is a number.
  const std::size_t first_break = text.find_first_of("\r\n");
  const bool two = text.substr(first_break).starts_with("\r\n");
  const std::size_t begin = std::min(end + (two ? 2 : 1), content.size());
  if (header->coding == Coding::ascii)
    check_body(*header, AsciiBody(text.substr(begin)));
  else
    check_body(*header, BinaryBody(content.subspan(begin), header->coding == Coding::big_endian));
}

}  // namespace meander
