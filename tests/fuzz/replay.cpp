// Reads every file of the corpora as the fuzzers do, in an ordinary build: replay FOLDER.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets.h"

namespace {

namespace fs = std::filesystem;

constexpr double kMostSeconds = 1;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// False where something that must hold does not.
bool replay(meander::FuzzTarget target, const meander::FuzzFolder& folder, const fs::path& path) {
  const double before = meander::processor_seconds();
  try {
    const std::string outcome = meander::try_input(target, folder, bytes_of(path));
    const double seconds = meander::processor_seconds() - before;
    std::printf("%s: %.3f s: %s\n", path.c_str(), seconds, outcome.c_str());
    return seconds < kMostSeconds;
  } catch (const std::exception& error) {
    std::printf("%s: FINDING: %s\n", path.c_str(), error.what());
    return false;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: replay FOLDER\n");
    return 2;
  }
  const meander::FuzzFolder folder;
  bool sound = true;
  for (const std::string_view name : meander::kFuzzTargetNames) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(argv[1]) / name)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty()) {
      std::printf("no inputs for %s\n", std::string(name).c_str());
      sound = false;
    }
    for (const fs::path& path : files)
      sound = replay(*meander::fuzz_target_of(name), folder, path) && sound;
  }
  return sound ? 0 : 1;
}
