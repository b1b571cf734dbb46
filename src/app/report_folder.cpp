#include "app/report_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/report_files.h"
#include "app/report_page.h"
#include "app/run_stats.h"
#include "core/error.h"
#include "io/image_file.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTable = "report.csv";
constexpr const char* kData = "report.json";
constexpr const char* kPlot = "report.png";
constexpr const char* kPage = "index.html";
constexpr const char* kReference = "reference.exr";

std::string path_in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

Error cannot_write_into(const std::string& folder, const std::string& reason) {
  return Error(Fault::input, "cannot write a report into " + folder + ": " + reason);
}

// Makes a folder, and takes away again what it made.
class TrialFolder {
 public:
  explicit TrialFolder(const std::string& folder) {
    std::error_code error;
    fs::path path = fs::absolute(folder, error).lexically_normal();
    for (; !fs::exists(fs::symlink_status(path, error)) && path.has_relative_path();
         path = path.parent_path())
      if (path.has_filename()) made_.push_back(path);
    if (!fs::is_directory(path, error)) throw cannot_write_into(folder, path.string() + " is not a folder");
    fs::create_directories(folder, error);
    if (!error) return;
    remove();
    throw cannot_write_into(folder, "the folder cannot be made: " + error.message());
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  ~TrialFolder() { remove(); }

 private:
  void remove() const noexcept {
    std::error_code ignored;
    for (const fs::path& path : made_) fs::remove(path, ignored);
  }
  std::vector<fs::path> made_;  // the innermost first
};

// Whether a report may have given an image that name: a method's, with or without a number of threads.
bool is_run_name(const std::string& name) {
  for (const ReportMethod& method : kReportMethods) {
    const std::string plain(method_name(method));
    if (name == plain) return true;
    if (!name.starts_with(plain + "-") || !name.ends_with("t")) continue;
    const std::string number = name.substr(plain.size() + 1, name.size() - plain.size() - 2);
    if (!number.empty() && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; }))
      return true;
  }
  return false;
}

// The files of an earlier report that a new one might not replace; none where nothing tells of one.
std::vector<std::string> earlier_files(const std::string& folder) {
  std::ifstream in(path_in(folder, kData));
  const auto data = nlohmann::json::parse(in, nullptr, false);
  if (!data.is_object() || !data.contains("runs") || !data["runs"].is_array()) return {};
  std::vector<std::string> names{kPlot};
  for (const auto& run : data["runs"]) {
    if (!run.is_object() || !run.contains("name") || !run["name"].is_string()) continue;
    const auto name = run["name"].get<std::string>();
    if (is_run_name(name)) names.push_back(name + ".exr");
  }
  return names;
}

// A folder without report.json and index.html holds no report, or one that is not complete.
void remove_earlier(const std::string& folder) {
  std::vector<std::string> names = earlier_files(folder);
  names.insert(names.end(), {kData, kPage});
  for (const std::string& name : names) {
    std::error_code error;
    fs::remove(path_in(folder, name), error);
    if (error) throw cannot_write_into(folder, name + ": " + error.message());
  }
}

void write_text(const std::string& path, const std::string& text) {
  write_file(path, std::as_bytes(std::span(text)));
}

void write_linear(const std::string& path, const Image& image, const ImageAttributes& attributes,
                  const Job& job) {
  const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  const Tile area = area_of(job);
  const FilmSize& film = job.scene->film;
  write_exr(path, image, std::span(channels).first(static_cast<std::size_t>(image.channels)), attributes,
            {area.x0, area.y0, film.width, film.height});
}

void write_all(const Report& report, const std::string& folder) {
  const std::string page = report_page(report, std::nullopt);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw cannot_write_into(folder, "the folder cannot be made: " + failed.message());
  remove_earlier(folder);
  write_text(path_in(folder, kTable), report_csv(report));
  write_linear(path_in(folder, kReference), report.reference.image, report.reference.attributes, report.job);
  for (const ReportRun& run : report.runs)
    write_linear(path_in(folder, run_name(report, run) + ".exr"), run.image,
                 image_attributes(report.job, run.last), report.job);
  write_text(path_in(folder, kData), report_json(report));
  write_text(path_in(folder, kPage), page);
}

}  // namespace

std::vector<std::string> report_file_names(std::span<const ReportMethod> methods,
                                           std::span<const int> threads) {
  std::vector<std::string> names{kTable, kData, kPlot, kPage, kReference};
  for (const ReportMethod& method : methods) {
    // Without the number where a single run was complete.
    const std::string plain(method_name(method));
    names.push_back(plain + ".exr");
    if (threads.size() < 2) continue;
    for (const int count : threads) names.push_back(plain + "-" + std::to_string(count) + "t.exr");
  }
  return names;
}

void check_folder(const std::string& folder, std::span<const std::string> names) {
  if (folder.empty()) throw Error(Fault::input, "cannot write a report into a folder without a name");
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
    throw cannot_write_into(folder, "it is not a folder");
  const TrialFolder trial(folder);
  for (const std::string& name : names) {
    const std::string extension = fs::path(name).extension().string();
    check_writable(path_in(folder, name), std::array{std::string_view(extension)});
  }
}

void write_report(const Report& report, const std::string& folder) {
  try {
    write_all(report, folder);
  } catch (const Error& error) {
    throw Error(Fault::runtime, error.what());
  }
}

void add_report_plot(const Report& report, const Image8& plot, const std::string& folder) {
  try {
    write_png(path_in(folder, kPlot), plot, {});
    write_text(path_in(folder, kPage), report_page(report, plot));
  } catch (const Error& error) {
    throw Error(Fault::runtime, error.what());
  }
}

}  // namespace meander
