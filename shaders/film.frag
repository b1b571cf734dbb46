#version 330 core
// Linear film to a display-encoded pixel, one texel to one pixel, row 0 of the film at the top.

uniform sampler2D film;
uniform float scale;  // 2 to the exposure in stops

out vec4 color;

// NaN becomes 0. The bits are tested, since drivers may assume that no number is a NaN.
float finite_or_zero(float value) {
  return (floatBitsToUint(value) & 0x7fffffffu) > 0x7f800000u ? 0.0 : value;
}

// IEC 61966-2-1 on [0, 1]. Drivers approximate pow; one Newton step on y^12 = x^5 makes them agree.
float encode_srgb(float x) {
  if (x <= 0.0031308) return 12.92 * x;
  float y = pow(x, 1.0 / 2.4);
  float y2 = y * y;
  float y4 = y2 * y2;
  float y11 = y4 * y4 * y2 * y;
  float x2 = x * x;
  y -= (y11 * y - x2 * x2 * x) / (12.0 * y11);
  return 1.055 * y - 0.055;
}

float display_value(float linear) {
  float x = clamp(finite_or_zero(linear) * scale, 0.0, 1.0);
  return floor(encode_srgb(x) * 255.0 + 0.5) / 255.0;  // rounded here, not as the driver likes
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  texel.y = textureSize(film, 0).y - 1 - texel.y;
  vec3 linear = texelFetch(film, texel, 0).rgb;
  color = vec4(display_value(linear.r), display_value(linear.g), display_value(linear.b), 1.0);
}
