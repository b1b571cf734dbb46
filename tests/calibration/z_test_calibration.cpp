// Whether the z-test calls sound images broken, and broken ones sound: small renders of many seeds against a
// long one of another, for scenes whose samples are skewed.
//
//   z_test_calibration                     the table: minutes
//   z_test_calibration --table FILE        writes it there too
//   z_test_calibration --scene NAME        the rows of one scene
//   z_test_calibration --seeds N           so many seeds a row instead of 120
//
// The false alarms of a row stay within what a binomial of level 0.01 exceeds in one case of 100; those of
// all rows together as well. The noise of the jade and of the caustics is doubted in every render, that of
// the default scene in none. Lights 3 % brighter, which scale an image and its noise, fail by the whole
// image; one block of the object that is 10 or 20 % brighter fails by its blocks where samples are many.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "film/film.h"
#include "io/scene_file.h"
#include "render/parallel.h"
#include "render/progressive.h"
#include "stats/image_error.h"

using namespace meander;

namespace {

struct Case {
  const char* scene;
  std::uint64_t spp;
  std::uint64_t longest;  // samples a pixel of the reference
  int fewer;              // divides the number of seeds
  bool doubted;           // rare bright samples carry the noise
  double bright;          // least share of images 3 % too bright that must fail
  double tenth;           // of images with a block 10 % too bright
  double fifth;           // 20 %
};

// The blocks need the samples, the image needs few; where samples are many, a quarter of the seeds tells.
constexpr Case kCases[] = {
    {"wax_knot", 8, 2048, 1, false, 0.99, 0, 0}, {"wax_knot", 32, 2048, 1, false, 0.99, 0, 0.95},
    {"wax_knot", 256, 2048, 4, false, 1, 1, 1},  {"jade_knot", 32, 1024, 1, true, 0.99, 0, 0.9},
    {"glass_ball", 8, 4096, 1, true, 0, 0, 0},   {"glass_ball", 64, 4096, 1, true, 0.95, 0, 0},
};

constexpr double kLevel = 0.01;
constexpr int kBlock = 8;

struct Options {
  int seeds = 120;
  std::string scene;
  std::string table;
};

struct Row {
  int alarms = 0;
  int pixel_alarms = 0;
  int block_alarms = 0;
  int image_alarms = 0;
  int doubted = 0;
  int bright = 0;  // found
  int tenth = 0;
  int fifth = 0;
  double worst_block = 0;
  double worst_image = 0;
};

Job load(const std::string& scene) {
  const std::string path = std::string(MEANDER_SOURCE_DIR) + "/scenes/" + scene + ".toml";
  const std::vector<std::string> size{"film.width=160", "film.height=90"};
  Job job;
  job.threads = hardware_threads();
  job.scene = std::make_shared<const Scene>(load_scene(path, size).scene);
  job.geometry = std::make_shared<const Geometry>(*job.scene, job.threads);
  return job;
}

Image render_image(Job job, std::uint64_t seed, std::uint64_t spp) {
  const std::atomic<bool> stop{false};
  job.seed = seed;
  return resolve(render(job, {spp, {}, {}}, stop, [](const Rendering&) {}).film);
}

// The image with the pixels of a rectangle, values and noise, `factor` times as bright.
Image brighter(Image image, double factor, Tile area) {
  for (int y = area.y0; y < area.y1; ++y) {
    for (int x = area.x0; x < area.x1; ++x) {
      for (int c = 0; c < 6; ++c) image.at(x, y)[c] *= static_cast<float>(c < 3 ? factor : factor * factor);
    }
  }
  return image;
}

void keep_worst(double& worst, double z) {
  if (std::abs(z) > std::abs(worst)) worst = z;
}

void add_image(const Image& image, const Image& reference, Row& row) {
  const ZTest test = z_test(image, reference);
  row.alarms += !test.passed;
  row.pixel_alarms += !test.pixels_passed;
  row.block_alarms += !test.blocks_passed;
  row.image_alarms += !test.image_passed;
  keep_worst(row.worst_block, test.worst_block_z);
  for (const double z : test.image_z) keep_worst(row.worst_image, z);
  row.doubted += !estimate_noise(image, {}).reliable();
  row.bright += !z_test(brighter(image, 1.03, {0, 0, image.width, image.height}), reference).image_passed;
  // A block of the object, beside the middle.
  const Tile block{72, 40, 72 + kBlock, 40 + kBlock};
  row.tenth += !z_test(brighter(image, 1.1, block), reference).blocks_passed;
  row.fifth += !z_test(brighter(image, 1.2, block), reference).blocks_passed;
}

// The least count that a binomial of kLevel is above in at most one case of 100.
int binomial_bound(int n) {
  double term = std::pow(1 - kLevel, n);
  double below = term;
  int k = 0;
  for (; below < 0.99; ++k) {
    term *= (n - k) / (k + 1.0) * kLevel / (1 - kLevel);
    below += term;
  }
  return k;
}

struct Verdict {
  bool passed = true;
  void check(bool holds, const std::string& what) {
    if (!holds) std::printf("FAILED: %s\n", what.c_str());
    passed = passed && holds;
  }
};

void judge(const Case& c, const Row& row, int seeds, Verdict& verdict) {
  const std::string name = std::string(c.scene) + " at " + std::to_string(c.spp) + " samples";
  verdict.check(row.alarms <= binomial_bound(seeds), name + ": too many false alarms");
  verdict.check(row.doubted == (c.doubted ? seeds : 0), name + ": the doubt of the noise");
  verdict.check(row.bright >= c.bright * seeds, name + ": 3 % brighter passes too often");
  verdict.check(row.tenth >= c.tenth * seeds, name + ": a block 10 % brighter passes too often");
  verdict.check(row.fifth >= c.fifth * seeds, name + ": a block 20 % brighter passes too often");
}

void print(const Case& c, const Row& row, int seeds, std::ofstream& file) {
  char line[300];
  std::snprintf(line, sizeof line, "%s,%llu,%llu,%d,%d,%d,%d,%d,%.2f,%.2f,%d,%d,%d,%d", c.scene,
                static_cast<unsigned long long>(c.spp), static_cast<unsigned long long>(c.longest), seeds,
                row.alarms, row.pixel_alarms, row.block_alarms, row.image_alarms, row.worst_block,
                row.worst_image, row.doubted, row.bright, row.tenth, row.fifth);
  std::printf("%s\n", line);
  std::fflush(stdout);
  if (file.is_open()) file << line << '\n' << std::flush;
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if (arg == "--table" && i + 1 < argc)
      options.table = argv[++i];
    else if (arg == "--scene" && i + 1 < argc)
      options.scene = argv[++i];
    else if (arg == "--seeds" && i + 1 < argc)
      options.seeds = std::max(1, std::atoi(argv[++i]));
    else
      throw std::runtime_error("unknown option " + arg + " (--scene NAME, --seeds N, --table FILE)");
  }
  return options;
}

bool run(const Options& options) {
  std::ofstream file;
  if (!options.table.empty()) file.open(options.table);
  const std::string head =
      "scene,spp,reference_spp,seeds,alarms,by_values,by_blocks,by_image,worst_block_z,worst_image_z,doubted,"
      "found_3_percent,found_block_10_percent,found_block_20_percent";
  std::printf("%s\n", head.c_str());
  if (file.is_open()) file << head << '\n';
  Verdict verdict;
  int alarms = 0;
  int images = 0;
  for (const Case& c : kCases) {
    if (!options.scene.empty() && options.scene != c.scene) continue;
    const int seeds = std::max(1, options.seeds / c.fewer);
    const Job job = load(c.scene);
    const Image reference = render_image(job, 999, c.longest);
    Row row;
    for (int seed = 1; seed <= seeds; ++seed)
      add_image(render_image(job, static_cast<std::uint64_t>(seed), c.spp), reference, row);
    print(c, row, seeds, file);
    judge(c, row, seeds, verdict);
    alarms += row.alarms;
    images += seeds;
  }
  verdict.check(alarms <= binomial_bound(images), "too many false alarms in all");
  return verdict.passed;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv)) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "z_test_calibration: %s\n", error.what());
    return 2;
  }
}
