#include "gl/offscreen.h"

#include <GL/osmesa.h>
#include <sys/mman.h>

#include <array>
#include <cassert>
#include <string>

#include "core/error.h"

namespace meander {
namespace {

// Mesa and its compiler of shaders die where they get no memory, so a limited process is asked first whether
// it has the address space: nothing is taken.
void refuse_scarce_memory(int width, int height) {
  constexpr std::size_t kContext = std::size_t{512} << 20;
  constexpr std::size_t kPixel = 64;
  const std::size_t needed = kContext + kPixel * static_cast<std::size_t>(width) * height;
  void* space = mmap(nullptr, needed, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (space == MAP_FAILED)
    throw Error(Fault::runtime, "not enough memory for OpenGL off-screen, which may take " +
                                    std::to_string(needed >> 20) + " MiB more");
  munmap(space, needed);
}

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

Offscreen::Offscreen(int width, int height) : width_(width), height_(height) {
  assert(width > 0 && height > 0);
  refuse_scarce_memory(width, height);
  context_.reset(new_context());
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
