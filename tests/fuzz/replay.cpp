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

// False where something that must hold does not. `read` where the file was not refused.
bool replay(meander::FuzzTarget target, const meander::FuzzFolder& folder, const fs::path& path, bool& read) {
  const double before = meander::processor_seconds();
  try {
    const meander::FuzzOutcome outcome = meander::try_input(target, folder, bytes_of(path));
    const double seconds = meander::processor_seconds() - before;
    const char* slow = seconds < kMostSeconds ? "" : "FINDING: too slow: ";
    std::printf("%s: %s%.3f s: %s\n", path.c_str(), slow, seconds, outcome.words.c_str());
    read = read || outcome.read;
    return seconds < kMostSeconds;
  } catch (const std::exception& error) {
    std::printf("%s: FINDING: %s\n", path.c_str(), error.what());
    return false;
  }
}

// A target of which no input is read tests nothing.
bool replay_all(meander::FuzzTarget target, const meander::FuzzFolder& folder, const fs::path& corpus) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(corpus)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  bool sound = true;
  bool read = false;
  for (const fs::path& path : files) sound = replay(target, folder, path, read) && sound;
  if (!read) std::printf("%s: none of its inputs is read\n", corpus.c_str());
  return sound && read;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: replay FOLDER\n");
    return 2;
  }
  const meander::FuzzFolder folder;
  bool sound = true;
  for (const std::string_view name : meander::kFuzzTargetNames)
    sound = replay_all(*meander::fuzz_target_of(name), folder, fs::path(argv[1]) / name) && sound;
  return sound ? 0 : 1;
}
