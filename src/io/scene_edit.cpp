#include "io/scene_edit.h"

#include <algorithm>
#include <array>
#include <deque>
#include <vector>

#include "io/key_depth.h"
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

// The names of a list of tables, in order; without a name a table has the one that the reader gives it:
// light1, object2.
std::deque<std::string> names_of(const toml::table& document, const std::string& list) {
  std::deque<std::string> names;
  const toml::array* elements = document[list].as_array();
  if (!elements || !elements->is_array_of_tables()) return names;
  for (const toml::node& element : *elements) {
    const std::string usual = list + std::to_string(names.size() + 1);
    names.push_back((*element.as_table())["name"].value_or(usual));
  }
  return names;
}

// The parts of a path. A name in a list may hold dots itself: the longest one that fits is meant.
std::vector<std::string> split_path(const toml::table& document, const std::string& path) {
  const std::size_t dot = path.find('.');
  const std::string list = path.substr(0, dot);
  if (dot == std::string::npos || std::find(kLists.begin(), kLists.end(), list) == kLists.end())
    return split(path);
  const std::string rest = path.substr(dot + 1);
  std::string name = rest.substr(0, rest.find('.'));
  for (const std::string& known : names_of(document, list))
    if (known.size() > name.size() && rest.starts_with(known + '.')) name = known;
  std::vector<std::string> parts{list, name};
  if (name.size() == rest.size()) return parts;
  for (std::string& part : split(rest.substr(name.size() + 1))) parts.push_back(std::move(part));
  return parts;
}

// Parses a value the way the file would; what is not TOML is plain text.
toml::table parse_value(const std::string& text, const std::string& source) {
  if (find_deep_key(text, source)) throw deep_key({source, 0, 0});
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

// Checked when the scene is read.
double millimetres_of(const toml::table& document) {
  const toml::table* scene = document["scene"].as_table();
  const toml::node* millimetres = scene ? scene->get("millimetres_per_unit") : nullptr;
  return millimetres && millimetres->is_number() ? number_of(*millimetres) : 1;
}

toml::table& descend(toml::table& table, const std::string& key, const Place& place) {
  if (!table.contains(key)) table.insert(key, toml::table{});
  toml::table* inner = table[key].as_table();
  if (!inner) throw Error(place, "'" + key + "' is not a table");
  return *inner;
}

}  // namespace

toml::table& find_named(toml::table& document, const std::string& list, const std::string& name,
                        const Place& place) {
  const std::deque<std::string> names = names_of(document, list);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end())
    return *document[list].as_array()->get(static_cast<std::size_t>(found - names.begin()))->as_table();
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string known = names.empty() ? "the scene has none" : "known: " + list_names(views);
  throw Error(place, "there is no " + list + " named '" + name + "'; " + known);
}

void apply_edit(toml::table& document, const std::string& edit, const std::string& file, ColorMaps& maps) {
  if (edit.find_first_of("\n\r") != std::string::npos)
    throw Error(Place{"--set", 0, 0}, "an edit must be one line");
  const Place place{"--set " + edit, 0, 0};
  const std::size_t equals = edit.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == edit.size())
    throw Error(place, "an edit must read PATH=VALUE, such as material.wax.g=0.4");
  const std::vector<std::string> parts = split_path(document, edit.substr(0, equals));
  const bool named = std::find(kLists.begin(), kLists.end(), std::string_view(parts[0])) != kLists.end();
  const std::size_t first_key = named ? 2 : 1;
  if (parts.size() > kMostKeyParts) throw deep_key(place);
  if (parts.size() <= first_key)
    throw Error(place, named ? "a path into a list must read " + parts[0] + ".NAME.KEY"
                             : "a path must read SECTION.KEY, such as film.width");
  toml::table* table =
      named ? &find_named(document, parts[0], parts[1], place) : &descend(document, parts[0], place);
  const MediumTools tools{millimetres_of(document), maps};
  toml::table value = parse_value(edit.substr(equals + 1), place.file);
  if (parts[0] == "material") {
    const std::string& key = parts[first_key];
    if (const auto target = parametrisation_of(key)) convert_material(*table, *target, file, tools);
    if (key == "g" && value["v"].is_number()) hold_for_g(*table, number_of(*value.get("v")), file, tools);
    if (key == "preset") clear_medium(*table);
  }
  for (std::size_t i = first_key; i + 1 < parts.size(); ++i) table = &descend(*table, parts[i], place);
  value.get("v")->visit([&](auto& node) { table->insert_or_assign(parts.back(), std::move(node)); });
}

}  // namespace meander
