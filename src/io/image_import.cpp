#include "io/image_import.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace meander {
namespace {

constexpr std::int64_t kMostTilePixels = std::int64_t{1} << 22;
constexpr std::int64_t kBandValues = std::int64_t{1} << 22;  // read at a time, or one row
constexpr int kBandRows = 64;

[[noreturn]] void fail(const std::string& reason) { throw std::runtime_error(reason); }

std::string reason_of(OIIO::ImageInput& in) {
  const std::string reason = in.geterror();
  return reason.empty() ? "the image library gives no reason" : reason;
}

ImageImportHeader header_of(const OIIO::ImageSpec& spec) {
  ImageImportHeader header;
  header.width = spec.width;
  header.height = spec.height;
  header.channels = spec.nchannels;
  header.placement = {spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width, spec.full_height};
  return header;
}

void check_spec(const OIIO::ImageSpec& spec, std::size_t file_bytes) {
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
  if (spec.deep) fail("deep images are not supported");
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    fail("it holds no flat picture: " + size);
  }
  if (std::int64_t{spec.width} * spec.height > kMostPixels) {
    fail("it is too large: " + size + ", at most " + std::to_string(kMostPixels));
  }
  if (spec.nchannels > kMostChannels) {
    fail("it has too many channels: " + std::to_string(spec.nchannels) + ", at most " +
         std::to_string(kMostChannels));
  }
  if (const int orientation = spec.get_int_attribute("Orientation", 1); orientation != 1) {
    fail("it is stored turned or mirrored (orientation " + std::to_string(orientation) +
         "); store it upright");
  }
  if (!fits_file(header_of(spec), file_bytes)) {
    fail("it claims more than a file of its length can hold: " + size);
  }
  const std::int64_t tile = std::int64_t{spec.tile_width} * spec.tile_height * std::max(spec.tile_depth, 1);
  if (spec.tile_width < 0 || spec.tile_height < 0 || tile > kMostTilePixels) {
    fail("its tiles are too large: " + std::to_string(spec.tile_width) + " x " +
         std::to_string(spec.tile_height));
  }
}

// Whether a PNG's chunks (length, type, data, checksum) run unbroken to its end chunk: libpng makes do with
// less.
bool is_whole_png(const FileBytes& content) {
  std::uint64_t position = 8;  // after the signature, which the library checks
  while (position + 12 <= content.size()) {
    const std::uint8_t* head = &content[position];
    const std::uint64_t length = std::uint64_t{head[0]} << 24 | head[1] << 16 | head[2] << 8 | head[3];
    position += 12 + length;
    constexpr std::array<std::uint8_t, 4> kEnd{'I', 'E', 'N', 'D'};
    if (std::equal(kEnd.begin(), kEnd.end(), head + 4)) return position <= content.size();
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

int rows_at_once(const OIIO::ImageSpec& spec) {
  if (spec.tile_width > 0) return spec.tile_height;
  const std::int64_t row = std::int64_t{spec.width} * spec.nchannels;
  return static_cast<int>(std::clamp<std::int64_t>(kBandValues / row, 1, kBandRows));
}

// Ends with an error's text where a band cannot be read.
void put_pixels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, Answer& answer) {
  const std::uint64_t row = std::uint64_t(spec.width) * spec.nchannels;
  const int band = rows_at_once(spec);
  std::vector<float> values;
  for (int y = 0; y < spec.height; y += band) {
    const int rows = std::min(band, spec.height - y);
    values.resize(row * rows);
    if (!read_band(in, spec, spec.y + y, spec.y + y + rows, values.data())) {
      answer.put(std::uint64_t{0});
      return answer.put_text(reason_of(in));
    }
    answer.put(std::uint64_t{values.size()});
    answer.put_bytes(values.data(), values.size() * sizeof(float));
  }
}

void put_head(const OIIO::ImageSpec& spec, bool encoded, Answer& answer) {
  std::vector<const OIIO::ParamValue*> texts;
  std::vector<const OIIO::ParamValue*> integers;
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    if (value.type() == OIIO::TypeDesc::STRING) texts.push_back(&value);
    if (value.type() == OIIO::TypeDesc::INT) integers.push_back(&value);
  }
  ImageImportHeader header = header_of(spec);
  header.texts = texts.size();
  header.integers = integers.size();
  header.encoded = encoded;
  answer.put(header);
  for (int c = 0; c < spec.nchannels; ++c) answer.put_text(spec.channel_name(c));
  for (const OIIO::ParamValue* value : texts) {
    answer.put_text(value->name().string());
    answer.put_text(value->get_string());
  }
  for (const OIIO::ParamValue* value : integers) {
    answer.put_text(value->name().string());
    answer.put(std::int64_t{value->get_int()});
  }
}

}  // namespace

std::uint64_t value_count(const ImageImportHeader& header) noexcept {
  return std::uint64_t(header.width) * std::uint64_t(header.height) * std::uint64_t(header.channels);
}

bool fits_file(const ImageImportHeader& header, std::size_t file_bytes) noexcept {
  constexpr std::uint64_t kAlways = std::uint64_t{1} << 28;
  constexpr std::uint64_t kPacked = 256;
  const std::uint64_t bytes = value_count(header) * sizeof(float);
  return bytes <= kAlways || bytes / kPacked <= file_bytes;
}

void import_image(const FileBytes& content, const std::string& reader, Answer& answer) {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  if (reader == "png" && !is_whole_png(content)) fail("it is no PNG, or not all of one");
  const auto in = OIIO::ImageInput::create(reader);
  if (!in) fail(OIIO::geterror());
  OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(content.data()), content.size());
  in->set_ioproxy(&memory);
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);  // the values as they are stored
  OIIO::ImageSpec spec;
  if (!in->open("image." + reader, spec, wishes)) fail(reason_of(*in));
  check_spec(spec, content.size());
  put_head(spec, reader == "png" || spec.format == OIIO::TypeDesc::UINT8, answer);
  put_pixels(*in, spec, answer);
  answer.flush();
  std::_Exit(0);  // what the library would do as it closes is nothing that is needed
}

}  // namespace meander
