// Flat shading, both sides alike, from a light beside the eye; the triangles' edges where they are wanted.
#include "frame.glsl"

flat in uvec3 triangle;  // colour, normal, and how it stands out
in vec3 eye_position;
in vec3 corner;
layout(location = 0) out vec4 result;

uniform vec3 red_color;
uniform vec3 selection_color;
uniform vec3 shared_color;
uniform vec3 scene_up;
uniform int fill;         // 0: the edges alone
uniform float wire_width;  // pixels; 0: no edges
uniform vec3 wire_color;
uniform float wire_opacity;

const vec3 kLight = vec3(0.30, 0.52, 0.80);  // in eye space, of length 1

const float kSharedStrength = 0.6;  // often all triangles are shared: their own colours show through

vec3 base_color() {
    if (triangle.z == 1u) return red_color;
    if (triangle.z == 2u) return selection_color;
    vec3 own = linear_from_srgb(unpackUnorm4x8(triangle.x).rgb);
    return triangle.z == 3u ? mix(own, shared_color, kSharedStrength) : own;
}

// The unit vector of octahedral coordinates: Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014.
vec3 unpack_normal(uint bits) {
    vec2 e = unpackSnorm2x16(bits);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) {
        vec2 signs = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
        n.xy = (1.0 - abs(n.yx)) * signs;
    }
    return normalize(n);
}

// How much of the pixel an edge covers. Fades where the triangle is only a few pixels high: a dense mesh would
// be all edges.
float edge_coverage() {
    vec3 per_pixel = max(fwidth(corner), vec3(1e-9));
    vec3 distances = corner / per_pixel;
    float nearest = min(distances.x, min(distances.y, distances.z));
    float height = 1.0 / max(per_pixel.x, max(per_pixel.y, per_pixel.z));
    float fade = smoothstep(1.5, 12.0, height);
    return fade * (1.0 - smoothstep(0.5 * wire_width - 0.5, 0.5 * wire_width + 0.5, nearest));
}

void main() {
    float edge = wire_width > 0.0 ? wire_opacity * edge_coverage() : 0.0;
    if (fill == 0) {
        result = vec4(srgb_from_linear(wire_color), max(edge, 0.04));
        return;
    }
    vec3 scene_normal = unpack_normal(triangle.y);
    vec3 normal = mat3(view) * scene_normal;
    vec3 to_eye = projection.w != 0.0 ? vec3(0.0, 0.0, 1.0) : -normalize(eye_position);
    float facing = dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
    float up = facing * dot(scene_normal, scene_up);
    float key = max(facing * dot(normal, kLight), 0.0);
    float head = facing * dot(normal, to_eye);
    vec3 ambient = mix(vec3(0.155, 0.145, 0.14), vec3(0.215, 0.225, 0.245), 0.5 + 0.5 * up);
    vec3 shaded = base_color() * (ambient + 0.50 * key + 0.26 * head);
    result = vec4(srgb_from_linear(mix(shaded, wire_color, edge)), 1.0);
}
