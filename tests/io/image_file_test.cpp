// Image files: what was written comes back bit for bit, and what cannot be leaves nothing behind.
#include "io/image_file.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

long entries(const TemporaryFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

std::string error_of(Fault fault, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK(error.fault() == fault);
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
  return "";
}

std::string input_error(const std::function<void()>& action) { return error_of(Fault::input, action); }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Values over the whole range of a float, with the awkward ones first.
Image awkward(int width, int height, int channels) {
  Image image(width, height, channels);
  std::uint32_t bits = 12345;
  for (float& value : image.values) {
    bits = bits * 1664525u + 1013904223u;
    value = std::bit_cast<float>(bits & 0xbfffffffu);  // no infinities or NaN by chance
  }
  const float special[] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::denorm_min(), -0.0f, 1.0f / 3};
  for (std::size_t i = 0; i < std::min(image.values.size(), std::size(special)); ++i) {
    image.values[i] = special[i];
  }
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.values.size() == b.values.size() &&
         std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

std::optional<std::string> find_text(const ImageAttributes& attributes, const std::string& name) {
  for (const auto& [key, value] : attributes.text) {
    if (key == name) return value;
  }
  return std::nullopt;
}

const std::vector<std::string> kFilmChannels = {"R", "G", "B", "variance.R", "variance.G", "variance.B"};
const std::vector<std::string> kRgb = {"R", "G", "B"};

int threads_of_process() {
  return static_cast<int>(std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator()));
}

// Files of this process cannot grow beyond `bytes` while it lives: as on a disk that is full.
struct FullDisk {
  rlimit before{};
  void (*handler)(int);
  explicit FullDisk(rlim_t bytes) : handler(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
};

}  // namespace

TEST_CASE("numbers that travel as text: seeds beyond 2^63, and fractions") {
  const ImageAttributes attributes{
      {{"seed", "18446744073709551615"}, {"half", "0.5"}, {"nan", "nan"}, {"much", "0.5 m"}}, {}};
  CHECK(find_unsigned(attributes, "seed") == std::numeric_limits<std::uint64_t>::max());
  CHECK_FALSE(find_integer(attributes, "seed").has_value());
  CHECK(find_number(attributes, "half") == 0.5);
  for (const char* name : {"nan", "much", "none"}) CHECK_FALSE(find_number(attributes, name).has_value());
}

TEST_CASE("an EXR comes back bit for bit, with its channel names, attributes and placement") {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{3, 2}, std::pair{131, 77}}) {
    const Image image = awkward(width, height, 6);
    const ImageAttributes attributes = {
        {{"meander/scene", "scenes/jäde.toml"}, {"meander/version", "0.1.0"}},
        {{"meander/spp", 64}, {"meander/seed", 1234567890123}, {"meander/first_sample", -7}}};
    write_exr(folder.at("a.exr"), image, kFilmChannels, attributes, {5, 6, 400, 300});
    const LoadedImage loaded = read_image(folder.at("a.exr"));
    CHECK(same_bits(loaded.image, image));
    CHECK(loaded.channels == kFilmChannels);
    CHECK_FALSE(loaded.encoded);
    CHECK(loaded.placement.x == 5);
    CHECK(loaded.placement.y == 6);
    CHECK(loaded.placement.full_width == 400);
    CHECK(loaded.placement.full_height == 300);
    CHECK(find_text(loaded.attributes, "meander/scene") == "scenes/jäde.toml");
    CHECK(find_text(loaded.attributes, "meander/version") == "0.1.0");
    CHECK(find_text(loaded.attributes, "meander/seed") == "1234567890123");
    CHECK(find_integer(loaded.attributes, "meander/seed") == 1234567890123);
    CHECK(find_integer(loaded.attributes, "meander/spp") == 64);
    CHECK_FALSE(find_text(loaded.attributes, "meander/spp").has_value());
    CHECK(find_integer(loaded.attributes, "meander/first_sample") == -7);
    CHECK_FALSE(find_integer(loaded.attributes, "meander/scene").has_value());
    CHECK_FALSE(find_integer(loaded.attributes, "meander/none").has_value());
    CHECK(find_unsigned(loaded.attributes, "meander/seed") == 1234567890123);
    CHECK(find_unsigned(loaded.attributes, "meander/spp") == 64);
    CHECK_FALSE(find_unsigned(loaded.attributes, "meander/first_sample").has_value());
  }
  CHECK(entries(folder) == 1);
}

TEST_CASE("an EXR without a placement fills its own picture, and equal images are equal files, undated") {
  const TemporaryFolder folder;
  const Image image = awkward(20, 10, 3);
  write_exr(folder.at("a.exr"), image, kRgb, {});
  write_exr(folder.at("b.exr"), image, kRgb, {});
  const LoadedImage loaded = read_image(folder.at("a.exr"));
  CHECK(loaded.placement.x == 0);
  CHECK(loaded.placement.full_width == 20);
  CHECK(loaded.placement.full_height == 10);
  CHECK(bytes_of(folder.at("a.exr")) == bytes_of(folder.at("b.exr")));
  CHECK(find_text(loaded.attributes, "DateTime").value_or("").empty());
}

TEST_CASE("a PNG comes back level for level, with its attributes as text") {
  const TemporaryFolder folder;
  Image8 frame(16, 17);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) frame.rgb[i] = static_cast<std::uint8_t>(i * 7);
  write_png(folder.at("a.png"), frame, {{{"meander/version", "0.1.0"}}, {{"meander/spp", 64}}});
  const LoadedImage loaded = read_image(folder.at("a.png"));
  REQUIRE(loaded.image.width == 16);
  REQUIRE(loaded.image.height == 17);
  REQUIRE(loaded.image.channels == 3);
  CHECK(loaded.encoded);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) {
    CHECK(std::lround(loaded.image.values[i] * 255.0f) == frame.rgb[i]);
  }
  CHECK(find_text(loaded.attributes, "meander/version") == "0.1.0");
  CHECK(find_text(loaded.attributes, "meander/spp") == "64");
  CHECK(find_integer(loaded.attributes, "meander/spp") == 64);
}

TEST_CASE("a PFM is read with its last stored row at the top, in either byte order") {
  const TemporaryFolder folder;
  const float stored[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  std::string little(reinterpret_cast<const char*>(stored), sizeof(stored));
  std::string big = little;
  for (std::size_t i = 0; i < big.size(); i += 4) std::reverse(big.begin() + i, big.begin() + i + 4);
  put(folder.at("little.pfm"), "PF\n2 2\n-1.0\n" + little);
  put(folder.at("big.PFM"), "PF\n2 2\n1.0\n" + big);
  const std::vector<float> expected = {7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6};
  CHECK(read_image(folder.at("little.pfm")).image.values == expected);
  CHECK(read_image(folder.at("big.PFM")).image.values == expected);
  put(folder.at("short.pfm"), "PF\n2 2\n-1.0\n" + little.substr(0, 30));
  CHECK(contains(input_error([&] { (void)read_image(folder.at("short.pfm")); }), "cannot read "));
}

TEST_CASE("a Radiance HDR pixel is mantissa times two to the exponent") {
  const TemporaryFolder folder;
  put(folder.at("a.hdr"),
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + std::string("\x80\x40\x20\x82"));
  const LoadedImage loaded = read_image(folder.at("a.hdr"));
  REQUIRE(loaded.image.values.size() == 3);
  CHECK_FALSE(loaded.encoded);
  // Within the half step that readers may add to a mantissa.
  CHECK(loaded.image.values[0] == doctest::Approx(2.0).epsilon(0.005));
  CHECK(loaded.image.values[1] == doctest::Approx(1.0).epsilon(0.01));
  CHECK(loaded.image.values[2] == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("a file that cannot be written leaves neither itself nor a partial, and keeps what was there") {
  const TemporaryFolder folder;
  const Image image = awkward(200, 100, 3);
  const Image8 frame(4, 4);
  CHECK(contains(input_error([&] { write_exr(folder.at("none/a.exr"), image, kRgb, {}); }),
                 "cannot write " + folder.at("none/a.exr") + ": No such file"));
  put(folder.at("a.exr"), "before");
  {
    const FullDisk full(100);
    for (const std::string name : {"a.exr", "b.exr"})
      CHECK(contains(error_of(Fault::runtime, [&] { write_exr(folder.at(name), image, kRgb, {}); }),
                     "cannot write " + folder.at(name) + ": File too large"));
  }
  CHECK(bytes_of(folder.at("a.exr")) == "before");
  CHECK(entries(folder) == 1);
  fs::create_directory(folder.path() / "taken.png");
  CHECK(contains(input_error([&] { write_png(folder.at("taken.png"), frame, {}); }), "directory"));
  CHECK(entries(folder) == 2);
  write_exr(folder.at("a.exr"), image, kRgb, {});
  CHECK(same_bits(read_image(folder.at("a.exr")).image, image));
}

TEST_CASE("an output is refused before the work by its type, folder or kind, and nothing is left behind") {
  const TemporaryFolder folder;
  constexpr std::string_view kTypes[] = {".exr", ".png"};
  CHECK(input_error([&] { check_writable(folder.at("a.exr"), kTypes); }).empty());
  CHECK(input_error([&] { check_writable(folder.at("a.PNG"), kTypes); }).empty());
  CHECK(entries(folder) == 0);
  CHECK(input_error([&] { check_writable(folder.at("a.jpg"), kTypes); }) ==
        "cannot write " + folder.at("a.jpg") + ": unknown file type .jpg; use .exr, .png");
  CHECK(contains(input_error([&] { check_writable(folder.at("a"), kTypes); }), "it has no file type; use"));
  CHECK(contains(input_error([&] { check_writable("", kTypes); }), "without a name"));
  CHECK(contains(input_error([&] { check_writable(folder.at("none/a.exr"), kTypes); }),
                 "there is no folder " + folder.at("none")));
  put(folder.at("file"), "x");
  CHECK(contains(input_error([&] { check_writable(folder.at("file/a.exr"), kTypes); }), "is not a folder"));
  fs::create_directory(folder.path() / "dir.exr");
  CHECK(contains(input_error([&] { check_writable(folder.at("dir.exr"), kTypes); }), "it is a directory"));
  put(folder.at("kept.exr"), "kept");
  CHECK(input_error([&] { check_writable(folder.at("kept.exr"), kTypes); }).empty());
  CHECK(bytes_of(folder.at("kept.exr")) == "kept");
  CHECK(entries(folder) == 3);
  if (geteuid() != 0) {  // root may write anywhere
    fs::permissions(folder.path() / "dir.exr", fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(contains(input_error([&] { check_writable(folder.at("dir.exr/a.exr"), kTypes); }), "Permission"));
    fs::permissions(folder.path() / "dir.exr", fs::perms::owner_all);
  }
}

TEST_CASE("what a killed process left of an output goes before the next, what a living one writes stays") {
  const TemporaryFolder folder;
  constexpr std::string_view kExr[] = {".exr"};
  put(folder.at(".a.partial-1.exr"), "left by a killed process");
  put(folder.at(".a.partial-2.exr"), "in the making");
  put(folder.at(".b.partial-1.exr"), "of another output");
  put(folder.at(".a.partial-1.json"), "of another output");
  fs::create_directory(folder.path() / ".a.partial-3.exr");
  const int making = open(folder.at(".a.partial-2.exr").c_str(), O_RDONLY | O_CLOEXEC);
  REQUIRE(flock(making, LOCK_EX) == 0);
  check_writable(folder.at("a.exr"), kExr);
  CHECK_FALSE(fs::exists(folder.path() / ".a.partial-1.exr"));
  CHECK(bytes_of(folder.at(".a.partial-2.exr")) == "in the making");
  CHECK(entries(folder) == 4);
  close(making);
  check_writable(folder.at("a.exr"), kExr);
  CHECK(entries(folder) == 3);
}

TEST_CASE("a truncated image is an error wherever it ends") {
  const TemporaryFolder folder;
  write_exr(folder.at("a.exr"), awkward(100, 100, 3), kRgb, {});
  Image8 frame(100, 100);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) frame.rgb[i] = static_cast<std::uint8_t>(i * i);
  write_png(folder.at("a.png"), frame, {});
  for (const std::string extension : {".exr", ".png"}) {
    const std::string whole = bytes_of(folder.at("a" + extension));
    for (const double part : {0.0, 0.0001, 0.001, 0.005, 0.1, 0.5, 0.95}) {
      CAPTURE(extension);
      CAPTURE(part);
      const auto kept = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
      put(folder.at("cut" + extension), whole.substr(0, kept));
      CHECK(contains(input_error([&] { (void)read_image(folder.at("cut" + extension)); }), "cannot read "));
    }
  }
}

TEST_CASE("what is not an image, or is no file at all, is an error") {
  const TemporaryFolder folder;
  CHECK(input_error([&] { (void)read_image(folder.at("a.exr")); }) ==
        "cannot read " + folder.at("a.exr") + ": No such file or directory");
  fs::create_directory(folder.path() / "dir.exr");
  CHECK(contains(input_error([&] { (void)read_image(folder.at("dir.exr")); }), "it is a directory"));
  CHECK(contains(input_error([&] { (void)read_image(folder.at("a.jpg")); }), "unknown file type .jpg"));
  REQUIRE(mkfifo(folder.at("pipe.png").c_str(), 0600) == 0);
  CHECK(contains(input_error([&] { (void)read_image(folder.at("pipe.png")); }), "not a regular file"));
  for (const std::string extension : {".exr", ".hdr", ".pfm", ".png", ".tif"}) {
    CAPTURE(extension);
    put(folder.at("text" + extension), "this is not an image\n");
    CHECK(contains(input_error([&] { (void)read_image(folder.at("text" + extension)); }), "cannot read "));
  }
}

TEST_CASE("a small file that claims to be huge is refused without taking the memory") {
  const TemporaryFolder folder;
  put(folder.at("most.pfm"), "PF\n40000 40000\n-1.0\n");
  CHECK(contains(input_error([&] { (void)read_image(folder.at("most.pfm")); }), "cannot read "));
  put(folder.at("many.pfm"), "PF\n30000 30000\n-1.0\n");
  CHECK(contains(input_error([&] { (void)read_image(folder.at("many.pfm")); }), "cannot read "));
  put(folder.at("many.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n");
  CHECK(contains(input_error([&] { (void)read_image(folder.at("many.hdr")); }), "cannot read "));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  CHECK(usage.ru_maxrss < 2'000'000);  // KiB; the picture alone would take ten million
}

TEST_CASE("reading and writing start no threads") {
  const TemporaryFolder folder;
  const int before = threads_of_process();
  write_exr(folder.at("a.exr"), awkward(960, 540, 6), kFilmChannels, {});
  (void)read_image(folder.at("a.exr"));
  CHECK(threads_of_process() == before);
}

}  // namespace meander
