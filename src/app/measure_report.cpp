#include "app/measure_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/measure_bin_table.h"

namespace meander {
namespace {

struct Quantity {
  const char* name;
  const Moments* moments;
};

// The quantities that the shape has, in the order in which they are reported.
std::vector<Quantity> quantities_of(const MeasuredCase& m) {
  const Measurement& r = m.result;
  std::vector<Quantity> quantities{{"reflectance", &r.reflectance}};
  const bool sphere = std::holds_alternative<MeasuredSphere>(m.job.shape);
  if (sphere) quantities.push_back({"escaped", &r.reflectance});
  quantities.insert(quantities.end(), {{"transmittance", &r.transmittance},
                                       {"unscattered_reflectance", &r.unscattered_reflectance},
                                       {"unscattered_transmittance", &r.unscattered_transmittance},
                                       {"specular_reflectance", &r.specular_reflectance},
                                       {"absorptance", &r.absorptance},
                                       {"mean_path_length", &r.mean_path_length}});
  return quantities;
}

double size_of(const MeasureJob& job) {
  if (const auto* slab = std::get_if<MeasuredSlab>(&job.shape)) return slab->tau;
  if (const auto* sphere = std::get_if<MeasuredSphere>(&job.shape)) return sphere->tau_radius;
  return std::numeric_limits<double>::infinity();
}

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

struct MeanPath {
  const char* quantity;
  double value;
  double standard_error;
};

// Of the light that came out, in the unit of lengths asked for; where path lengths are resolved.
std::vector<MeanPath> mean_paths(const MeasuredCase& m) {
  if (m.job.bins.path == 0) return {};
  const double unit = 1 / m.per_length;
  const RatioOfSums& reflected = m.result.resolved.mean_path_reflected;
  const RatioOfSums& transmitted = m.result.resolved.mean_path_transmitted;
  return {{"mean_path_reflected", unit * reflected.value(), unit * reflected.standard_error()},
          {"mean_path_transmitted", unit * transmitted.value(), unit * transmitted.standard_error()}};
}

void add_paths_and_bins(nlohmann::ordered_json& json, const MeasuredCase& m) {
  for (const MeanPath& path : mean_paths(m))
    json[path.quantity] = {{"value", path.value}, {"standard_error", path.standard_error}};
  for (const BinTable& table : bin_tables(m)) {
    nlohmann::ordered_json bins = nlohmann::ordered_json::array();
    for (const BinValue& bin : table.bins) {
      nlohmann::ordered_json high = std::isfinite(bin.high) ? nlohmann::ordered_json(bin.high) : nullptr;
      bins.push_back(
          {{"low", bin.low}, {"high", high}, {"value", bin.value}, {"standard_error", bin.standard_error}});
    }
    json[table.quantity] = std::move(bins);
  }
}

}  // namespace

std::string measurement_text(const MeasuredCase& measured) {
  std::string text;
  char line[160];
  for (const Quantity& q : quantities_of(measured)) {
    std::snprintf(line, sizeof line, "%-26s %.7f +- %.7f\n", q.name, q.moments->mean,
                  q.moments->standard_error());
    text += line;
  }
  const Measurement& r = measured.result;
  if (measured.color) {
    const RatioOfSums& delivered = r.from_below;
    std::snprintf(line, sizeof line, "color asked %.6f, delivered %.6f +- %.6f, difference %+.6f\n",
                  *measured.color, delivered.value(), delivered.standard_error(),
                  delivered.value() - *measured.color);
    text += line;
  }
  std::snprintf(line, sizeof line, "%llu walks, %llu steps, %.2f s\n",
                static_cast<unsigned long long>(r.walks), static_cast<unsigned long long>(r.steps),
                r.seconds);
  return text + line;
}

std::string measurement_json(const std::vector<MeasuredCase>& cases, bool list) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const MeasuredCase& measured : cases) {
    nlohmann::ordered_json one;
    if (list) {
      one["albedo"] = measured.job.albedo;
      one["g"] = measured.job.g;
      if (std::isfinite(size_of(measured.job))) one["tau"] = size_of(measured.job);
    }
    for (const Quantity& q : quantities_of(measured))
      one[q.name] = {{"value", q.moments->mean}, {"standard_error", q.moments->standard_error()}};
    if (measured.color) {
      const RatioOfSums& delivered = measured.result.from_below;
      one["color"] = {{"asked", *measured.color},
                      {"delivered", delivered.value()},
                      {"standard_error", delivered.standard_error()},
                      {"difference", delivered.value() - *measured.color}};
    }
    add_paths_and_bins(one, measured);
    one["walks"] = measured.result.walks;
    one["steps"] = measured.result.steps;
    one["seconds"] = measured.result.seconds;
    all.push_back(std::move(one));
  }
  return (list ? all : all.front()).dump(2) + "\n";
}

std::string measurement_csv(const std::vector<MeasuredCase>& cases) {
  std::ostringstream text;
  text << "albedo,g,tau";
  for (const Quantity& q : quantities_of(cases.front()))
    text << ',' << q.name << ',' << q.name << "_standard_error";
  text << ",walks,steps,seconds";
  if (cases.front().color) text << ",color_asked,color_delivered,color_standard_error,color_difference";
  text << '\n';
  for (const MeasuredCase& m : cases) {
    text << exact(m.job.albedo) << ',' << exact(m.job.g) << ',' << exact(size_of(m.job));
    for (const Quantity& q : quantities_of(m))
      text << ',' << exact(q.moments->mean) << ',' << exact(q.moments->standard_error());
    text << ',' << m.result.walks << ',' << m.result.steps << ',' << exact(m.result.seconds);
    if (m.color) {
      const RatioOfSums& delivered = m.result.from_below;
      text << ',' << exact(*m.color) << ',' << exact(delivered.value()) << ','
           << exact(delivered.standard_error()) << ',' << exact(delivered.value() - *m.color);
    }
    text << '\n';
  }
  return text.str();
}

std::string bins_csv(const MeasuredCase& measured) {
  std::ostringstream text;
  const auto tables = bin_tables(measured);
  if (tables.empty()) return {};
  text << "quantity,low,high,value,standard_error\n";
  for (const BinTable& table : tables)
    for (const BinValue& bin : table.bins)
      text << table.quantity << ',' << exact(bin.low) << ',' << exact(bin.high) << ',' << exact(bin.value)
           << ',' << exact(bin.standard_error) << '\n';
  for (const MeanPath& path : mean_paths(measured))
    text << path.quantity << ",0,inf," << exact(path.value) << ',' << exact(path.standard_error) << '\n';
  return text.str();
}

}  // namespace meander
