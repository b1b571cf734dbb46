#include "golden/evidence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "io/image_file.h"
#include "io/output_file.h"
#include "math/color_scale.h"
#include "math/tone.h"
#include "stats/distributions.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastExponent = 10;  // p = 1e-10 has the last colour

constexpr const char* kStyle =
    "body { font: 14px sans-serif; margin: 24px; background: #1a1a1a; color: #ddd }\n"
    "img { image-rendering: pixelated; width: 320px; border: 1px solid #444 }\n"
    "figure { display: inline-block; margin: 8px; width: 320px; vertical-align: top }\n"
    "td { padding: 2px 16px 2px 0 } a { color: #8cf }\n";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c;
  }
  return safe;
}

std::string page(const Evidence& evidence) {
  std::string html = "<!doctype html>\n<meta charset=\"utf-8\">\n<title>" + escaped(evidence.title) +
                     "</title>\n<style>\n" + kStyle + "</style>\n<h1>" + escaped(evidence.title) +
                     "</h1>\n<p>" + escaped(evidence.verdict) + "</p>\n";
  for (const EvidencePicture& shown : evidence.pictures) {
    html += "<figure><img src=\"" + shown.name + ".png\" alt=\"" + shown.name + "\"><figcaption>" +
            escaped(shown.caption) + "</figcaption></figure>\n";
  }
  html += "<table>\n";
  for (const auto& [name, value] : evidence.numbers)
    html += "<tr><td>" + escaped(name) + "</td><td>" + escaped(value) + "</td></tr>\n";
  html += "</table>\n<p>";
  for (const std::string& file : evidence.files) {
    const std::string name = fs::path(file).filename().string();
    html += "<a href=\"" + escaped(name) + "\">" + escaped(name) + "</a> ";
  }
  return html + "</p>\n";
}

}  // namespace

std::string write_evidence(const Evidence& evidence, const std::string& folder) {
  fs::create_directories(folder);
  for (const EvidencePicture& shown : evidence.pictures)
    write_png(folder + "/" + shown.name + ".png", shown.picture, {});
  const std::string html = page(evidence);
  const std::string path = folder + "/index.html";
  write_file(path, std::as_bytes(std::span(html)));
  return path;
}

Image8 p_value_picture(const Image& z) {
  Image8 picture(z.width, z.height);
  for (std::size_t pixel = 0; pixel < picture.rgb.size() / 3; ++pixel) {
    double least = 1;
    for (std::size_t c = 0; c < 3; ++c)
      least = std::min(least, two_sided_p(double{z.values[pixel * z.channels + c]}));
    const double exponent = least > 0 ? -std::log10(least) : kLeastExponent;
    const Level3 color = color_scale(exponent / kLeastExponent);
    std::ranges::copy(color, picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
  }
  return picture;
}

Image8 developed(const Image& linear) {
  Image8 picture(linear.width, linear.height);
  for (std::size_t pixel = 0; pixel < picture.rgb.size() / 3; ++pixel)
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgb[3 * pixel + c] = static_cast<std::uint8_t>(
          display_level(Tone::srgb, double{linear.values[pixel * linear.channels + c]}));
  return picture;
}

}  // namespace meander
