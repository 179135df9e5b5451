// Flat shading, both sides alike, from a light beside the eye; the triangles' edges where they are wanted.
#include "frame.glsl"

flat in vec3 base_color;
flat in vec3 eye_normal;
flat in float up_normal;
in vec3 eye_position;
in vec3 corner;
layout(location = 0) out vec4 result;

uniform int fill;         // 0: the edges alone
uniform float wire_width;  // pixels; 0: no edges
uniform vec3 wire_color;
uniform float wire_opacity;

const vec3 kLight = vec3(0.30, 0.52, 0.80);  // in eye space, of length 1

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
    vec3 to_eye = projection.w != 0.0 ? vec3(0.0, 0.0, 1.0) : -normalize(eye_position);
    bool is_back = dot(eye_normal, to_eye) < 0.0;
    vec3 normal = is_back ? -eye_normal : eye_normal;
    float up = is_back ? -up_normal : up_normal;
    float key = max(dot(normal, kLight), 0.0);
    float head = max(dot(normal, to_eye), 0.0);
    vec3 ambient = mix(vec3(0.155, 0.145, 0.14), vec3(0.215, 0.225, 0.245), 0.5 + 0.5 * up);
    vec3 shaded = base_color * (ambient + 0.50 * key + 0.26 * head);
    if (fill != 0) {
        result = vec4(srgb_from_linear(mix(shaded, wire_color, edge)), 1.0);
    } else {
        result = vec4(srgb_from_linear(wire_color), max(edge, 0.04));
    }
}
