// The surface, three vertices for each triangle, with one colour and one normal for each.
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(std430, binding = 0) readonly buffer Triangles { uvec2 triangles[]; };  // sRGB colour; normal
layout(std430, binding = 1) readonly buffer Marks { uint marks[]; };           // four bits for each triangle

uniform int show_red;
uniform int show_shared;
uniform int selected;  // triangle; -1: none

const uint kSplitMark = 1u, kSharedMark = 2u, kHiddenMark = 4u;
const uint kPlain = 0u, kRed = 1u, kSelected = 2u, kShared = 3u;

flat out uvec3 triangle;  // colour, normal, and which of these it is
out vec3 eye_position;
out vec3 corner;  // barycentric coordinates

void main() {
    int index = gl_VertexID / 3;
    uint mark = (marks[index >> 3] >> uint(4 * (index & 7))) & 15u;
    uint kind = kPlain;
    if (show_shared != 0 && (mark & kSharedMark) != 0u) kind = kShared;
    if (show_red != 0 && (mark & kSplitMark) != 0u) kind = kRed;
    if (index == selected) kind = kSelected;
    triangle = uvec3(triangles[index], kind);
    eye_position = (view * vec4(position, 1.0)).xyz;
    corner = vec3(0.0);
    corner[gl_VertexID % 3] = 1.0;
    gl_Position = (mark & kHiddenMark) != 0u ? vec4(0.0, 0.0, -1.0, 1.0) : project(eye_position);
}
