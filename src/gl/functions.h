// The OpenGL 3.3 core entry points the drawing code calls, as plain data: one table a context, whoever made
// the context, so that a window and an off-screen buffer share every line that draws.
#pragma once

#include <GL/glcorearb.h>

#include <string>

namespace meander {

struct Functions {
  PFNGLACTIVETEXTUREPROC active_texture = nullptr;
  PFNGLATTACHSHADERPROC attach_shader = nullptr;
  PFNGLBINDBUFFERPROC bind_buffer = nullptr;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer = nullptr;
  PFNGLBINDRENDERBUFFERPROC bind_renderbuffer = nullptr;
  PFNGLBINDTEXTUREPROC bind_texture = nullptr;
  PFNGLBINDVERTEXARRAYPROC bind_vertex_array = nullptr;
  PFNGLBLENDEQUATIONPROC blend_equation = nullptr;
  PFNGLBLENDFUNCSEPARATEPROC blend_func_separate = nullptr;
  PFNGLBLITFRAMEBUFFERPROC blit_framebuffer = nullptr;
  PFNGLBUFFERDATAPROC buffer_data = nullptr;
  PFNGLBUFFERSUBDATAPROC buffer_sub_data = nullptr;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status = nullptr;
  PFNGLCLEARPROC clear = nullptr;
  PFNGLCLEARCOLORPROC clear_color = nullptr;
  PFNGLCOMPILESHADERPROC compile_shader = nullptr;
  PFNGLCREATEPROGRAMPROC create_program = nullptr;
  PFNGLCREATESHADERPROC create_shader = nullptr;
  PFNGLDELETEBUFFERSPROC delete_buffers = nullptr;
  PFNGLDELETEFRAMEBUFFERSPROC delete_framebuffers = nullptr;
  PFNGLDELETEPROGRAMPROC delete_program = nullptr;
  PFNGLDELETERENDERBUFFERSPROC delete_renderbuffers = nullptr;
  PFNGLDELETESHADERPROC delete_shader = nullptr;
  PFNGLDELETETEXTURESPROC delete_textures = nullptr;
  PFNGLDELETEVERTEXARRAYSPROC delete_vertex_arrays = nullptr;
  PFNGLDISABLEPROC disable = nullptr;
  PFNGLDRAWARRAYSPROC draw_arrays = nullptr;
  PFNGLDRAWELEMENTSBASEVERTEXPROC draw_elements_base_vertex = nullptr;
  PFNGLENABLEPROC enable = nullptr;
  PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array = nullptr;
  PFNGLFINISHPROC finish = nullptr;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer = nullptr;
  PFNGLGENBUFFERSPROC gen_buffers = nullptr;
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers = nullptr;
  PFNGLGENRENDERBUFFERSPROC gen_renderbuffers = nullptr;
  PFNGLGENTEXTURESPROC gen_textures = nullptr;
  PFNGLGENVERTEXARRAYSPROC gen_vertex_arrays = nullptr;
  PFNGLGETERRORPROC get_error = nullptr;
  PFNGLGETINTEGERVPROC get_integerv = nullptr;
  PFNGLGETPROGRAMINFOLOGPROC get_program_info_log = nullptr;
  PFNGLGETPROGRAMIVPROC get_programiv = nullptr;
  PFNGLGETSHADERINFOLOGPROC get_shader_info_log = nullptr;
  PFNGLGETSHADERIVPROC get_shaderiv = nullptr;
  PFNGLGETSTRINGPROC get_string = nullptr;
  PFNGLGETUNIFORMLOCATIONPROC get_uniform_location = nullptr;
  PFNGLLINKPROGRAMPROC link_program = nullptr;
  PFNGLMAPBUFFERRANGEPROC map_buffer_range = nullptr;
  PFNGLPIXELSTOREIPROC pixel_storei = nullptr;
  PFNGLREADPIXELSPROC read_pixels = nullptr;
  PFNGLRENDERBUFFERSTORAGEPROC renderbuffer_storage = nullptr;
  PFNGLSCISSORPROC scissor = nullptr;
  PFNGLSHADERSOURCEPROC shader_source = nullptr;
  PFNGLTEXIMAGE2DPROC tex_image_2d = nullptr;
  PFNGLTEXPARAMETERIPROC tex_parameteri = nullptr;
  PFNGLTEXPARAMETERIVPROC tex_parameteriv = nullptr;
  PFNGLTEXSUBIMAGE2DPROC tex_sub_image_2d = nullptr;
  PFNGLUNIFORM1FPROC uniform_1f = nullptr;
  PFNGLUNIFORM1IPROC uniform_1i = nullptr;
  PFNGLUNIFORM2FPROC uniform_2f = nullptr;
  PFNGLUNIFORM4FPROC uniform_4f = nullptr;
  PFNGLUNMAPBUFFERPROC unmap_buffer = nullptr;
  PFNGLUSEPROGRAMPROC use_program = nullptr;
  PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer = nullptr;
  PFNGLVIEWPORTPROC viewport = nullptr;
};

/// Looks up one entry point of the current context by its GL name; null when there is none.
using Loader = void* (*)(const char* name);

/// Every entry point of the current context. Error (runtime) naming the first one that is missing.
[[nodiscard]] Functions load_functions(Loader loader);

/// Takes every pending GL error. Error (runtime) "OpenGL: … while <doing>" if there was one.
void expect_no_error(const Functions& gl, const std::string& doing);

/// The value of one integer of the context's state or limits, as glGetIntegerv names it.
[[nodiscard]] int integer(const Functions& gl, GLenum name);

}  // namespace meander
