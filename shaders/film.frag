#version 330 core
// A film to display-encoded pixels, row 0 of the film at the top. Compiled once for each way of looking at it:
// VIEW, TONE, FILTER, OTHER_FILTER and DIFFERENCE are defined after the first line.

#define VIEW_IMAGE 0
#define VIEW_NOISE 1
#define VIEW_SAMPLES 2
#define VIEW_SCATTERINGS 3
#define VIEW_LENGTH 4
#define VIEW_NORMALS 5
#define VIEW_LUMINANCE 6
#define VIEW_CLIPPING 7

#define NEAREST 0
#define BILINEAR 1
#define AREA 2

uniform sampler2D radiance;  // R G B, samples
uniform sampler2D error;     // variance of the mean R G B, mean number of scatterings
uniform sampler2D features;  // mean length, normal
uniform sampler2D other;     // R G B of the film to compare with
uniform sampler2D colors;    // the colour scale, 256 wide
uniform float scale;         // 2 to the exposure in stops
uniform vec2 range;          // of the logarithmic scale: log2 of its low end, 1 over its length
uniform vec4 placement;      // the film's lower left corner in pixels, film pixels per pixel in x and y
uniform vec4 other_placement;

out vec4 color;

const vec3 kNoData = vec3(26.0) / 255.0;
const vec3 kAbove = vec3(255.0, 64.0, 26.0) / 255.0;
const vec3 kBelow = vec3(38.0, 115.0, 255.0) / 255.0;

// The bits are tested, since drivers may assume that no number is a NaN.
bool is_nan(float value) { return (floatBitsToUint(value) & 0x7fffffffu) > 0x7f800000u; }

float finite_or_zero(float value) { return is_nan(value) ? 0.0 : value; }

// What can be multiplied by a weight of zero.
vec4 weighable(vec4 v) {
  vec4 known = vec4(finite_or_zero(v.x), finite_or_zero(v.y), finite_or_zero(v.z), finite_or_zero(v.w));
  return clamp(known, vec4(-1e37), vec4(1e37));
}

vec4 texel(sampler2D plane, ivec2 at) {
  ivec2 size = textureSize(plane, 0);
  ivec2 inside = clamp(at, ivec2(0), size - 1);
  return texelFetch(plane, ivec2(inside.x, size.y - 1 - inside.y), 0);
}

vec4 bilinear(sampler2D plane, vec2 at) {
  vec2 shifted = at - 0.5;
  vec2 base = floor(shifted);
  vec2 part = shifted - base;
  ivec2 corner = ivec2(base);
  vec4 lower = mix(weighable(texel(plane, corner)), weighable(texel(plane, corner + ivec2(1, 0))), part.x);
  vec4 upper = mix(weighable(texel(plane, corner + ivec2(0, 1))), weighable(texel(plane, corner + ivec2(1, 1))), part.x);
  return mix(lower, upper, part.y);
}

// The mean over the square of one pixel, `size` film pixels wide.
vec4 area_mean(sampler2D plane, vec2 at, vec2 size) {
  vec2 limit = vec2(textureSize(plane, 0));
  vec2 low = max(at - 0.5 * size, vec2(0.0));
  vec2 high = max(min(at + 0.5 * size, limit), low + 1e-4);
  vec4 sum = vec4(0.0);
  for (float y = floor(low.y); y < high.y; y += 1.0) {
    float height = min(high.y, y + 1.0) - max(low.y, y);
    for (float x = floor(low.x); x < high.x; x += 1.0) {
      float width = min(high.x, x + 1.0) - max(low.x, x);
      sum += width * height * weighable(texel(plane, ivec2(x, y)));
    }
  }
  return sum / ((high.x - low.x) * (high.y - low.y));
}

vec4 filtered(sampler2D plane, vec4 where, int filter_kind) {
  vec2 at = (gl_FragCoord.xy - where.xy) * where.zw;
  if (filter_kind == NEAREST) return texel(plane, ivec2(floor(at)));
  if (filter_kind == BILINEAR) return bilinear(plane, at);
  return area_mean(plane, at, where.zw);
}

vec4 film_value(sampler2D plane) { return filtered(plane, placement, FILTER); }

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

// K. Narkowicz 2015, its input scaled so that 0.18 stays 0.18: the same as math/tone.h.
float tone_curve(float x) {
#if TONE == 1
  if (x <= 0.0) return x;
  float y = min(x, 1e6) * 0.7231535;
  return y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14);
#else
  return x;
#endif
}

float display_value(float linear) {
  float x = clamp(tone_curve(finite_or_zero(linear) * scale), 0.0, 1.0);
  return floor(encode_srgb(x) * 255.0 + 0.5) / 255.0;  // rounded here, not as the driver likes
}

vec3 display_values(vec3 linear) {
  return vec3(display_value(linear.r), display_value(linear.g), display_value(linear.b));
}

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec3 scale_color(float value) {
  if (is_nan(value) || value <= 0.0) return kNoData;
  float place = clamp((log2(value) - range.x) * range.y, 0.0, 1.0);
  return texelFetch(colors, ivec2(int(place * 255.0 + 0.5), 0), 0).rgb;
}

float relative_error(vec3 mean, vec3 variance) {
  vec3 ratio = variance / (mean * mean + 1e-4);
  return sqrt((ratio.r + ratio.g + ratio.b) / 3.0);
}

vec3 clipping(vec3 linear) {
  if (is_nan(linear.r) || is_nan(linear.g) || is_nan(linear.b)) return kBelow;
  vec3 shown = vec3(tone_curve(linear.r * scale), tone_curve(linear.g * scale), tone_curve(linear.b * scale));
  if (max(shown.r, max(shown.g, shown.b)) > 1.0) return kAbove;
  if (min(shown.r, min(shown.g, shown.b)) < 0.0) return kBelow;
  return vec3(display_value(luminance(linear)));
}

vec3 normal_color(vec3 normal) {
  float squared = dot(normal, normal);
  if (is_nan(squared) || squared == 0.0) return kNoData;
  return floor(clamp(normal * 0.5 + 0.5, 0.0, 1.0) * 255.0 + 0.5) / 255.0;
}

vec3 view() {
#if DIFFERENCE
  vec3 difference = film_value(radiance).rgb - filtered(other, other_placement, OTHER_FILTER).rgb;
  return display_values(abs(difference));
#elif VIEW == VIEW_NOISE
  return scale_color(relative_error(film_value(radiance).rgb, film_value(error).rgb));
#elif VIEW == VIEW_SAMPLES
  return scale_color(film_value(radiance).a);
#elif VIEW == VIEW_SCATTERINGS
  return scale_color(film_value(error).a);
#elif VIEW == VIEW_LENGTH
  return scale_color(film_value(features).x);
#elif VIEW == VIEW_NORMALS
  return normal_color(film_value(features).yzw);
#elif VIEW == VIEW_LUMINANCE
  return vec3(display_value(luminance(film_value(radiance).rgb)));
#elif VIEW == VIEW_CLIPPING
  return clipping(film_value(radiance).rgb);
#else
  return display_values(film_value(radiance).rgb);
#endif
}

void main() { color = vec4(view(), 1.0); }
