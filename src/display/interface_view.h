// Draws the interface: Dear ImGui's vertex lists through our own GL objects, in a window and off-screen
// alike.
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/picture.h"
#include "gl/program.h"
#include "gl/vertex_array.h"

struct ImDrawData;

namespace meander {

class InterfaceView {
 public:
  /// Needs its context current, here and in every call. Error (runtime) when the shaders are missing or do
  /// not compile.
  explicit InterfaceView(const Functions& gl);

  /// Takes the font atlas, one byte of coverage a pixel. The ImTextureID to hand to ImFontAtlas::SetTexID.
  void* upload_font(int width, int height, const std::uint8_t* coverage);
  /// The ImTextureID by which vertex lists name a picture. The picture must live until they are drawn.
  [[nodiscard]] static void* texture_id(const Picture& picture);

  /// Draws over what is in the bound framebuffer, all of its `width` x `height` pixels; points become pixels
  /// by the data's own framebuffer scale. Colours are display-encoded already.
  void draw(const ImDrawData& data, int width, int height) const;

  /// Compiles the shaders anew from their files. Error (runtime) with the file and the driver's log; the old
  /// ones go on then.
  void reload();

 private:
  void begin(const ImDrawData& data, int width, int height) const;
  void fill(const ImDrawData& data) const;

  const Functions* gl_;
  Program program_;
  VertexArray corners_;
  Buffer vertices_;
  Buffer indices_;
  Picture font_;
};

}  // namespace meander
