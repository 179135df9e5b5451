// The edges of boxes as quads of constant width in pixels: 12 edges of four vertices each.
#include "frame.glsl"
#include "box_instance.glsl"

layout(std430, binding = 4) readonly buffer Drawn { float drawn[]; };

const int kByLevel = 0, kByReferences = 1, kBySahShare = 2, kByPrimitive = 3, kOneColor = 4;
const int kPaletteSize = 64;
const float kBias = 6.0;  // pixels towards the eye, so that an edge on a surface stays visible

uniform int coloring;
uniform vec2 scale;  // value of the palette's first and last colour
uniform int is_logarithmic;
uniform vec3 palette[kPaletteSize];
uniform vec3 one_color;
uniform float line_width;  // pixels
uniform float casing;      // pixels on each side of the line
uniform float depth_fade;  // share of their opacity that the farthest boxes lose
uniform float size_fade;   // the same, of boxes of a few pixels

out vec4 color;
noperspective out float across;  // pixels from the middle of the line

vec3 palette_color(float value) {
    float x = 0.0;
    if (is_logarithmic != 0) {
        x = value > scale.x ? log(value / scale.x) / log(scale.y / scale.x) : 0.0;
    } else {
        x = value > scale.x ? (value - scale.x) / (scale.y - scale.x) : 0.0;
    }
    float position = clamp(x, 0.0, 1.0) * float(kPaletteSize - 1);
    int first = min(int(position), kPaletteSize - 2);
    return mix(palette[first], palette[first + 1], position - float(first));
}

// Neighbouring primitives get clearly different hues.
vec3 hue_color(uint prim) {
    float hue = fract(float(prim % 8192u) * 0.61803398875);
    vec3 rgb = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return linear_from_srgb(mix(vec3(1.0), rgb, 0.65));
}

vec3 box_color(NodeBox box) {
    if (coloring == kByLevel) return palette_color(float(box.word >> 1));
    if (coloring == kByReferences) return palette_color(box.references);
    if (coloring == kBySahShare) return palette_color(box.sah_share);
    if (coloring == kByPrimitive) return hue_color(box.word);
    return one_color;
}

// Boxes of a few pixels would hide all behind them, and each other.
float opacity_of(NodeBox box, float depth) {
    float pixels = length(box.upper - box.lower) / pixel_size(max(depth, nearest_depth()));
    float size_opacity = 1.0 - size_fade * (1.0 - smoothstep(2.0, 40.0, pixels));
    return size_opacity * (1.0 - depth_fade * smoothstep(viewport.z, viewport.w, depth));
}

void main() {
    NodeBox box = READ_BOX(drawn, uint(gl_InstanceID));
    int edge = gl_VertexID >> 2;
    int quad_corner = gl_VertexID & 3;
    int axis = edge >> 2;
    vec3 from = box.lower;
    from[(axis + 1) % 3] = (edge & 1) != 0 ? box.upper[(axis + 1) % 3] : box.lower[(axis + 1) % 3];
    from[(axis + 2) % 3] = (edge & 2) != 0 ? box.upper[(axis + 2) % 3] : box.lower[(axis + 2) % 3];
    vec3 to = from;
    to[axis] = box.upper[axis];

    vec3 a = (view * vec4(from, 1.0)).xyz;
    vec3 b = (view * vec4(to, 1.0)).xyz;
    float nearest = nearest_depth();
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
    color = vec4(0.0);
    across = 0.0;
    if (-a.z < nearest && -b.z < nearest) return;
    if (-a.z < nearest) a = mix(a, b, (nearest + a.z) / (a.z - b.z));
    if (-b.z < nearest) b = mix(b, a, (nearest + b.z) / (b.z - a.z));

    vec4 clip_a = project(a), clip_b = project(b);
    vec2 pixel_a = 0.5 * viewport.xy * clip_a.xy / clip_a.w;
    vec2 pixel_b = 0.5 * viewport.xy * clip_b.xy / clip_b.w;
    vec2 along = pixel_b - pixel_a;
    float pixels = length(along);
    along = pixels > 1e-4 ? along / pixels : vec2(1.0, 0.0);
    bool is_end = (quad_corner & 1) != 0;
    float side = (quad_corner & 2) != 0 ? 1.0 : -1.0;
    float reach = 0.5 * line_width + casing;
    across = side * reach;
    vec2 offset = side * reach * vec2(-along.y, along.x) + 0.5 * line_width * (is_end ? along : -along);

    vec3 eye = is_end ? b : a;
    vec4 clip = is_end ? clip_b : clip_a;
    vec4 pulled = project(eye + vec3(0.0, 0.0, kBias * pixel_size(-eye.z)));
    gl_Position = vec4(clip.xy + offset * 2.0 / viewport.xy * clip.w, pulled.z / pulled.w * clip.w, clip.w);
    color = vec4(srgb_from_linear(box_color(box)), opacity_of(box, -eye.z));
}
