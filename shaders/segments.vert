// A few segments as quads, over the picture: the axis cross.
const int kMostSegments = 16;

uniform vec4 segments[kMostSegments];  // two ends in pixels, (0, 0) the viewport's lower left corner
uniform vec3 colors[kMostSegments];    // sRGB
uniform vec2 viewport_size;            // pixels
uniform float width;                   // pixels

flat out vec3 color;

void main() {
    int index = gl_VertexID / 6;
    int quad_corner = int[6](0, 1, 2, 2, 1, 3)[gl_VertexID % 6];
    vec2 a = segments[index].xy, b = segments[index].zw;
    float pixels = length(b - a);
    vec2 along = pixels > 1e-4 ? (b - a) / pixels : vec2(1.0, 0.0);
    float side = (quad_corner & 2) != 0 ? 1.0 : -1.0;
    bool is_end = (quad_corner & 1) != 0;
    vec2 at = (is_end ? b : a) + 0.5 * width * (side * vec2(-along.y, along.x) + (is_end ? along : -along));
    gl_Position = vec4(2.0 * at / viewport_size - 1.0, 0.0, 1.0);
    color = colors[index];
}
