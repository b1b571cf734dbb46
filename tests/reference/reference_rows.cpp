// Runs rows of the reference tables through `measure`, with both walks and independent random numbers, and
// holds the z-scores of each walk against the table, and of one walk against the other, to what chance
// allows: the largest |z| to the Sidak bound of the family at level 1e-3, the mean of z^2 (first value of
// each run) to within 4 sqrt(2 / N) of 1.
//
//   reference_rows                      every seventh row at a relative standard error of 1 %, scalar 2 %
//   reference_rows --all                every row at 0.2 %; rows go into z_scores.csv.part as they end, which
//                                       becomes z_scores.csv with the last
//   reference_rows --all --resume       keeps the rows that such a part already has
//   reference_rows --rows TEXT          only the rows whose name contains TEXT, at 0.2 %; no file
//   ... --threads N                     all threads by default
//
// A row's walks are as many as bring each of its totals (R, T; of spheres the absorbed and the escaping
// fraction) to the target, by a pilot run. The unscattered transmittance comes along at
// whatever error it then has, and counts where at least 200 unscattered walks are expected.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/timer.h"
#include "reference/reference_cases.h"
#include "render/parallel.h"
#include "stats/distributions.h"
#include "support/csv.h"

using namespace meander;

namespace {

struct Options {
  bool all = false;
  bool resume = false;
  std::string rows;
  int threads = hardware_threads();
  [[nodiscard]] bool is_spread() const { return !all && rows.empty(); }
  [[nodiscard]] double target(WalkCode walk) const {
    return !is_spread() ? 0.002 : walk == WalkCode::batch ? 0.01 : 0.02;
  }
};

struct Score {
  std::string name;
  std::string walk;
  std::string quantity;
  double exact = 0;
  double measured = 0;
  double error = 0;
  double z = 0;
  double walks = 0;
  bool first = false;
  bool settles = false;
};

const std::string kFile = std::string(MEANDER_SOURCE_DIR) + "/tests/reference/z_scores.csv";
const std::string kPart = kFile + ".part";
constexpr std::uint64_t kPilot = 20000;
constexpr int kFewRuns = 20;
constexpr std::size_t kMostRows = 1000;  // seeds of scalar walks begin beyond
constexpr WalkCode kWalks[] = {WalkCode::batch, WalkCode::scalar};

std::string name_of(WalkCode walk) { return walk == WalkCode::batch ? "batch" : "scalar"; }

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool last = i + 1 == argc;
    if (arg == "--all")
      o.all = true;
    else if (arg == "--resume")
      o.resume = true;
    else if (arg == "--rows" && !last)
      o.rows = argv[++i];
    else if (arg == "--threads" && !last)
      o.threads = std::max(std::atoi(argv[++i]), 1);
    else
      throw std::runtime_error("unknown option " + arg + " (--all, --resume, --rows TEXT, --threads N)");
  }
  return o;
}

// The largest relative standard error among the totals.
double coarsest_total(const Measurement& m, const std::vector<Expected>& expected) {
  double coarsest = 0;
  for (const Expected& e : expected)
    if (e.settles) coarsest = std::max(coarsest, quantity_of(m, e.quantity).standard_error() / e.value);
  return coarsest;
}

// Walks for which every total's relative standard error is `target`. The pilot goes on until it knows that
// error to a few per cent.
std::uint64_t walks_for(MeasureJob job, const std::vector<Expected>& expected, double target) {
  const std::atomic<bool> stop{false};
  double needed = kPilot;
  for (job.walks = kPilot;; job.walks *= 4) {
    const Measurement pilot = measure(job, stop);
    const double coarsest = coarsest_total(pilot, expected);
    needed = 1.15 * static_cast<double>(job.walks) * (coarsest / target) * (coarsest / target);
    if (coarsest < 0.03 || static_cast<double>(job.walks) > needed) break;
  }
  return static_cast<std::uint64_t>(std::max(needed, static_cast<double>(kPilot)));
}

// Rows and walks share no random numbers, pilots neither: all scores are independent.
std::vector<Score> run_case(ReferenceCase c, std::size_t index, WalkCode walk, const Options& options) {
  const std::atomic<bool> stop{false};
  if (walk == WalkCode::scalar) index += kMostRows;
  c.job.threads = options.threads;
  c.job.seed = 2 * index + 1;
  c.job.walks = walks_for(c.job, c.expected, options.target(walk));
  c.job.walk = walk;
  c.job.seed = 2 * index;
  Measurement m = measure(c.job, stop);
  // Where the pilot was too hopeful the same walks go on.
  while (coarsest_total(m, c.expected) > options.target(walk)) {
    c.job.walks += c.job.walks / 4;
    m = measure(c.job, stop);
  }
  std::vector<Score> scores;
  for (const Expected& e : c.expected) {
    const Moments& q = quantity_of(m, e.quantity);
    const double walks = static_cast<double>(m.walks);
    if (!e.settles && e.value * walks < 200) continue;
    // What does not vary (nothing but a specular sum) must be right to single precision, and has no z^2.
    const double error = std::max(q.standard_error(), 1e-6 * e.value);
    const bool counts = &e == &c.expected[0] && error == q.standard_error();
    scores.push_back({c.name, name_of(walk), e.quantity, e.value, q.mean, error, (q.mean - e.value) / error,
                      walks, counts, e.settles});
  }
  return scores;
}

void write(std::ofstream& file, const Score& s) {
  char line[400];
  std::snprintf(line, sizeof line, "%s,%s,%s,%.12g,%.9g,%.3g,%.3g,%.3f,%.0f,%d,%d\n", s.name.c_str(),
                s.walk.c_str(), s.quantity.c_str(), s.exact, s.measured, s.error, s.error / s.exact, s.z,
                s.walks, s.first, s.settles);
  file << line << std::flush;
}

std::vector<Score> read_scores() {
  std::vector<Score> scores;
  const CsvTable t = read_csv(kPart);
  for (std::size_t i = 0; i < t.rows.size(); ++i)
    scores.push_back({t.text(i, "row"), t.text(i, "walk"), t.text(i, "quantity"), t.number(i, "exact"),
                      t.number(i, "measured"), t.number(i, "standard_error"), t.number(i, "z"),
                      t.number(i, "walks"), t.number(i, "first") != 0, t.number(i, "total") != 0});
  return scores;
}

// The verdict on one family; true when it passes.
bool judge(const char* family, const std::vector<Score>& scores, double target) {
  double worst = 0;
  double squares = 0;
  int runs = 0;
  int coarse = 0;
  for (const Score& s : scores) {
    worst = std::max(worst, std::abs(s.z));
    if (s.first) squares += s.z * s.z, ++runs;
    coarse += s.settles && s.error / s.exact > target;
    if (std::abs(s.z) > 3.5) std::printf("%s %s: z %.2f\n", s.name.c_str(), s.quantity.c_str(), s.z);
  }
  const double bound = two_sided_threshold(sidak_level(1e-3, scores.size()));
  const double width = 4 * std::sqrt(2.0 / runs);
  // The width is that of a normal law, which the mean of a few squares does not follow.
  const bool passed = worst < bound && (runs < kFewRuns || std::abs(squares / runs - 1) < width);
  std::printf(
      "%s: %zu values of %d runs: largest |z| %.2f (bound %.2f), mean of z^2 %.3f (1 +- %.3f), %d totals "
      "short of %.1f %%: %s\n",
      family, scores.size(), runs, worst, bound, squares / runs, width, coarse, 100 * target,
      passed ? "passed" : "FAILED");
  return passed;
}

// What both walks scored, as batch less scalar. A score that only one of them has (few unscattered walks in
// the other) is left out.
std::vector<Score> differences(const std::vector<Score>& batch, const std::vector<Score>& scalar) {
  std::vector<Score> scores;
  for (const Score& b : batch) {
    const auto s = std::find_if(scalar.begin(), scalar.end(), [&](const Score& other) {
      return other.name == b.name && other.quantity == b.quantity;
    });
    if (s == scalar.end()) continue;
    Score d = b;
    d.error = std::hypot(b.error, s->error);
    d.z = (b.measured - s->measured) / d.error;
    d.first = b.first && s->first;
    d.settles = false;
    scores.push_back(d);
  }
  return scores;
}

bool report(const std::vector<Score>& scores, const Options& options) {
  std::vector<Score> batch;
  std::vector<Score> scalar;
  for (const Score& s : scores) (s.walk == "batch" ? batch : scalar).push_back(s);
  const bool exact = judge("lanes", batch, options.target(WalkCode::batch));
  const bool oracle = judge("scalar walks", scalar, options.target(WalkCode::scalar));
  return judge("lanes less scalar walks", differences(batch, scalar), options.target(WalkCode::scalar)) &&
         exact && oracle;
}

bool run(const Options& options) {
  const std::vector<ReferenceCase> cases = reference_cases();
  std::vector<Score> scores;
  if (options.resume) scores = read_scores();
  const bool keep = options.all && options.rows.empty();
  std::ofstream file;
  if (keep) file.open(kPart, options.resume ? std::ios::app : std::ios::trunc);
  if (keep && !file) throw std::runtime_error("cannot write " + kPart);
  if (keep && !options.resume)
    file << "row,walk,quantity,exact,measured,standard_error,relative_standard_error,z,walks,first,total\n";
  const Timer timer;
  const auto is_done = [&](const std::string& name, WalkCode walk) {
    return std::any_of(scores.begin(), scores.end(),
                       [&](const Score& s) { return s.name == name && s.walk == name_of(walk); });
  };
  for (std::size_t i = 0; i < cases.size(); i += options.is_spread() ? 7 : 1) {
    const std::string& name = cases[i].name;
    if (name.find(options.rows) == std::string::npos) continue;
    for (const WalkCode walk : kWalks) {
      if (is_done(name, walk)) continue;
      for (const Score& s : run_case(cases[i], i, walk, options)) {
        if (keep) write(file, s);
        if (!options.is_spread())
          std::printf("%zu/%zu %s %s %s: z %.2f, %.0f walks, %.1f s\n", i + 1, cases.size(), name.c_str(),
                      s.walk.c_str(), s.quantity.c_str(), s.z, s.walks, timer.seconds());
        scores.push_back(s);
      }
    }
    std::fflush(stdout);
  }
  if (scores.empty()) throw std::runtime_error("no row is called " + options.rows);
  if (keep) {
    file.close();
    if (!file) throw std::runtime_error("cannot write " + kPart);
    std::filesystem::rename(kPart, kFile);
  }
  return report(scores, options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv)) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "reference_rows: %s\n", error.what());
    return 2;
  }
}
