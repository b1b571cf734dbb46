#include "io/checkpoint_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <optional>
#include <system_error>

#include "core/digest.h"
#include "core/error.h"
#include "io/output_file.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little && sizeof(Pixel) == 128 &&
              std::is_trivially_copyable_v<Pixel>);

constexpr std::string_view kMagic = "meander checkpoint ";
constexpr int kFormat = 1;
constexpr std::size_t kMostText = 65536;  // bytes of the head

using Digests = std::array<std::uint64_t, 2>;

Error bad_checkpoint(const std::string& path, const std::string& what) {
  return Error(Place{path, 0, 0}, what);
}

std::uint64_t digest_of(std::span<const std::byte> bytes) noexcept {
  Digest digest;
  digest.add(bytes);
  return digest.value();
}

Digests digests_of(const std::string& text, const Film& film) noexcept {
  return {digest_of(std::as_bytes(std::span(text))), digest_of(std::as_bytes(std::span(film.pixels)))};
}

std::optional<int> number_of(std::string_view text) noexcept {
  int value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// The head, up to and with its empty line; what follows stays in the stream.
std::string read_text(std::ifstream& in, const std::string& path) {
  std::string text;
  for (std::string line; text.size() < kMostText && std::getline(in, line);) {
    text += line + '\n';
    if (line.empty()) return text;
    if (!text.starts_with(kMagic)) throw bad_checkpoint(path, "is no checkpoint of meander");
    if (text.size() > line.size() + 1) continue;
    const std::optional<int> format = number_of(std::string_view(line).substr(kMagic.size()));
    if (!format || *format < 1) throw bad_checkpoint(path, "is no checkpoint of meander");
    if (*format > kFormat)
      throw bad_checkpoint(path, "is a checkpoint of format " + std::to_string(*format) +
                                     ", which a newer meander wrote; this one reads format " +
                                     std::to_string(kFormat));
  }
  throw bad_checkpoint(path, "is no whole checkpoint: its head does not end");
}

// "WIDTH HEIGHT", as the last field has it.
std::optional<std::pair<int, int>> film_size(const std::string* text) {
  if (!text) return std::nullopt;
  const std::size_t blank = std::min(text->find(' '), text->size());
  const auto width = number_of(std::string_view(*text).substr(0, blank));
  const auto height = number_of(std::string_view(*text).substr(std::min(blank + 1, text->size())));
  if (!width || !height || *width < 1 || *height < 1) return std::nullopt;
  return std::pair(*width, *height);
}

CheckpointFields fields_of(const std::string& text) {
  CheckpointFields fields;
  std::size_t begin = text.find('\n') + 1;
  for (std::size_t end = text.find('\n', begin); end > begin; end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin);
    const std::size_t blank = std::min(line.find(' '), line.size());
    fields.emplace_back(line.substr(0, blank), line.substr(std::min(blank + 1, line.size())));
    begin = end + 1;
  }
  return fields;
}

// Memory is asked for only once the file is known to be as long as it says.
void check_length(const std::string& path, std::size_t head, std::uint64_t pixels) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / (2 * sizeof(Pixel));
  if (pixels > kMost)
    throw bad_checkpoint(path, "is damaged: it names a film of " + std::to_string(pixels) + " pixels");
  const std::uint64_t wanted = head + pixels * sizeof(Pixel) + sizeof(Digests);
  const std::uint64_t size = fs::file_size(path);
  if (size != wanted)
    throw bad_checkpoint(path, "is no whole checkpoint: it has " + std::to_string(size) +
                                   " bytes and should have " + std::to_string(wanted));
}

std::ifstream open_file(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (status.type() == fs::file_type::not_found) throw bad_checkpoint(path, "there is no such checkpoint");
  if (failed) throw bad_checkpoint(path, "cannot open: " + failed.message());
  if (!fs::is_regular_file(status)) throw bad_checkpoint(path, "is no checkpoint: it is not a regular file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw bad_checkpoint(path, "cannot open: " + std::system_category().message(errno));
  return in;
}

}  // namespace

void write_checkpoint(const std::string& path, const CheckpointFields& fields, const Film& film) {
  std::string text = std::string(kMagic) + std::to_string(kFormat) + '\n';
  for (const auto& [name, value] : fields) text += name + ' ' + value + '\n';
  text += "film " + std::to_string(film.width) + ' ' + std::to_string(film.height) + "\n\n";
  const Digests digests = digests_of(text, film);
  const std::array<std::span<const std::byte>, 3> parts{std::as_bytes(std::span(text)),
                                                        std::as_bytes(std::span(film.pixels)),
                                                        std::as_bytes(std::span(digests))};
  write_file(path, parts);
}

Checkpoint read_checkpoint(const std::string& path) {
  std::ifstream in = open_file(path);
  const std::string text = read_text(in, path);
  Checkpoint checkpoint{fields_of(text), {}};
  const auto size = film_size(find_field(checkpoint.fields, "film"));
  if (!size) throw bad_checkpoint(path, "is damaged: it names no film");
  const std::uint64_t pixels = static_cast<std::uint64_t>(size->first) * size->second;
  check_length(path, text.size(), pixels);
  checkpoint.fields.pop_back();
  checkpoint.film = Film(size->first, size->second);
  Digests digests{};
  in.read(reinterpret_cast<char*>(checkpoint.film.pixels.data()),
          static_cast<std::streamsize>(pixels * sizeof(Pixel)));
  in.read(reinterpret_cast<char*>(digests.data()), sizeof digests);
  if (!in) throw bad_checkpoint(path, "cannot be read to its end");
  if (digests != digests_of(text, checkpoint.film))
    throw bad_checkpoint(path, "is damaged: its checksum does not fit");
  return checkpoint;
}

void check_checkpoint_writable(const std::string& path) {
  check_writable(path, {});
  std::error_code absent;
  if (!fs::exists(path, absent)) return;
  std::ifstream in = open_file(path);
  std::string head(kMagic.size(), '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head != kMagic)
    throw Error(Fault::input,
                "cannot write " + path + ": it exists and is no checkpoint of meander; use another name");
}

const std::string* find_field(const CheckpointFields& fields, std::string_view name) noexcept {
  const auto found =
      std::ranges::find(fields, name, [](const auto& field) { return std::string_view(field.first); });
  return found == fields.end() ? nullptr : &found->second;
}

}  // namespace meander
