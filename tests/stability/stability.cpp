// The suite of numerical stability. Every case must pass, and fail with a fault planted in it.
//   stability                 quick, some seconds
//   stability --long          more samples, minutes
//   stability --table F.csv   writes the table as well
//   stability --only TEXT     the cases with that in their group or name
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "stability/judge.h"
#include "stats/distributions.h"
#include "stats/hypothesis.h"

using namespace meander;

namespace {

struct Options {
  bool long_run = false;
  std::string table;
  std::string only;
};

Options options_of(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_next = i + 1 < words.size();
    if (words[i] == "--long")
      options.long_run = true;
    else if (words[i] == "--table" && has_next)
      options.table = words[++i];
    else if (words[i] == "--only" && has_next)
      options.only = words[++i];
    else
      throw std::invalid_argument("'" + words[i] + "': --long, --table F.csv and --only TEXT are known");
  }
  return options;
}

std::vector<Case> cases_of(const Options& options) {
  std::vector<Case> all;
  add_medium_cases(all);
  add_shape_cases(all);
  add_scene_cases(all);
  std::vector<Case> rows;
  for (Case& row : all) {
    if (options.long_run) row.spp *= row.long_spp;
    if (row.rare && !options.long_run) row.fault = Fault::dense;
    if ((row.group + ' ' + row.name).find(options.only) != std::string::npos) rows.push_back(std::move(row));
  }
  return rows;
}

// The |z| that no row exceeds by chance but once in a thousand runs of the suite.
double threshold_of(const std::vector<Case>& rows) {
  std::size_t count = 0;
  for (const Case& row : rows) count += 2 * z_count(row);
  return two_sided_threshold(sidak_level(1e-3, count));
}

int run_all(const std::vector<Case>& rows, const Options& options) {
  const double threshold = threshold_of(rows);
  std::ofstream table(options.table);
  if (!options.table.empty() && !table) throw std::invalid_argument("cannot write " + options.table);
  if (table.is_open()) table << table_heading() << '\n';
  int failures = 0;
  double seconds = 0;
  for (const Case& row : rows) {
    const Outcome outcome = judge(row, threshold);
    for (const Verdict& verdict : outcome.verdicts) seconds += verdict.seconds;
    if (table.is_open()) table << table_row(row, outcome) << std::endl;
    for (const std::string& reason : outcome.reasons) {
      std::printf("FAILED: %s: %s: %s\n", row.group.c_str(), row.name.c_str(), reason.c_str());
      ++failures;
    }
  }
  std::printf(
      "%zu cases by both walks and with a fault each, |z| up to %.2f allowed, %.1f s of rendering, %d "
      "failures\n",
      rows.size(), threshold, seconds, failures);
  return failures > 0;
}

}  // namespace

int main(int count, char** words) try {
  const Options options = options_of({words + 1, words + count});
  const std::vector<Case> rows = cases_of(options);
  if (rows.empty()) {
    std::puts("no such case");
    return 2;
  }
  return run_all(rows, options);
} catch (const std::invalid_argument& error) {
  std::fprintf(stderr, "stability: %s\n", error.what());
  return 2;
}
