# The distribution's CMake package for OpenImageIO 2.4 names an include folder of OpenCV that it does not install;
# its pkg-config file is sound.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(OpenImageIO QUIET IMPORTED_TARGET GLOBAL OpenImageIO>=2.4)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO REQUIRED_VARS OpenImageIO_LINK_LIBRARIES
                                  VERSION_VAR OpenImageIO_VERSION)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO ALIAS PkgConfig::OpenImageIO)
endif()
