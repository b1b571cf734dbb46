#include "app/report_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/report_table.h"
#include "app/run_stats.h"
#include "io/image_file.h"
#include "math/color_scale.h"
#include "math/tone.h"
#include "stats/error_picture.h"

namespace meander {
namespace {

constexpr std::string_view kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 1240px; padding: 0 1em; color: #1d1d1f; background: #fff }
h1 { font-size: 1.5em; margin-bottom: .2em } h2 { font-size: 1.15em; margin-top: 2em }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; display: block; overflow-x: auto }
th, td { padding: .2em .7em; text-align: right; white-space: nowrap } th { border-bottom: 1px solid #888; font-weight: 600 }
td:first-child, th:first-child { text-align: left } tr.first td { border-top: 1px solid #ddd }
dl { display: grid; grid-template-columns: max-content auto; gap: .1em 1em } dt { color: #666 } dd { margin: 0 }
figure { margin: 0 } figcaption { color: #444; margin: .3em 0 1em }
img { max-width: 100%; height: auto } .pair { display: grid; grid-template-columns: 1fr 1fr; gap: 1em } .pair img { width: 100% }
.scale { height: .9em; border-radius: 2px } .ends { display: flex; justify-content: space-between; color: #444; font-size: .9em }
@media (max-width: 700px) { .pair { grid-template-columns: 1fr } }
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// RFC 4648, section 4.
std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string picture(const Image8& image, std::string_view caption) {
  return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
         base64(png_bytes(image, {})) + "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

// The image as the scene's display shows it.
Image8 shown(const Image& linear, const Display& display) {
  Image8 frame(linear.width, linear.height);
  const double gain = std::exp2(display.exposure);
  for (int y = 0; y < linear.height; ++y)
    for (int x = 0; x < linear.width; ++x)
      for (int c = 0; c < 3; ++c)
        frame.at(x, y)[c] =
            static_cast<std::uint8_t>(display_level(display.tone, gain * double{linear.at(x, y)[c]}));
  return frame;
}

std::string html_table(const TextTable& table) {
  const auto row = [](const std::vector<std::string>& cells, std::string_view tag, std::string_view kind) {
    std::string text = "<tr" + std::string(kind) + ">";
    for (const std::string& cell : cells)
      text += "<" + std::string(tag) + ">" + escaped(cell) + "</" + std::string(tag) + ">";
    return text + "</tr>\n";
  };
  std::string text = "<table>\n" + row(table.header, "th", "");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& cells = table.rows[i];
    const bool first = i > 0 && (cells[0] != table.rows[i - 1][0] || cells[1] != table.rows[i - 1][1]);
    text += row(cells, "td", first ? " class=\"first\"" : "");
  }
  return text + "</table>\n";
}

// A picture without such pixels counts whole.
std::string counted_text(const Report& report) {
  const auto count = std::ranges::count(report.mask, std::uint8_t{1});
  return count > 0 ? std::to_string(count) + " pixels that show translucent objects"
                   : "all pixels: none shows a translucent object";
}

std::string facts(const Report& report) {
  const Tile area = area_of(report.job);
  char setup[32];
  std::snprintf(setup, sizeof setup, "%.2f s", report.setup_seconds);
  const std::pair<const char*, std::string> lines[] = {
      {"Image", std::to_string(area.x1 - area.x0) + " x " + std::to_string(area.y1 - area.y0) +
                    " pixels, seed " + std::to_string(report.job.seed) + ", first sample " +
                    std::to_string(report.job.first_sample)},
      {"Errors over", counted_text(report)},
      {"Machine", report.machine},
      {"Date", report.date},
      {"Program", "meander " + version_text()},
      {"Setup", setup}};
  std::string text = "<dl>\n";
  for (const auto& [name, value] : lines)
    text += "<dt>" + std::string(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
  return text + "</dl>\n";
}

// The relative error at the ends of the error maps' scale: twice that of the best image, as 1, 2 or 5 times a
// power of ten.
double full_scale(const Report& report) {
  double least = 1;
  for (const ReportRun& run : report.runs) least = std::min(least, run.rows.back().error.rms());
  const double wanted = std::clamp(2 * least, 1e-3, 1.0);
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0})
    if (wanted <= step * power * 1.0001) return step * power;
  return 10 * power;
}

std::string scale_legend(double full) {
  std::string text = "<div class=\"scale\" style=\"background: linear-gradient(to right";
  for (int i = -10; i <= 10; ++i) {
    const Level3 color = diverging_scale(i / 10.0);
    char stop[40];
    std::snprintf(stop, sizeof stop, ", rgb(%d,%d,%d)", color[0], color[1], color[2]);
    text += stop;
  }
  char ends[160];
  std::snprintf(
      ends, sizeof ends,
      ")\"></div>\n<div class=\"ends\"><span>%g %% darker</span><span>as the reference</span><span>%g "
      "%% brighter</span></div>\n",
      100 * full, 100 * full);
  return text + ends;
}

std::string pictures(const Report& report) {
  const Display& display = report.job.scene->display;
  const double full = full_scale(report);
  std::string text = "<h2>Pictures</h2>\n" + picture(shown(report.reference.image, display), "Reference");
  text += "<p>Error maps: luminance against the reference's, whose noise is in them too.</p>\n" +
          scale_legend(full);
  std::vector<const Image*> drawn;
  for (const ReportRun& run : report.runs) {
    // Other numbers of threads give the same image.
    const bool again =
        std::ranges::any_of(drawn, [&](const Image* other) { return other->values == run.image.values; });
    if (again) continue;
    drawn.push_back(&run.image);
    const std::string name =
        std::string(method_name(run.method)) + ", " + std::to_string(run.last.spp) + " samples a pixel";
    text += "<h2>" + escaped(name) + "</h2>\n<div class=\"pair\">" +
            picture(shown(run.image, display), "Image") +
            picture(error_picture(run.image, report.reference.image, full, false), "Error") + "</div>\n";
  }
  return text;
}

}  // namespace

std::string report_page(const Report& report, const std::optional<Image8>& plot) {
  const std::string title = "Error against time: " + report.job.scene->name;
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      escaped(title) + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n<h1>" +
      escaped(title) + "</h1>\n" + facts(report);
  for (const std::string& note : report_notes(report)) text += "<p>" + escaped(note) + "</p>\n";
  if (plot)
    text += picture(
        *plot, "Errors with their 95 % intervals; dashed, the noise; grey, the fall as the root of the time");
  text += "<h2>Budgets</h2>\n" + html_table(budget_table(report));
  text +=
      "<p>Noise is what the image says of itself, error what the reference says of it, both relative, over "
      "pixels and channels. Seconds are those of the passes alone. Efficiency, 1/(MSE s), stays the same "
      "however long an unbiased estimator runs.</p>\n";
  text += "<h2>Runs</h2>\n" + html_table(run_table(report)) + pictures(report);
  return text + "</body>\n</html>\n";
}

}  // namespace meander
