// Comma-separated tables for tests: the reference values, and whatever a command wrote.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace meander {

/// Cells as text, rows of equal length; `names` is empty when the file has no header.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  [[nodiscard]] const std::string& text(std::size_t row, const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::runtime_error("no column \"" + name + "\"");
    return rows.at(row).at(static_cast<std::size_t>(found - names.begin()));
  }
  /// The cell as the nearest double; throws when it is not a number through to its end.
  [[nodiscard]] double number(std::size_t row, const std::string& name) const {
    return parse_number(text(row, name));
  }
  [[nodiscard]] double number(std::size_t row, std::size_t column) const {
    return parse_number(rows.at(row).at(column));
  }

 private:
  static double parse_number(const std::string& cell) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0') throw std::runtime_error("not a number: \"" + cell + "\"");
    return value;
  }
};

/// Reads a file without quoted cells, lines that begin with # left out; throws std::runtime_error when it is
/// missing, empty or ragged.
[[nodiscard]] inline CsvTable read_csv(const std::string& path, bool header = true) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  CsvTable table;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (line.back() == ',') cells.emplace_back();
    table.rows.push_back(cells);
    if (cells.size() != table.rows.front().size()) throw std::runtime_error("ragged row in " + path);
  }
  if (header && !table.rows.empty()) {
    table.names = table.rows.front();
    table.rows.erase(table.rows.begin());
  }
  if (table.rows.empty()) throw std::runtime_error("no rows in " + path);
  return table;
}

/// A table of tests/reference, by file name.
[[nodiscard]] inline CsvTable reference_table(const std::string& name, bool header = true) {
  return read_csv(std::string(MEANDER_SOURCE_DIR) + "/tests/reference/" + name, header);
}

}  // namespace meander
