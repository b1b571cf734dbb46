# OSMesa has no CMake package; its pkg-config file names the library, which exports the GL entry points itself.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(OSMesa QUIET IMPORTED_TARGET GLOBAL osmesa)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OSMesa REQUIRED_VARS OSMesa_LINK_LIBRARIES VERSION_VAR OSMesa_VERSION)
if(OSMesa_FOUND AND NOT TARGET OSMesa::OSMesa)
  add_library(OSMesa::OSMesa ALIAS PkgConfig::OSMesa)
endif()
