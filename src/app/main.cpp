#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "app/command_line.h"
#include "core/error.h"

namespace {

// What came from a file may hold control characters; a message stays one line.
std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f) {
      line += c;
      continue;
    }
    constexpr char kDigits[] = "0123456789abcdef";
    line += c == '\n' ? "\\n" : std::string("\\x") + kDigits[code >> 4] + kDigits[code & 15];
  }
  return line;
}

// oneTBB says so in words alone.
bool lacks_thread(const std::exception& error) {
  const auto* coded = dynamic_cast<const std::system_error*>(&error);
  return coded ? coded->code() == std::errc::resource_unavailable_try_again
               : std::string_view(error.what()).starts_with("pthread_create");
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a failed write, not a death
  try {
    const int code = meander::run_command_line(argc, argv);
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw meander::Error(meander::Fault::runtime, "cannot write to standard output");
    return code;
  } catch (const meander::Error& error) {
    std::cerr << "meander: " << one_line(error.what()) << '\n';
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    std::cerr << "meander: out of memory\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "meander: " << (lacks_thread(error) ? "no memory, or no thread, for another thread: " : "")
              << error.what() << '\n';
    return 3;
  }
}
