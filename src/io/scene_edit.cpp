#include "io/scene_edit.h"

#include <algorithm>
#include <array>
#include <deque>
#include <vector>

#include "io/medium_file.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 3> kLists{"material", "light", "object"};

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// Parses a value the way the file would; what is not TOML is plain text.
toml::table parse_value(const std::string& text, const std::string& source) {
  try {
    return toml::parse("v = " + text, source);
  } catch (const toml::parse_error&) {
    std::string quoted;
    for (const char c : text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
    try {
      return toml::parse("v = \"" + quoted + "\"", source);
    } catch (const toml::parse_error& error) {
      throw Error(Place{source, 0, 0}, std::string(error.description()));
    }
  }
}

// The element of a list of tables that has this name.
toml::table& find_named(toml::table& document, const std::string& list, const std::string& name,
                        const Place& place) {
  std::vector<std::string_view> names;
  std::deque<std::string> defaults;
  if (toml::array* elements = document[list].as_array()) {
    for (toml::node& element : *elements) {
      toml::table* table = element.as_table();
      if (!table) continue;
      // Without a name it has the one that the reader gives it: light1, object2.
      defaults.push_back(list + std::to_string(defaults.size() + 1));
      const std::string_view known = (*table)["name"].value_or<std::string_view>(defaults.back());
      if (known == name) return *table;
      names.push_back(known);
    }
  }
  const std::string known = names.empty() ? "the scene has none" : "known: " + list_names(names);
  throw Error(place, "there is no " + list + " named '" + name + "'; " + known);
}

toml::table& descend(toml::table& table, const std::string& key, const Place& place) {
  if (!table.contains(key)) table.insert(key, toml::table{});
  toml::table* inner = table[key].as_table();
  if (!inner) throw Error(place, "'" + key + "' is not a table");
  return *inner;
}

}  // namespace

void apply_edit(toml::table& document, const std::string& edit, const std::string& file) {
  const Place place{"--set " + edit, 0, 0};
  const std::size_t equals = edit.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == edit.size())
    throw Error(place, "an edit must read PATH=VALUE, such as material.wax.g=0.4");
  const std::vector<std::string> parts = split(edit.substr(0, equals));
  const bool named = std::find(kLists.begin(), kLists.end(), std::string_view(parts[0])) != kLists.end();
  const std::size_t first_key = named ? 2 : 1;
  if (parts.size() <= first_key)
    throw Error(place, named ? "a path into a list must read " + parts[0] + ".NAME.KEY"
                             : "a path must read SECTION.KEY, such as film.width");
  toml::table* table =
      named ? &find_named(document, parts[0], parts[1], place) : &descend(document, parts[0], place);
  const double millimetres = document["scene"]["millimetres_per_unit"].value_or(1.0);
  toml::table value = parse_value(edit.substr(equals + 1), place.file);
  if (parts[0] == "material") {
    const std::string& key = parts[first_key];
    if (const auto target = parametrisation_of(key)) convert_material(*table, *target, file, millimetres);
    if (key == "g" && value["v"].is_number())
      hold_for_g(*table, *value["v"].value<double>(), file, millimetres);
    if (key == "preset") clear_medium(*table);
  }
  for (std::size_t i = first_key; i + 1 < parts.size(); ++i) table = &descend(*table, parts[i], place);
  value.get("v")->visit([&](auto& node) { table->insert_or_assign(parts.back(), std::move(node)); });
}

}  // namespace meander
