// Walks the hard cases in double precision and prints what they come to:
// tests/stability/exact/double_walks.csv.
//   double_oracle [STEPS A CASE (2e7)] [FIRST CASE LAST CASE]
#include <cstdio>
#include <cstdlib>

#include "stability/exact/exact_walk.h"

using namespace meander;

namespace {

constexpr std::uint64_t kSeed = 1'000'000;

// What is known to a tenth at least; the rest is noise.
bool is_known(const Moments& m) { return m.count > 0 && m.standard_error() <= 0.1 * std::abs(m.mean); }

void print_case(std::size_t number, const ExactCase& of, double steps) {
  const ExactResults results = walk_scalar(of, walks_within(of, steps), kSeed + number);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (is_known(results[i]))
      std::printf("%zu,%s,%s,%.10g,%.4g,%llu\n", number, describe(of).c_str(), kExactQuantities[i].data(),
                  results[i].mean, results[i].standard_error(),
                  static_cast<unsigned long long>(results[i].count));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  static_assert(sizeof(Real) == sizeof(double));
  const std::vector<ExactCase> cases = exact_cases();
  const double steps = argc > 1 ? std::atof(argv[1]) : 2e7;
  const std::size_t first = argc > 2 ? static_cast<std::size_t>(std::atol(argv[2])) : 0;
  const std::size_t last = argc > 3 ? static_cast<std::size_t>(std::atol(argv[3])) : cases.size() - 1;
  std::printf("case,shape,sigma_t,albedo,g,ior,boundary,quantity,value,standard_error,walks\n");
  for (std::size_t i = first; i <= last && i < cases.size(); ++i) print_case(i, cases[i], steps);
  return 0;
}
