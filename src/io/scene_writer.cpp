#include "io/scene_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

namespace meander {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::string_view kSections[] = {"scene",       "camera", "film",     "display",
                                          "environment", "light",  "material", "object"};
constexpr std::string_view kScene[] = {"millimetres_per_unit"};
constexpr std::string_view kCamera[] = {"look_from", "look_at", "up", "vertical_fov", "orthographic_height"};
constexpr std::string_view kFilm[] = {"width", "height"};
constexpr std::string_view kDisplay[] = {"exposure", "tone"};
constexpr std::string_view kEnvironment[] = {"radiance", "image", "sky", "rotation", "scale", "visible"};
constexpr std::string_view kLight[] = {"name",     "type",      "center",     "position", "direction",
                                       "look_at",  "up",        "width",      "height",   "radius",
                                       "radiance", "intensity", "irradiance", "visible"};
constexpr std::string_view kMaterial[] = {
    "name",   "type",           "preset",   "color",   "radius",    "radius_scale",
    "albedo", "mean_free_path", "sigma_s",  "sigma_a", "inversion", "g",
    "g_lock", "phase",          "boundary", "ior",     "roughness", "radiance"};
constexpr std::string_view kObject[] = {"name", "shape", "mesh", "up_axis", "material", "transform"};
constexpr std::string_view kTransform[] = {"translate", "rotate", "scale"};
constexpr std::array<Names, std::size(kSections)> kKeys{kScene,       kCamera, kFilm,     kDisplay,
                                                        kEnvironment, kLight,  kMaterial, kObject};

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return bare ? std::string(key) : toml_string(std::string(key));
}

// The keys of a table: those of `order` first, then the others.
std::vector<std::string_view> sorted_keys(const toml::table& table, Names order) {
  std::vector<std::string_view> keys;
  for (const std::string_view key : order)
    if (table.contains(key)) keys.push_back(key);
  for (const auto& entry : table)
    if (std::find(order.begin(), order.end(), entry.first.str()) == order.end())
      keys.push_back(entry.first.str());
  return keys;
}

std::string value_text(const toml::node& node) {
  std::string text;
  if (const auto* list = node.as_array()) {
    for (const toml::node& element : *list) text += (text.empty() ? "" : ", ") + value_text(element);
    return '[' + text + ']';
  }
  if (const auto* table = node.as_table()) {
    for (const std::string_view key : sorted_keys(*table, kTransform))
      text += (text.empty() ? " " : ", ") + key_text(key) + " = " + value_text(*table->get(key));
    return text.empty() ? "{}" : '{' + text + " }";
  }
  if (const auto* number = node.as_floating_point()) return toml_number(number->get());
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* string = node.as_string()) return toml_string(string->get());
  std::ostringstream other;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) other << value;
  });
  return other.str();
}

void write_table(std::string& text, const std::string& heading, const toml::table& table, Names order) {
  if (table.empty()) return;
  if (!text.empty()) text += '\n';
  text += heading + '\n';
  for (const std::string_view key : sorted_keys(table, order))
    text += key_text(key) + " = " + value_text(*table.get(key)) + '\n';
}

}  // namespace

std::string toml_number(double value) {
  std::array<char, 64> digits{};
  std::string text(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  // What looks whole would be read as a whole number: without a sign for 0, and only so large.
  const bool looks_whole = text.find_first_of(".einf") == std::string::npos;
  const bool is_safe = std::abs(value) < 9e15 && !(value == 0 && std::signbit(value));
  return looks_whole && !is_safe ? text + ".0" : text;
}

std::string toml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      std::array<char, 8> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\u%04X", static_cast<unsigned>(c));
      quoted += escaped.data();
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string scene_text(const toml::table& document) {
  std::string text;
  for (const std::string_view section : sorted_keys(document, kSections)) {
    const toml::node& node = *document.get(section);
    const auto* known = std::find(std::begin(kSections), std::end(kSections), section);
    const Names order = known == std::end(kSections) ? Names{} : kKeys[known - std::begin(kSections)];
    if (const toml::table* table = node.as_table()) {
      write_table(text, '[' + key_text(section) + ']', *table, order);
    } else if (const toml::array* list = node.as_array()) {
      for (const toml::node& element : *list)
        if (element.is_table())
          write_table(text, "[[" + key_text(section) + "]]", *element.as_table(), order);
    }
  }
  return text;
}

}  // namespace meander
