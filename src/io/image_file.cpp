#include "io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "io/child_reader.h"
#include "io/image_import.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSurelyFits = std::uint64_t{1} << 26;  // values that are taken at once

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

bool is_sound(const ImageImportHeader& header, std::size_t file_bytes) {
  const bool flat = header.width >= 1 && header.height >= 1 && header.channels >= 1;
  return flat && header.channels <= kMostChannels && fits_file(header, file_bytes) &&
         std::int64_t{header.width} * header.height <= kMostPixels;
}

void receive_pixels(ChildReader& child, std::uint64_t count, std::vector<float>& values) {
  if (count <= kSurelyFits) values.reserve(count);
  while (values.size() < count) {
    const auto band = child.receive<std::uint64_t>();
    if (band > count - values.size()) child.fail_of_nonsense();
    if (band == 0) child.refuse_content(child.receive_text());
    child.receive_many(values, values.size() + band);
  }
}

LoadedImage receive_image(ChildReader& child) {
  const auto header = child.receive<ImageImportHeader>();
  if (!is_sound(header, child.file_bytes())) child.fail_of_nonsense();
  LoadedImage loaded;
  loaded.placement = header.placement;
  loaded.encoded = header.encoded;
  for (int c = 0; c < header.channels; ++c) loaded.channels.push_back(child.receive_text());
  for (std::uint64_t i = 0; i < header.texts; ++i) {
    std::string name = child.receive_text();
    loaded.attributes.text.emplace_back(std::move(name), child.receive_text());
  }
  for (std::uint64_t i = 0; i < header.integers; ++i) {
    std::string name = child.receive_text();
    loaded.attributes.integers.emplace_back(std::move(name), child.receive<std::int64_t>());
  }
  Image& image = loaded.image;
  image.width = header.width;
  image.height = header.height;
  image.channels = header.channels;
  receive_pixels(child, value_count(header), image.values);
  return loaded;
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
  const std::string reader = reader_for(path);
  check_exists(path);
  const ReaderWords::Refusal refuse = [&](const std::string& reason) { return cannot_read(path, reason); };
  try {
    ChildReader child(
        path, {"the image reader", refuse, refuse},
        [&](const FileBytes& content, Answer& answer) { import_image(content, reader, answer); });
    return receive_image(child);
  } catch (const std::bad_alloc&) {
    throw cannot_read(path, "not enough memory for its pixels");
  }
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
