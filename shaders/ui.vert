// Dear ImGui's vertices: positions in its display's coordinates, y downwards.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 vertex_color;

uniform vec4 display;  // position and size

out vec2 texel;
out vec4 color;

void main() {
    vec2 at = (position - display.xy) / display.zw;
    texel = uv;
    color = vertex_color;
    gl_Position = vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
}
