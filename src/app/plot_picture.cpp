#include "app/plot_picture.h"

#include "display/interface_view.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "ui/interface.h"

namespace meander {

Image8 plot_picture(const Plot& plot, int width, int height) {
  const Offscreen context(1, 1);
  const Functions& gl = context.functions();
  FrameShape shape;
  shape.pixels_wide = width;
  shape.pixels_high = height;
  shape.scale = 2;
  Interface interface(shape.scale);
  InterfaceView view(gl);
  const Framebuffer target(gl, width, height);
  target.bind(width, height);
  interface.begin_frame(shape);
  const FontBitmap font = interface.font();
  interface.set_font_texture(view.upload_font(font.width, font.height, font.coverage));
  draw_plot(plot, shape);
  view.draw(*interface.end_frame(), width, height);
  return target.read(width, height);
}

}  // namespace meander
