#include "io/toml_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace meander {
namespace {

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "the text '" + std::string(node.value_or<std::string_view>("")) + "'";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string number_text(double value) {
  std::ostringstream stream;
  stream.precision(9);
  stream << value;
  if (std::isnan(value) || std::strtod(stream.str().c_str(), nullptr) == value) return stream.str();
  std::ostringstream exact;
  exact.precision(17);
  exact << value;
  return exact.str();
}

}  // namespace

double number_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  return node.value_or(0.0);
}

void set_triple(toml::table& table, std::string_view key, const DVec3& value) {
  table.insert_or_assign(key, toml::array{value.x, value.y, value.z});
}

void set_color(toml::table& table, std::string_view key, const Rgb& value) {
  DVec3 decimal;
  for (int c = 0; c < 3; ++c) {
    std::array<char, 64> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value[c]).ptr;
    std::from_chars(digits.data(), end, decimal[c]);
  }
  set_triple(table, key, decimal);
}

Place place_of(const toml::node& node, const std::string& file) {
  const toml::source_region& source = node.source();
  if (!source.path) return {file, 0, 0};  // no text that anybody has written
  if (source.path->starts_with("--set ")) return {*source.path, 0, 0};
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Place TomlTable::place(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return node ? place_of(*node, file_) : place();
}

const toml::node* TomlTable::find(std::string_view key) {
  asked_.push_back(key);
  return table_.get(key);
}

void TomlTable::wrong_type(const toml::node& node, std::string_view key, std::string_view wanted) const {
  throw Error(place_of(node, file_),
              "'" + std::string(key) + "' must be " + std::string(wanted) + ", not " + type_name(node));
}

double TomlTable::checked(const toml::node& node, std::string_view key, const Range& range) const {
  if (!node.is_number()) wrong_type(node, key, "a number");
  const double value = number_of(node);
  if (range.contains(value)) return value;
  std::string wanted(range.text);
  if (std::abs(value) > kLargest && range.high == kLargest) wanted += " and at most 1e30 in size";
  throw Error(place_of(node, file_),
              "'" + std::string(key) + "' is " + number_text(value) + ", but must be " + wanted);
}

std::optional<double> TomlTable::number(std::string_view key, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return checked(*node, key, range);
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_integer()) wrong_type(*node, key, "a whole number");
  return static_cast<std::int64_t>(checked(*node, key, range));
}

std::optional<bool> TomlTable::boolean(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_boolean()) wrong_type(*node, key, "true or false");
  return node->value<bool>();
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) wrong_type(*node, key, "text in quotes");
  return node->value<std::string>();
}

std::optional<std::size_t> TomlTable::choice(std::string_view key,
                                             std::span<const std::string_view> allowed) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  for (std::size_t i = 0; i < allowed.size(); ++i)
    if (allowed[i] == *value) return i;
  throw Error(place(key),
              "'" + std::string(key) + "' is '" + *value + "', but must be one of: " + list_names(allowed));
}

std::optional<DVec3> TomlTable::triple(std::string_view key, const Range& range, bool or_single) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (or_single && node->is_number()) return DVec3(checked(*node, key, range));
  const toml::array* list = node->as_array();
  const std::string_view wanted =
      or_single ? "a number or a list of three numbers" : "a list of three numbers";
  if (!list) wrong_type(*node, key, wanted);
  if (list->size() != 3)
    throw Error(place(key), "'" + std::string(key) + "' must be " + std::string(wanted) + ", not a list of " +
                                std::to_string(list->size()));
  DVec3 result;
  for (int i = 0; i < 3; ++i) result[i] = checked((*list)[static_cast<std::size_t>(i)], key, range);
  return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) wrong_type(*node, key, "a table");
  return TomlTable(*node->as_table(), file_, "[" + std::string(key) + "]");
}

const toml::array* TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return nullptr;
  if (!node->is_array_of_tables()) wrong_type(*node, key, "a list of tables, [[" + std::string(key) + "]]");
  return node->as_array();
}

void TomlTable::unknown(const toml::key& key, const toml::node& node,
                        std::span<const std::string_view> known) const {
  const std::string name(key.str());
  const std::string nearest = nearest_name(name, known);
  Place at = place_of(node, file_);
  if (at.line > 0)
    at = {file_, static_cast<int>(key.source().begin.line), static_cast<int>(key.source().begin.column)};
  throw Error(at,
              "unknown key '" + name + "' in " + where_ +
                  (nearest.empty() ? "; known: " + list_names(known) : "; did you mean '" + nearest + "'?"));
}

void TomlTable::missing(std::string_view key) const {
  for (const auto& [present, node] : table_) {
    const bool asked = std::find(asked_.begin(), asked_.end(), present.str()) != asked_.end();
    if (!asked && !nearest_name(std::string(present.str()), {&key, 1}).empty())
      unknown(present, node, {&key, 1});
  }
  throw Error(place(), where_ + " needs '" + std::string(key) + "'");
}

void TomlTable::finish() const {
  for (const auto& [key, node] : table_) {
    bool known = false;
    for (const std::string_view asked : asked_) known |= asked == key.str();
    if (known) continue;
    unknown(key, node, asked_);
  }
}

}  // namespace meander
