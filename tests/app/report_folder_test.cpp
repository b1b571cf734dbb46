#include "app/report_folder.h"

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "io/image_file.h"
#include "report_sample.h"
#include "support/temporary_folder.h"

using namespace meander;

TEST_CASE("a report replaces the one before it, and no file of anyone else's") {
  const TemporaryFolder folder;
  Report report = prepared();
  const auto exists = [&](const char* name) { return std::filesystem::exists(folder.path() / name); };
  const auto touch = [&](const char* name) { std::ofstream(folder.path() / name) << "mine"; };
  make_runs(report, {{2, {}, {}}, {kReportMethods[0], kReportMethods[2]}, {1, 2}, true}, kNever);
  write_report(report, folder.path().string());
  add_report_plot(report, Image8(2, 2), folder.path().string());
  for (const char* name : {"index.html", "report.json", "report.csv", "report.png", "reference.exr",
                           "implicit-1t.exr", "implicit-2t.exr", "analog-1t.exr", "analog-2t.exr"})
    CHECK(exists(name));
  touch("analog-3t.exr");
  touch("notes.txt");
  report.runs.resize(1);
  write_report(report, folder.path().string());
  for (const char* name :
       {"implicit-1t.exr", "implicit-2t.exr", "analog-1t.exr", "analog-2t.exr", "report.png"})
    CHECK_FALSE(exists(name));
  for (const char* name : {"implicit.exr", "index.html", "analog-3t.exr", "notes.txt"}) CHECK(exists(name));
}

TEST_CASE("what an earlier report.json names elsewhere is left alone") {
  const TemporaryFolder folder;
  Report report = prepared();
  make_runs(report, plan_to({1, {}, {}}), kNever);
  std::filesystem::create_directory(folder.path() / "in");
  std::ofstream(folder.path() / "other.exr") << "mine";
  std::ofstream(folder.path() / "in" / "my.exr") << "mine";
  std::ofstream(folder.path() / "in" / "report.json")
      << R"({"runs": [{"name": "../other"}, {"name": "my"}, {"name": 3}, 4]})";
  write_report(report, (folder.path() / "in").string());
  CHECK(std::filesystem::exists(folder.path() / "other.exr"));
  CHECK(std::filesystem::exists(folder.path() / "in" / "my.exr"));
}

TEST_CASE("a report that cannot be written fails at run time, and leaves no page of it") {
  const TemporaryFolder folder;
  Report report = prepared();
  make_runs(report, plan_to({1, {}, {}}), kNever);
  write_report(report, folder.path().string());
  std::filesystem::remove(folder.path() / "reference.exr");
  std::filesystem::create_directories(folder.path() / "reference.exr" / "full");
  try {
    write_report(report, folder.path().string());
    FAIL("it was written");
  } catch (const Error& error) {
    CHECK(error.exit_code() == 3);
    CHECK(std::string(error.what()).find("reference.exr") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(folder.path() / "index.html"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "report.json"));
}

TEST_CASE("a folder is tried before the work, and left as it was") {
  const TemporaryFolder folder;
  const auto names = report_file_names(std::array{ReportMethod{}}, std::array{1, 2});
  CHECK(names.size() == 5 + 3);
  check_folder((folder.path() / "deep" / "one").string(), names);
  CHECK(std::filesystem::is_empty(folder.path()));
  std::filesystem::create_directories(folder.path() / "two" / "implicit-2t.exr");
  CHECK_THROWS_AS(check_folder((folder.path() / "two").string(), names), Error);
  check_folder((folder.path() / "two").string(), report_file_names(std::array{kReportMethods[2]}, {}));
  std::filesystem::create_symlink("nowhere", folder.path() / "link");
  CHECK_THROWS_AS(check_folder((folder.path() / "link").string(), names), Error);
  CHECK(std::filesystem::is_symlink(folder.path() / "link"));
}

TEST_CASE("a reference that is given keeps what its file says of it") {
  const TemporaryFolder folder;
  Report report = prepared();
  const std::string written = (folder.path() / "one").string();
  make_runs(report, plan_to({1, {}, {}}), kNever);
  write_report(report, written);
  for (const char* again : {"two", "three"}) {
    const std::string path = (folder.path() / "one" / "reference.exr").string();
    report.reference = read_reference(path, report.job, {1, {}, {}}, report.mask);
    CHECK(report.reference.spp == 32);
    REQUIRE(report.reference.noise);
    CHECK(report.reference.noise->noise ==
          doctest::Approx(estimate_noise(report.reference.image, report.mask).noise));
    write_report(report, (folder.path() / again).string());
    const LoadedImage image = read_image((folder.path() / again / "reference.exr").string());
    CHECK(find_integer(image.attributes, "meander/spp") == 32);
    CHECK(find_integer(image.attributes, "meander/seed") == 1);
    CHECK(find_integer(image.attributes, "meander/first_sample") == 0);
    Job same = report.job;
    same.seed = 1;
    CHECK_THROWS_AS((void)read_reference((folder.path() / again / "reference.exr").string(), same,
                                         {1, {}, {}}, report.mask),
                    Error);
  }
}

TEST_CASE("rare bright samples of a reference that is given are seen") {
  const TemporaryFolder folder;
  Report report = prepared();
  const std::string path = (folder.path() / "given.exr").string();
  const auto write = [&] {
    write_exr(path, report.reference.image,
              std::array<std::string, 6>{"R", "G", "B", "variance.R", "variance.G", "variance.B"}, {});
  };
  write();
  CHECK(read_reference(path, report.job, {1, {}, {}}, report.mask).doubt == NoiseDoubt::none);
  // A pixel that one bright sample carries.
  float* pixel = report.reference.image.at(2, 2);
  for (int c = 0; c < 3; ++c) {
    pixel[c] = 1000;
    pixel[c + 3] = 1e6f;
  }
  write();
  CHECK(read_reference(path, report.job, {1, {}, {}}, report.mask).doubt == NoiseDoubt::rare_bright_samples);
  pixel[3] = -1;
  write();
  CHECK_THROWS_WITH_AS((void)read_reference(path, report.job, {1, {}, {}}, report.mask),
                       doctest::Contains("none may be below 0"), Error);
}
