// What a golden test leaves behind when it fails: pictures, numbers, and one page that shows them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "math/image.h"

namespace meander {

/// A picture of the page, `name`.png beside it, and what it shows.
struct EvidencePicture {
  std::string name;
  std::string caption;
  Image8 picture;
};

/// One failed comparison.
struct Evidence {
  std::string title;
  std::string verdict;                                       // one line
  std::vector<std::pair<std::string, std::string>> numbers;  // name, value
  std::vector<EvidencePicture> pictures;
  std::vector<std::string> files;  // in the page's folder; it links to them
};

/// Writes the evidence into `folder` (made where it is missing) and returns the path of its index.html. Error
/// (input) as write_file.
std::string write_evidence(const Evidence& evidence, const std::string& folder);

/// How unlikely |z| is by chance, in the colours of math/color_scale.h: dark violet p = 1, light yellow p =
/// 1e-10 or less; the smallest p of the three channels.
[[nodiscard]] Image8 p_value_picture(const Image& z);

/// Linear radiance as a display shows it.
[[nodiscard]] Image8 developed(const Image& linear);

}  // namespace meander
