// Sorts each box of the selection into the bin of its size on screen, and counts what is not visible.
#include "frame.glsl"
#include "box_instance.glsl"
#include "box_bins.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Boxes { uint boxes[]; };

uniform uint end;          // boxes [0, end) of this chunk are looked at
uniform uint first_level;  // inner nodes above it are not in the selection
uniform uint leaves_above;
uniform uint show_empty;     // empty cells too
uniform uint only_visited;   // boxes that no ray visited are not in the selection

const uint kLargestBin = 255u;
const float kBinsPerOctave = 15.0;

// 0: outside the view; below 1: under a pixel; otherwise the longer side of its outline's box in pixels.
float size_on_screen(NodeBox box) {
    if (any(greaterThan(box.lower, box.upper))) return 0.0;
    vec2 lower = vec2(1e30), upper = vec2(-1e30);
    uint outside_all = 31u;  // planes that every corner is beyond
    bool crosses_near = false;
    for (int corner = 0; corner < 8; ++corner) {
        vec3 at = mix(box.lower, box.upper, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
        vec3 eye = (view * vec4(at, 1.0)).xyz;
        vec4 clip = project(eye);
        bool is_behind = -eye.z < nearest_depth();
        uint outside_one = (clip.x < -clip.w ? 1u : 0u) | (clip.x > clip.w ? 2u : 0u) |
                           (clip.y < -clip.w ? 4u : 0u) | (clip.y > clip.w ? 8u : 0u) | (is_behind ? 16u : 0u);
        outside_all &= outside_one;
        crosses_near = crosses_near || is_behind;
        lower = min(lower, clip.xy / clip.w);
        upper = max(upper, clip.xy / clip.w);
    }
    if (outside_all != 0u) return 0.0;
    if (crosses_near) return 1e30;
    vec2 size = 0.5 * (upper - lower) * viewport.xy;
    return max(max(size.x, size.y), 1e-30);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= end) return;
    NodeBox box = READ_BOX(boxes, kBoxWords * index);
    uint mark = mark_of(index);
    bool is_selected = level_of(box) >= first_level || (leaves_above != 0u && is_leaf(box));
    if ((mark & kHiddenMark) != 0u) is_selected = false;
    if (only_visited != 0u && (mark & kVisitsOfMark) == 0u) is_selected = false;
    uint bin = 0u;
    if (is_selected && show_empty == 0u && is_empty(box)) {
        atomicAdd(empty, 1u);
        is_selected = false;
    }
    if (is_selected) {
        float size = size_on_screen(box);
        if (size == 0.0) {
            atomicAdd(outside, 1u);
        } else if (size < 1.0) {
            atomicAdd(under_pixel, 1u);
        } else {
            bin = 1u + uint(min(log2(size) * kBinsPerOctave, float(kLargestBin) - 1.0));
            atomicAdd(visible, 1u);
            atomicAdd(histogram[bin], piece_count(index));
        }
    }
    bins[index] = bin;
}
