// Pieces of outlines, or the edges of boxes, as quads of constant width in pixels: 12 segments of four vertices
// each.
#include "frame.glsl"
#include "box_instance.glsl"

layout(std430, binding = 4) readonly buffer Drawn { uint drawn[]; };

const int kByLevel = 0, kByReferences = 1, kBySahShare = 2, kByPrimitive = 3, kOneColor = 4,
          kByVisits = 5;
const int kPaletteSize = 64;
const float kBias = 6.0;  // pixels towards the eye, so that an edge on a surface stays visible
const float kDotSize = 4.0;  // line widths: a smaller box is one square, since its edges would fill it

uniform int coloring;
uniform vec2 scale;  // value of the palette's first and last colour
uniform int is_logarithmic;
uniform vec3 palette[kPaletteSize];
uniform vec3 one_color;
uniform vec3 empty_color;      // of empty cells
uniform vec3 unvisited_color;
uniform uint piece_words;  // of a piece
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

const float kUnvisitedOpacity = 0.3;

vec3 box_color(NodeBox box, uint visits) {
    if (coloring == kByPrimitive) return hue_color(box.word);
    if (coloring == kOneColor) return one_color;
    if (coloring == kByVisits) return visits > 0u ? palette_color(float(visits)) : unvisited_color;
    if (is_empty(box)) return empty_color;
    if (coloring == kByLevel) return palette_color(float(level_of(box)));
    if (coloring == kByReferences) return palette_color(box.references);
    return palette_color(box.sah_share);
}

// Boxes of a few pixels would hide all behind them, and each other: they are fainter, and have no casing.
float size_on_screen(NodeBox box, float depth) {
    return length(box.upper - box.lower) / pixel_size(max(depth, nearest_depth()));
}

float opacity_of(float size, float depth) {
    float size_opacity = 1.0 - size_fade * (1.0 - smoothstep(2.0, 40.0, size));
    return size_opacity * (1.0 - depth_fade * smoothstep(viewport.z, viewport.w, depth));
}

// Clips the segment to what lies before the eye; false if nothing does.
bool clip_near(inout vec3 a, inout vec3 b) {
    float nearest = nearest_depth();
    if (-a.z < nearest && -b.z < nearest) return false;
    if (-a.z < nearest) a = mix(a, b, (nearest + a.z) / (a.z - b.z));
    if (-b.z < nearest) b = mix(b, a, (nearest + b.z) / (b.z - a.z));
    return true;
}

void main() {
    uint piece = piece_words * uint(gl_InstanceID);
    NodeBox box = READ_BOX(drawn, piece);
    uint visits = drawn[piece + 9u] & kVisitsOfMark;
    uint word = drawn[piece + 10u];
    uint segments = word & kPieceSegments;
    int edge = gl_VertexID >> 2;
    bool is_end = (gl_VertexID & 1) != 0;
    float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // outside the view
    color = vec4(0.0);
    across = 0.0;

    vec3 center = (view * vec4(0.5 * (box.lower + box.upper), 1.0)).xyz;
    float size = size_on_screen(box, -center.z);
    bool is_dot = size < kDotSize * line_width;
    if (is_dot ? edge != 0 || (word & kFirstPiece) == 0u : segments > 0u && uint(edge) >= segments) return;

    int axis = edge >> 2;
    vec3 from = box.lower;
    from[(axis + 1) % 3] = (edge & 1) != 0 ? box.upper[(axis + 1) % 3] : box.lower[(axis + 1) % 3];
    from[(axis + 2) % 3] = (edge & 2) != 0 ? box.upper[(axis + 2) % 3] : box.lower[(axis + 2) % 3];
    vec3 to = from;
    to[axis] = box.upper[axis];
    if (segments > 0u) {
        uint at = piece + kPieceHeadWords + kSegmentWords * uint(edge);
        from = READ_VEC3(drawn, at);
        to = READ_VEC3(drawn, at + 3u);
    }
    vec3 a = is_dot ? center : (view * vec4(from, 1.0)).xyz;
    vec3 b = is_dot ? center : (view * vec4(to, 1.0)).xyz;
    if (!clip_near(a, b)) return;

    vec4 clip_a = project(a), clip_b = project(b);
    vec2 pixel_a = 0.5 * viewport.xy * clip_a.xy / clip_a.w;
    vec2 pixel_b = 0.5 * viewport.xy * clip_b.xy / clip_b.w;
    vec2 along = pixel_b - pixel_a;
    float pixels = length(along);
    along = pixels > 1e-4 ? along / pixels : vec2(1.0, 0.0);
    vec3 eye = is_end ? b : a;
    vec4 clip = is_end ? clip_b : clip_a;
    // A dot is about as wide as the box looks: most boxes are seen at an angle.
    float half_width = is_dot ? 0.5 * max(0.7 * size, 1.0) : 0.5 * line_width;
    float reach = half_width + casing * smoothstep(8.0, 32.0, size);
    across = is_dot ? 0.0 : side * reach;
    vec2 offset = side * reach * vec2(-along.y, along.x) + half_width * (is_end ? along : -along);
    vec4 pulled = project(eye + vec3(0.0, 0.0, kBias * pixel_size(-eye.z)));
    gl_Position = vec4(clip.xy + offset * 2.0 / viewport.xy * clip.w, pulled.z / pulled.w * clip.w, clip.w);
    float strength = coloring == kByVisits && visits == 0u ? kUnvisitedOpacity : 1.0;
    color = vec4(srgb_from_linear(box_color(box, visits)), strength * opacity_of(size, -eye.z));
}
