// The verb measure.
#include <array>
#include <cmath>
#include <iostream>
#include <memory>

#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/measure_report.h"
#include "app/render_options.h"
#include "core/error.h"
#include "render/parallel.h"

namespace meander {
namespace {

// As typed; ranges are still text.
struct MeasureOptions {
  std::string shape;
  std::string albedo;
  std::string g = "0";
  std::string tau;
  std::string tau_radius;
  std::optional<double> sigma_a;
  std::optional<double> sigma_s;
  std::optional<double> thickness;
  std::optional<double> color;
  std::string inversion;  // empty: exact
  std::string boundary = "matched";
  std::optional<double> ior;
  double roughness = 0;
  BinOptions bins;
  std::optional<double> radius;
  std::optional<double> max_depth;
  std::optional<double> max_path;
  std::string incidence;  // empty: normal, or diffuse for a colour, which is defined so
  std::string estimator = "implicit";
  std::uint64_t walks = 1'000'000;
  std::uint64_t seed = 0;
  int threads = 0;
  std::string walk = "batch";
  std::string isa;
  bool json = false;
  bool csv = false;
};

[[noreturn]] void refuse(const std::string& message) { throw Error(Fault::input, "measure: " + message); }

double parse_number(const std::string& option, const std::string& text) {
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
    refuse(option + " is '" + text + "', but must be a number, or a range FIRST:LAST:COUNT");
  return value;
}

// One number, or FIRST:LAST:COUNT evenly spaced.
std::vector<double> parse_range(const std::string& option, const std::string& text) {
  const auto parts = CLI::detail::split(text, ':');
  if (parts.size() == 1) return {parse_number(option, text)};
  if (parts.size() != 3)
    refuse(option + " is '" + text + "', but must be a number, or a range FIRST:LAST:COUNT");
  const double first = parse_number(option, parts[0]);
  const double last = parse_number(option, parts[1]);
  const double count = parse_number(option, parts[2]);
  if (count < 2 || count > 10000 || count != std::floor(count))
    refuse(option + ": a range has 2 to 10000 values, not " + parts[2]);
  std::vector<double> values;
  for (int i = 0; i < static_cast<int>(count); ++i)
    values.push_back(first + (last - first) * i / (count - 1));
  return values;
}

void require_in(const std::string& option, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream text;
  text << option << " is " << value << ", but must be in [" << low << ", " << high << "]";
  refuse(text.str());
}

Incidence parse_incidence(const std::string& text) {
  if (text.empty()) return {false, 1};
  if (text == "normal") return {false, 1};
  if (text == "diffuse") return {true, 1};
  const std::string prefix = "cosine=";
  double cosine = 0;
  if (text.starts_with(prefix) && CLI::detail::lexical_cast(text.substr(prefix.size()), cosine) &&
      cosine > 0 && cosine <= 1)
    return {false, cosine};
  refuse("--incidence is '" + text + "', but must be normal, diffuse, or cosine=MU with MU in (0, 1]");
}

Boundary boundary_of(const MeasureOptions& o) {
  if (o.boundary == "matched" && o.ior.value_or(1) != 1)
    refuse("--ior other than 1 needs --boundary dielectric or diffuse");
  if (o.boundary == "dielectric" && !o.ior) refuse("--boundary dielectric needs --ior, such as --ior 1.5");
  if (o.roughness > 0 && o.boundary != "dielectric") refuse("--roughness needs --boundary dielectric");
  return o.boundary == "matched"   ? Boundary::matched
         : o.boundary == "diffuse" ? Boundary::diffuse
                                   : Boundary::dielectric;
}

// The albedos asked for, whichever way they were given.
std::vector<double> albedos_of(const MeasureOptions& o, double g) {
  const int given =
      !o.albedo.empty() + (o.sigma_a.has_value() || o.sigma_s.has_value()) + o.color.has_value();
  if (given > 1)
    refuse("give the medium by --albedo, by --sigma-s with --sigma-a, or by --color, not by two of them");
  if (!o.inversion.empty() && !o.color) refuse("--inversion is that of --color A");
  if (o.color) {
    require_in("--color", *o.color, 0, 1);
    const Inversion inversion = o.inversion == "chiang"         ? Inversion::chiang
                                : o.inversion == "van_de_hulst" ? Inversion::van_de_hulst
                                                                : Inversion::exact;
    return {double{medium_from_color(DVec3(*o.color), DVec3(1), g, inversion,
                                     {boundary_of(o), o.ior.value_or(1), o.roughness})
                       .albedo.x}};
  }
  if (o.sigma_a || o.sigma_s) {
    const double sigma_t = o.sigma_a.value_or(0) + o.sigma_s.value_or(0);
    if (!(sigma_t > 0)) refuse("--sigma-a and --sigma-s must not both be 0");
    return {o.sigma_s.value_or(0) / sigma_t};
  }
  return parse_range("--albedo", o.albedo.empty() ? "0.9" : o.albedo);
}

// Mean free paths in the unit that lengths are asked for in: a mm where coefficients are given per mm.
double per_length(const MeasureOptions& o) {
  return o.sigma_a || o.sigma_s ? o.sigma_a.value_or(0) + o.sigma_s.value_or(0) : 1;
}

// The bins' ranges in mean free paths.
BinOptions bins_of(const MeasureOptions& o, const decltype(MeasureJob::shape)& shape) {
  const double scale = per_length(o);
  BinOptions bins = o.bins;
  const bool sphere = std::holds_alternative<MeasuredSphere>(shape);
  if (sphere && (bins.radial > 0 || bins.depth > 0))
    refuse("--radial-bins and --depth-bins are for the slab and the half-space");
  if (bins.radial > 0 && !o.incidence.empty() && o.incidence != "normal")
    refuse("--radial-bins need a pencil beam: --incidence normal");
  if (o.radius && bins.radial == 0) refuse("--radius is the range of --radial-bins N");
  if (o.max_depth && bins.depth == 0) refuse("--depth is the range of --depth-bins N");
  if (o.max_path && bins.path == 0) refuse("--path is the range of --path-bins N");
  if (o.radius) bins.radius = *o.radius * scale;
  if (const auto* slab = std::get_if<MeasuredSlab>(&shape)) bins.max_depth = slab->tau;
  if (o.max_depth) bins.max_depth = *o.max_depth * scale;
  if (o.max_path) bins.max_path = *o.max_path * scale;
  return bins;
}

// In single precision a thicker slab would lose the digits of its faces.
constexpr double kThickest = 1e6;

using Shape = decltype(MeasureJob::shape);

std::vector<Shape> shapes_of(const MeasureOptions& o) {
  if (o.shape != "slab" && (!o.tau.empty() || o.thickness)) refuse("--tau and --thickness are for the slab");
  if (o.shape != "sphere" && !o.tau_radius.empty()) refuse("--tau-radius is for the sphere");
  if (o.shape == "halfspace") return {MeasuredHalfSpace{}};
  std::vector<Shape> shapes;
  if (o.shape == "sphere") {
    for (const double tau : parse_range("--tau-radius", o.tau_radius.empty() ? "1" : o.tau_radius)) {
      if (!(tau > 0 && tau <= 1e5)) refuse("--tau-radius must be greater than 0 and at most 1e5");
      shapes.emplace_back(MeasuredSphere{tau});
    }
    return shapes;
  }
  if (o.thickness) {
    if (!o.tau.empty()) refuse("give the slab by --tau or by --thickness, not by both");
    if (!o.sigma_a && !o.sigma_s) refuse("--thickness needs --sigma-a and --sigma-s");
    const double tau = *o.thickness * per_length(o);
    if (!(tau <= kThickest)) refuse("--thickness times the extinction must be at most 1e6");
    return {MeasuredSlab{tau}};
  }
  if (o.tau.empty() && (o.sigma_a || o.sigma_s))
    refuse("a slab in mm needs --thickness, such as --thickness 2");
  for (const double tau : parse_range("--tau", o.tau.empty() ? "1" : o.tau)) {
    if (!(tau > 0 && tau <= kThickest)) refuse("--tau must be greater than 0 and at most 1e6");
    shapes.emplace_back(MeasuredSlab{tau});
  }
  return shapes;
}

// Every combination of the ranges.
std::vector<MeasureJob> jobs_of(const MeasureOptions& o) {
  MeasureJob job;
  job.boundary = boundary_of(o);
  job.ior = o.ior.value_or(1);
  job.roughness = o.roughness;
  job.incidence = parse_incidence(o.incidence.empty() && o.color ? "diffuse" : o.incidence);
  job.estimator = o.estimator == "analog" ? Estimator::analog : Estimator::implicit;
  job.walk = walk_code(o.walk);
  job.instruction_set = instruction_set_of(o.isa);
  job.walks = o.walks;
  job.seed = o.seed;
  job.threads = o.threads > 0 ? o.threads : hardware_threads();
  std::vector<MeasureJob> jobs;
  for (const Shape& shape : shapes_of(o)) {
    job.bins = bins_of(o, shape);
    for (const double g : parse_range("--g", o.g)) {
      if (!(std::abs(g) < 1)) refuse("--g must be greater than -1 and less than 1");
      for (const double albedo : albedos_of(o, g)) {
        require_in("--albedo", albedo, 0, 1);
        if (std::holds_alternative<MeasuredHalfSpace>(shape) && albedo > 1 - 1e-6)
          refuse(std::string(o.color ? "--color is too near 1: " : "") +
                 "the mean path in a half-space is not finite for an albedo above 1 - 1e-6");
        job.shape = shape;
        job.g = g;
        job.albedo = albedo;
        jobs.push_back(job);
      }
    }
  }
  return jobs;
}

// The colour that the measurement can be held to: colour is defined for a half-space in uniform light.
std::optional<double> asked_color(const MeasureOptions& o, const MeasureJob& job) {
  const bool defined = std::holds_alternative<MeasuredHalfSpace>(job.shape) && job.incidence.diffuse;
  return defined ? o.color : std::nullopt;
}

int run_measure(const MeasureOptions& options) {
  const std::vector<MeasureJob> jobs = jobs_of(options);
  const BinOptions& asked = options.bins;
  if (options.json && options.csv) refuse("give --json or --csv, not both");
  if (jobs.size() > 1 && !options.json && asked.angular + asked.radial + asked.depth + asked.path > 0)
    refuse("bins of a range of media need --json");
  const std::atomic<bool>& stop = watch_interrupts();
  std::vector<MeasuredCase> cases;
  for (const MeasureJob& job : jobs) {
    cases.push_back({job, measure(job, stop), per_length(options), asked_color(options, job)});
    if (stop) std::cerr << "meander: interrupted after " << cases.back().result.walks << " walks\n";
    if (stop && cases.back().result.walks == 0) cases.pop_back();
    if (stop) break;
  }
  if (cases.empty()) throw Error(Fault::runtime, "interrupted before any walks were complete");
  if (options.json) {
    std::cout << measurement_json(cases, jobs.size() > 1);
  } else if (jobs.size() > 1) {
    std::cout << measurement_csv(cases);
  } else {
    const std::string bins = bins_csv(cases.front());
    if (!options.csv) std::cout << measurement_text(cases.front()) << (bins.empty() ? "" : "\n") << bins;
    if (options.csv) std::cout << (bins.empty() ? measurement_csv(cases) : bins);
  }
  return 0;
}

void add_bin_options(CLI::App& verb, MeasureOptions& o) {
  const auto count = whole_number(1, 100000);
  verb.add_option("--angular-bins", o.bins.angular, "resolve the exitant radiance over the cosine")
      ->transform(count);
  verb.add_option("--radial-bins", o.bins.radial, "resolve over the distance from a pencil beam")
      ->transform(count);
  verb.add_option("--radius", o.radius, "range of the radial bins (10 mean free paths; mm with --sigma-*)")
      ->check(greater_than(0));
  verb.add_option("--depth-bins", o.bins.depth, "resolve absorption and fluence over depth")
      ->transform(count);
  verb.add_option("--depth", o.max_depth,
                  "range of the depth bins (the slab; 10 mean free paths; mm with --sigma-*)")
      ->check(greater_than(0));
  verb.add_option("--path-bins", o.bins.path, "resolve over the path length inside")->transform(count);
  verb.add_option("--path", o.max_path, "range of the path bins (50 mean free paths; mm with --sigma-*)")
      ->check(greater_than(0));
}

}  // namespace

void add_measure_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "measure", "reflectance, transmittance and absorption of an exact shape, with standard errors");
  const auto o = std::make_shared<MeasureOptions>();
  verb->add_option("SHAPE", o->shape, "slab, halfspace or sphere")
      ->required()
      ->check(CLI::IsMember({"slab", "halfspace", "sphere"}));
  verb->add_option("--albedo", o->albedo, "single-scattering albedo (0.9), or a range FIRST:LAST:COUNT");
  verb->add_option("--g", o->g, "Henyey-Greenstein mean cosine (0), or a range");
  verb->add_option("--tau", o->tau, "slab: optical thickness (1), or a range");
  verb->add_option("--tau-radius", o->tau_radius, "sphere: optical radius (1), or a range");
  verb->add_option("--sigma-a,--mu-a", o->sigma_a, "absorption coefficient, per mm")->check(at_least(0));
  verb->add_option("--sigma-s,--mu-s", o->sigma_s, "scattering coefficient, per mm")->check(at_least(0));
  verb->add_option("--thickness", o->thickness, "slab: thickness, mm")->check(greater_than(0));
  verb->add_option("--color", o->color, "surface colour instead of an albedo")->check(finite_number());
  verb->add_option("--inversion", o->inversion, "of the colour: exact, chiang or van_de_hulst (exact)")
      ->check(CLI::IsMember({"exact", "chiang", "van_de_hulst"}));
  verb->add_option("--boundary", o->boundary, "matched, dielectric or diffuse (matched)")
      ->check(CLI::IsMember({"matched", "dielectric", "diffuse"}));
  verb->add_option("--ior", o->ior, "index inside over outside, 1 to 4 (1; a dielectric needs it)")
      ->check(number_between(1, 4));
  verb->add_option("--roughness", o->roughness, "of a dielectric boundary, 0 to 1 (0: smooth)")
      ->check(number_between(0, 1));
  add_bin_options(*verb, *o);
  verb->add_option("--incidence", o->incidence,
                   "normal, cosine=MU or diffuse (normal; diffuse with --color)");
  verb->add_option("--estimator", o->estimator, "analog or implicit (implicit)")
      ->check(CLI::IsMember({"analog", "implicit"}));
  verb->add_option("--walks", o->walks, "number of walks (10^6)")
      ->transform(whole_number(1, std::uint64_t{1} << 50));
  verb->add_option("--seed", o->seed, "random seed (0)")->transform(seed_number());
  verb->add_option("--threads", o->threads, "threads (all)")->transform(thread_count());
  add_walk_options(*verb, o->walk, o->isa);
  verb->add_flag("--json", o->json, "print JSON");
  verb->add_flag("--csv", o->csv, "print CSV: the bins where there are any");
  verb->callback([o, &action] { action = [o] { return run_measure(*o); }; });
}

}  // namespace meander
