#include "gl/offscreen.h"

#include <GL/osmesa.h>

#include <array>
#include <cassert>
#include <string>

#include "core/error.h"

namespace meander {
namespace {

void* new_context() {
  const std::array<int, 11> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          24,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0};
  void* context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  if (context == nullptr) {
    throw Error(Fault::runtime, "Mesa's off-screen library gives no OpenGL 3.3 core context");
  }
  return context;
}

void* entry_point(const char* name) { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); }

}  // namespace

void Offscreen::Destroy::operator()(void* context) const noexcept {
  const auto mesa = static_cast<OSMesaContext>(context);
  if (OSMesaGetCurrentContext() == mesa) OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  OSMesaDestroyContext(mesa);
}

Offscreen::Offscreen(int width, int height) : width_(width), height_(height), context_(new_context()) {
  assert(width > 0 && height > 0);
  GLint widest = 0;
  GLint highest = 0;
  OSMesaGetIntegerv(OSMESA_MAX_WIDTH, &widest);
  OSMesaGetIntegerv(OSMESA_MAX_HEIGHT, &highest);
  if (width > widest || height > highest) {
    throw Error(Fault::runtime, "an off-screen buffer of " + std::to_string(width) + " x " +
                                    std::to_string(height) + " pixels is too large, Mesa's limit is " +
                                    std::to_string(widest) + " x " + std::to_string(highest));
  }
  buffer_.resize(static_cast<std::size_t>(width) * height * 4);
  make_current();
  functions_ = std::make_unique<Functions>(load_functions(entry_point));
}

void Offscreen::make_current() {
  if (!OSMesaMakeCurrent(static_cast<OSMesaContext>(context_.get()), buffer_.data(), GL_UNSIGNED_BYTE, width_,
                         height_)) {
    throw Error(Fault::runtime, "Mesa cannot draw off-screen into a buffer of " + std::to_string(width_) +
                                    " x " + std::to_string(height_) + " pixels");
  }
}

}  // namespace meander
