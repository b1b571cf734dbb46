#include "io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "core/error.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostPixels = std::int64_t{1} << 30;
constexpr int kMostChannels = 64;
constexpr int kBand = 64;  // rows read at a time

// The library's errors are several lines at times, and start with its own name for the file.
std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "the image library gives no reason" : text;
}

Error cannot_read(const std::string& path, const std::string& reason) {
  return Error(Fault::input, "cannot read " + path + ": " + one_line(reason));
}

// Walks own the processors; files are small beside them and must not wake a second pool of threads.
void keep_to_this_thread() {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
}

using Bytes = std::vector<unsigned char>;

Bytes encode(const std::string& path, const OIIO::ImageSpec& spec, const void* pixels) {
  keep_to_this_thread();
  const bool exr = spec.format == OIIO::TypeDesc::FLOAT;
  const std::string name = exr ? "image.exr" : "image.png";
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create(name);
  if (!out) throw Error(Fault::runtime, "cannot write " + path + ": " + one_line(OIIO::geterror()));
  out->set_ioproxy(&memory);
  const bool written =
      out->open(name, spec) && out->write_image(spec.format, pixels) && out->close() && !bytes.empty();
  if (!written) throw Error(Fault::runtime, "cannot write " + path + ": " + one_line(out->geterror()));
  return bytes;
}

Bytes encode_png(const std::string& path, const Image8& frame, const ImageAttributes& attributes) {
  assert(frame.width > 0 && frame.height > 0);
  OIIO::ImageSpec spec(frame.width, frame.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [name, value] : attributes.text) spec.attribute(name, value);
  for (const auto& [name, value] : attributes.integers) spec.attribute(name, std::to_string(value));
  return encode(path, spec, frame.rgb.data());
}

// The formats meander reads, by extension: the library is never let loose on the others it knows.
std::string reader_for(const std::string& path) {
  using Row = std::pair<std::string_view, std::string_view>;
  constexpr std::array<Row, 6> kReaders = {Row{".exr", "openexr"}, Row{".hdr", "hdr"},  Row{".pfm", "pnm"},
                                           Row{".png", "png"},     Row{".tif", "tiff"}, Row{".tiff", "tiff"}};
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
  std::array<std::string_view, kReaders.size()> known;
  for (std::size_t i = 0; i < kReaders.size(); ++i) {
    if (kReaders[i].first == extension) return std::string(kReaders[i].second);
    known[i] = kReaders[i].first;
  }
  throw cannot_read(path, (extension.empty() ? "it has no file type" : "unknown file type " + extension) +
                              "; it must be one of " + list_names(known));
}

void check_exists(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (failed) throw cannot_read(path, failed.message());
  if (fs::is_directory(status)) throw cannot_read(path, "it is a directory");
  if (!fs::is_regular_file(status)) throw cannot_read(path, "it is not a regular file");
  if (fs::file_size(path, failed) == 0 && !failed) throw cannot_read(path, "it is empty");
}

void check_spec(const std::string& path, const OIIO::ImageSpec& spec) {
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
  if (spec.deep) throw cannot_read(path, "deep images are not supported");
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    throw cannot_read(path, "it holds no flat picture: " + size);
  }
  if (std::int64_t{spec.width} * spec.height > kMostPixels) {
    throw cannot_read(path, "it is too large: " + size + ", at most " + std::to_string(kMostPixels));
  }
  if (spec.nchannels > kMostChannels) {
    throw cannot_read(path, "it has too many channels: " + std::to_string(spec.nchannels) + ", at most " +
                                std::to_string(kMostChannels));
  }
  if (const int orientation = spec.get_int_attribute("Orientation", 1); orientation != 1) {
    throw cannot_read(path, "it is stored turned or mirrored (orientation " + std::to_string(orientation) +
                                "); store it upright");
  }
}

// Whether a PNG's chunks (length, type, data, checksum) run unbroken to its end chunk. Asked first because
// libpng prints to the terminal when a file ends early, and leaks.
bool is_whole_png(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code failed;
  const std::uint64_t size = fs::file_size(path, failed);
  std::uint64_t position = 8;  // after the signature, which the library checks
  std::array<unsigned char, 8> head{};
  while (!failed && position + 12 <= size) {
    in.seekg(static_cast<std::streamoff>(position));
    if (!in.read(reinterpret_cast<char*>(head.data()), head.size())) return false;
    const std::uint64_t length = std::uint64_t{head[0]} << 24 | head[1] << 16 | head[2] << 8 | head[3];
    position += 12 + length;
    if (std::equal(head.begin() + 4, head.end(), "IEND")) return position <= size;
  }
  return false;
}

bool read_band(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, int begin, int end, float* to) {
  if (spec.tile_width > 0) {
    return in.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0, spec.nchannels,
                         OIIO::TypeDesc::FLOAT, to);
  }
  return in.read_scanlines(0, 0, begin, end, spec.z, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, to);
}

// Band by band into reserved, untouched memory: a short file that claims to be huge fails before it costs
// any.
Image read_pixels(const std::string& path, OIIO::ImageInput& in, const OIIO::ImageSpec& spec) {
  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.channels = spec.nchannels;
  const std::size_t row = static_cast<std::size_t>(spec.width) * spec.nchannels;
  image.values.reserve(row * spec.height);
  const int band = spec.tile_width > 0 ? spec.tile_height : kBand;
  for (int y = 0; y < spec.height; y += band) {
    const int rows = std::min(band, spec.height - y);
    image.values.resize(row * (y + rows));
    if (!read_band(in, spec, spec.y + y, spec.y + y + rows, image.values.data() + row * y)) {
      throw cannot_read(path, in.geterror());
    }
  }
  return image;
}

ImageAttributes attributes_of(const OIIO::ImageSpec& spec) {
  ImageAttributes attributes;
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const std::string name = value.name().string();
    if (value.type() == OIIO::TypeDesc::STRING) {
      attributes.text.emplace_back(name, value.get_string());
    } else if (value.type() == OIIO::TypeDesc::INT) {
      attributes.integers.emplace_back(name, value.get_int());
    }
  }
  return attributes;
}

// The number that the whole of a text attribute spells.
template <class Number>
std::optional<Number> find_text_as(const ImageAttributes& attributes, const std::string& name) {
  for (const auto& [key, value] : attributes.text) {
    if (key != name) continue;
    Number parsed = 0;
    const auto [end, failed] = std::from_chars(value.data(), value.data() + value.size(), parsed);
    if (failed == std::errc() && end == value.data() + value.size()) return parsed;
  }
  return std::nullopt;
}

}  // namespace

void write_exr(const std::string& path, const Image& image, std::span<const std::string> channel_names,
               const ImageAttributes& attributes, const Placement& placement) {
  assert(image.width > 0 && image.height > 0 &&
         channel_names.size() == static_cast<std::size_t>(image.channels));
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames.assign(channel_names.begin(), channel_names.end());
  spec.x = placement.x;
  spec.y = placement.y;
  spec.full_width = placement.full_width > 0 ? placement.full_width : image.width;
  spec.full_height = placement.full_height > 0 ? placement.full_height : image.height;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // else the library stamps the time, and equal images differ in their bytes
  for (const auto& [name, value] : attributes.text) spec.attribute(name, value);
  for (const auto& [name, value] : attributes.integers) {
    const bool fits = value >= std::numeric_limits<std::int32_t>::min() &&
                      value <= std::numeric_limits<std::int32_t>::max();
    if (fits) {
      spec.attribute(name, static_cast<int>(value));
    } else {
      spec.attribute(name, std::to_string(value));
    }
  }
  const Bytes bytes = encode(path, spec, image.values.data());
  write_file(path, std::as_bytes(std::span(bytes)));
}

std::vector<unsigned char> png_bytes(const Image8& frame, const ImageAttributes& attributes) {
  return encode_png("a picture", frame, attributes);
}

void write_png(const std::string& path, const Image8& frame, const ImageAttributes& attributes) {
  const Bytes bytes = encode_png(path, frame, attributes);
  write_file(path, std::as_bytes(std::span(bytes)));
}

LoadedImage read_image(const std::string& path) {
  keep_to_this_thread();
  const std::string reader = reader_for(path);
  check_exists(path);
  if (reader == "png" && !is_whole_png(path)) throw cannot_read(path, "it is no PNG, or not all of one");
  const auto in = OIIO::ImageInput::create(reader);
  if (!in) throw cannot_read(path, OIIO::geterror());
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);  // the values as they are stored
  OIIO::ImageSpec spec;
  if (!in->open(path, spec, wishes)) throw cannot_read(path, in->geterror());
  check_spec(path, spec);
  LoadedImage loaded;
  try {
    loaded.image = read_pixels(path, *in, spec);
  } catch (const std::bad_alloc&) {
    throw cannot_read(path, "not enough memory for " + std::to_string(spec.width) + " x " +
                                std::to_string(spec.height) + " pixels");
  }
  loaded.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
  loaded.attributes = attributes_of(spec);
  loaded.placement = {spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width, spec.full_height};
  loaded.encoded = reader == "png" || spec.format == OIIO::TypeDesc::UINT8;
  if (!in->close()) throw cannot_read(path, in->geterror());
  return loaded;
}

std::optional<std::int64_t> find_integer(const ImageAttributes& attributes, const std::string& name) {
  for (const auto& [key, value] : attributes.integers) {
    if (key == name) return value;
  }
  return find_text_as<std::int64_t>(attributes, name);
}

std::optional<std::uint64_t> find_unsigned(const ImageAttributes& attributes, const std::string& name) {
  for (const auto& [key, value] : attributes.integers) {
    if (key == name && value >= 0) return static_cast<std::uint64_t>(value);
  }
  return find_text_as<std::uint64_t>(attributes, name);
}

std::optional<double> find_number(const ImageAttributes& attributes, const std::string& name) {
  const auto found = find_text_as<double>(attributes, name);
  return found && std::isfinite(*found) ? found : std::nullopt;
}

}  // namespace meander
