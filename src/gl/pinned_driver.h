// Under the address sanitizer: graphics drivers stay in memory to the end.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>
#include <link.h>

#include <string_view>

namespace meander {

/// Keeps every loaded OpenGL driver in memory when its users close it, so that what it never frees is
/// reported by its name, which can be suppressed, and not by addresses of nothing.
inline void pin_drivers() {
  const auto pin = [](dl_phdr_info* library, std::size_t, void*) {
    const std::string_view name = library->dlpi_name;
    if (name.find("_dri.so") != name.npos || name.find("libGL") != name.npos) {
      dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    }
    return 0;
  };
  dl_iterate_phdr(pin, nullptr);
}

}  // namespace meander
#else
namespace meander {
/// Nothing to do without the sanitizer.
inline void pin_drivers() {}
}  // namespace meander
#endif
