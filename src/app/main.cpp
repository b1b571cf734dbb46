#include <iostream>
#include <new>

#include "app/command_line.h"
#include "core/error.h"

int main(int argc, char** argv) {
  try {
    return meander::run_command_line(argc, argv);
  } catch (const meander::Error& error) {
    std::cerr << "meander: " << error.what() << '\n';
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    std::cerr << "meander: out of memory\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "meander: " << error.what() << '\n';
    return 3;
  }
}
