#version 330 core
// A vertex of the interface: points from the top left to clip space.

uniform vec4 to_clip;  // scale x, y and offset x, y

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 vertex_color;

out vec2 uv;
out vec4 tint;

void main() {
  uv = texture_position;
  tint = vertex_color;
  gl_Position = vec4(position * to_clip.xy + to_clip.zw, 0.0, 1.0);
}
