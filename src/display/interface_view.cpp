#include "display/interface_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include "display/shaders.h"
#include "gl/state.h"

namespace meander {
namespace {

constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;

Program interface_program(const Functions& gl) {
  return Program(gl, shader_source("interface.vert"), shader_source("interface.frag"));
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

std::span<ImDrawList* const> lists_of(const ImDrawData& data) {
  return {data.CmdLists, static_cast<std::size_t>(data.CmdListsCount)};
}

// Where the attributes of interface.vert are in a vertex of the bound buffer.
void describe_vertices(const Functions& gl) {
  constexpr auto stride = static_cast<GLsizei>(sizeof(ImDrawVert));
  for (const GLuint attribute : {0u, 1u, 2u}) gl.enable_vertex_attrib_array(attribute);
  gl.vertex_attrib_pointer(0, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(ImDrawVert, pos)));
  gl.vertex_attrib_pointer(1, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(ImDrawVert, uv)));
  gl.vertex_attrib_pointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(ImDrawVert, col)));
}

struct Clip {
  int x0, y0, x1, y1;  // pixels, y down
  [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
};

Clip clip_of(const ImDrawCmd& command, const ImDrawData& data, int width, int height) {
  const auto pixel = [](float points, float origin, float scale, int limit) {
    return static_cast<int>(std::clamp((points - origin) * scale, 0.0f, static_cast<float>(limit)));
  };
  const ImVec2 origin = data.DisplayPos;
  const ImVec2 scale = data.FramebufferScale;
  return {pixel(command.ClipRect.x, origin.x, scale.x, width),
          pixel(command.ClipRect.y, origin.y, scale.y, height),
          pixel(command.ClipRect.z, origin.x, scale.x, width),
          pixel(command.ClipRect.w, origin.y, scale.y, height)};
}

}  // namespace

InterfaceView::InterfaceView(const Functions& gl)
    : gl_(&gl),
      program_(interface_program(gl)),
      corners_(gl),
      vertices_(gl, GL_ARRAY_BUFFER),
      indices_(gl, GL_ELEMENT_ARRAY_BUFFER),
      font_(gl) {
  corners_.bind();
  vertices_.bind();
  indices_.bind();  // a vertex array remembers its indices' buffer
  describe_vertices(gl);
  expect_no_error(gl, "making the interface's vertices");
}

void* InterfaceView::upload_font(int width, int height, const std::uint8_t* coverage) {
  font_.upload_coverage(width, height, coverage);
  return texture_id(font_);
}

void* InterfaceView::texture_id(const Picture& picture) {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(picture.id()));
}

void InterfaceView::begin(const ImDrawData& data, int width, int height) const {
  const Functions& gl = *gl_;
  reset_state(gl);
  gl.viewport(0, 0, width, height);
  gl.enable(GL_BLEND);
  gl.blend_equation(GL_FUNC_ADD);
  gl.blend_func_separate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.enable(GL_SCISSOR_TEST);
  program_.use();
  program_.set("picture", 0);
  const float x = 2 * data.FramebufferScale.x / static_cast<float>(width);
  const float y = -2 * data.FramebufferScale.y / static_cast<float>(height);
  program_.set("to_clip", std::array{x, y, -1 - data.DisplayPos.x * x, 1 - data.DisplayPos.y * y});
  corners_.bind();
  gl.active_texture(GL_TEXTURE0);
}

void InterfaceView::fill(const ImDrawData& data) const {
  vertices_.renew(static_cast<std::size_t>(data.TotalVtxCount) * sizeof(ImDrawVert));
  indices_.renew(static_cast<std::size_t>(data.TotalIdxCount) * sizeof(ImDrawIdx));
  std::size_t vertex_end = 0;
  std::size_t index_end = 0;
  for (const ImDrawList* list : lists_of(data)) {
    const std::size_t vertex_bytes = list->VtxBuffer.size_in_bytes();
    const std::size_t index_bytes = list->IdxBuffer.size_in_bytes();
    vertices_.write(vertex_end, vertex_bytes, list->VtxBuffer.Data);
    indices_.write(index_end, index_bytes, list->IdxBuffer.Data);
    vertex_end += vertex_bytes;
    index_end += index_bytes;
  }
}

void InterfaceView::draw(const ImDrawData& data, int width, int height) const {
  assert(width > 0 && height > 0);
  if (data.TotalIdxCount == 0) return;
  const Functions& gl = *gl_;
  begin(data, width, height);
  fill(data);
  std::size_t first_index = 0;
  int first_vertex = 0;
  for (const ImDrawList* list : lists_of(data)) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      if (command.UserCallback == ImDrawCallback_ResetRenderState) {
        begin(data, width, height);
        continue;
      }
      assert(command.UserCallback == nullptr && "nobody but this draws");
      const Clip clip = clip_of(command, data, width, height);
      if (clip.empty()) continue;
      gl.scissor(clip.x0, height - clip.y1, clip.x1 - clip.x0, clip.y1 - clip.y0);
      gl.bind_texture(GL_TEXTURE_2D,
                      static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
      gl.draw_elements_base_vertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
                                   offset((first_index + command.IdxOffset) * sizeof(ImDrawIdx)),
                                   first_vertex + static_cast<GLint>(command.VtxOffset));
    }
    first_index += static_cast<std::size_t>(list->IdxBuffer.Size);
    first_vertex += list->VtxBuffer.Size;
  }
  reset_state(gl);
  expect_no_error(gl, "drawing the interface");
}

void InterfaceView::reload() { program_ = interface_program(*gl_); }

}  // namespace meander
