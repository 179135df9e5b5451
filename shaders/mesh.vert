// The surface, three vertices for each triangle, with one colour and one normal for each.
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(std430, binding = 0) readonly buffer Triangles { uvec2 triangles[]; };  // sRGB colour; normal
layout(std430, binding = 1) readonly buffer Split { uint split[]; };           // a bit for each triangle

uniform int show_red;
uniform int selected;  // triangle; -1: none
uniform vec3 red_color;
uniform vec3 selection_color;
uniform vec3 scene_up;

flat out vec3 base_color;  // linear
flat out vec3 eye_normal;
flat out float up_normal;  // of the normal along the way up
out vec3 eye_position;
out vec3 corner;  // barycentric coordinates

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

void main() {
    int triangle = gl_VertexID / 3;
    uvec2 data = triangles[triangle];
    bool is_split = ((split[triangle >> 5] >> uint(triangle & 31)) & 1u) != 0u;
    vec3 normal = unpack_normal(data.y);
    base_color = linear_from_srgb(unpackUnorm4x8(data.x).rgb);
    if (show_red != 0 && is_split) base_color = red_color;
    if (triangle == selected) base_color = selection_color;
    eye_normal = mat3(view) * normal;
    up_normal = dot(normal, scene_up);
    vec3 eye = (view * vec4(position, 1.0)).xyz;
    eye_position = eye;
    corner = vec3(0.0);
    corner[gl_VertexID % 3] = 1.0;
    gl_Position = project(eye);
}
