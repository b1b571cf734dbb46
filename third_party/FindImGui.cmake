# Dear ImGui has no CMake package. Only its core is used: the back ends that the distribution puts into the same static
# library stay out of the program, and with them what they would link.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(ImGui QUIET IMPORTED_TARGET GLOBAL imgui>=1.86)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ImGui REQUIRED_VARS ImGui_LINK_LIBRARIES VERSION_VAR ImGui_VERSION)
if(ImGui_FOUND AND NOT TARGET ImGui::ImGui)
  add_library(ImGui::ImGui ALIAS PkgConfig::ImGui)
endif()
