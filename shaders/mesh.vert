// The surface, three vertices for each triangle, with one colour and one normal for each.
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(std430, binding = 0) readonly buffer Triangles { uvec2 triangles[]; };  // sRGB colour; normal
layout(std430, binding = 1) readonly buffer Split { uint split[]; };           // a bit for each triangle

uniform int show_red;
uniform int selected;  // triangle; -1: none

const uint kPlain = 0u, kRed = 1u, kSelected = 2u;

flat out uvec3 triangle;  // colour, normal, and which of the three it is
out vec3 eye_position;
out vec3 corner;  // barycentric coordinates

void main() {
    int index = gl_VertexID / 3;
    bool is_split = ((split[index >> 5] >> uint(index & 31)) & 1u) != 0u;
    uint kind = index == selected ? kSelected : (show_red != 0 && is_split ? kRed : kPlain);
    triangle = uvec3(triangles[index], kind);
    eye_position = (view * vec4(position, 1.0)).xyz;
    corner = vec3(0.0);
    corner[gl_VertexID % 3] = 1.0;
    gl_Position = project(eye_position);
}
