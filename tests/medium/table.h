// A reference table: the header names the columns.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace meander {

using Row = std::map<std::string, double>;

/// The rows of tests/reference/NAME; an empty field reads as 0. Fails the test when there are none.
inline std::vector<Row> read_table(const std::string& name) {
  std::ifstream file(std::string(MEANDER_SOURCE_DIR) + "/tests/reference/" + name);
  const auto split = [](const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
  };
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = split(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = split(line);
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) {
      row[names[i]] = i < fields.size() ? std::strtod(fields[i].c_str(), nullptr) : 0;
    }
    rows.push_back(row);
  }
  REQUIRE_MESSAGE(!rows.empty(), name);
  return rows;
}

}  // namespace meander
