// How a measurement is printed: plain lines, JSON, or rows of CSV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/measure.h"

namespace meander {

struct MeasuredCase {
  MeasureJob job;
  Measurement result;
  double per_length = 1;        // mean free paths in the unit of lengths asked for: sigma_t per mm, or 1
  std::optional<double> color;  // asked for, where the measurement delivers one
};

[[nodiscard]] std::string measurement_text(const MeasuredCase& measured);

/// An object, or a list of objects where a range was given.
[[nodiscard]] std::string measurement_json(const std::vector<MeasuredCase>& cases, bool list);

/// A header and one row a case; each quantity is followed by its standard error. The colour comes last, where
/// one was asked for.
[[nodiscard]] std::string measurement_csv(const std::vector<MeasuredCase>& cases);

/// One row a bin: quantity, range of the bin, value, standard error. Exitant radiance per unit incident
/// irradiance over the cosine; reflectance and transmittance per area over the radius; absorbed fraction and
/// fluence over the depth; fraction of the light over the path length, and its mean path, from 0 to infinity.
/// The bin that ends at infinity holds the rest, as a fraction. Empty when no bins were asked for.
[[nodiscard]] std::string bins_csv(const MeasuredCase& measured);

}  // namespace meander
