#include "app/measure_bin_table.h"

#include <functional>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace meander {
namespace {

// What divides the flux of a bin [low, high): 1 for fractions, a solid angle or an area for densities.
using Measure = std::function<double(double low, double high)>;

double fraction(double, double) { return 1; }
double ring(double low, double high) { return glm::pi<double>() * (high - low) * (high + low); }
double width(double low, double high) { return high - low; }

struct Row {
  const char* quantity;
  const BinRow* row;
  double range;       // in the unit of the table
  bool has_overflow;  // the last bin holds the rest
  Measure measure;
  double factor = 1;  // turns the row's mean into the unit of the table
};

BinTable make_table(const Row& row, std::uint64_t walks) {
  BinTable table{row.quantity, {}};
  const int count = row.row->size() - (row.has_overflow ? 1 : 0);
  for (int i = 0; i < row.row->size(); ++i) {
    const bool rest = i == count;
    const double low = row.range * i / count;
    const double high = rest ? std::numeric_limits<double>::infinity() : row.range * (i + 1) / count;
    const double scale = rest ? row.factor : row.factor / row.measure(low, high);
    table.bins.push_back(
        {low, high, scale * row.row->mean(i, walks), scale * row.row->standard_error(i, walks)});
  }
  return table;
}

}  // namespace

std::vector<BinTable> bin_tables(const MeasuredCase& m) {
  const ResolvedBins& r = m.result.resolved;
  const BinOptions& o = m.job.bins;
  const double unit = 1 / m.per_length;  // a mean free path in the unit of the table
  const std::vector<Row> rows{
      {"reflected_radiance", &r.reflected_angle, 1, false, ring},
      {"transmitted_radiance", &r.transmitted_angle, 1, false, ring},
      {"reflectance_over_radius", &r.reflected_radius, o.radius * unit, true, ring},
      {"transmittance_over_radius", &r.transmitted_radius, o.radius * unit, true, ring},
      {"absorbed_over_depth", &r.absorbed_depth, o.max_depth * unit, true, fraction},
      {"fluence_over_depth", &r.fluence, o.max_depth * unit, true, width, unit},
      {"reflectance_over_path", &r.reflected_path, o.max_path * unit, true, fraction},
      {"transmittance_over_path", &r.transmitted_path, o.max_path * unit, true, fraction}};
  std::vector<BinTable> tables;
  for (const Row& row : rows)
    if (!row.row->empty()) tables.push_back(make_table(row, m.result.walks));
  return tables;
}

}  // namespace meander
