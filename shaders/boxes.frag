uniform float opacity;

in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = vec4(color.rgb, color.a * opacity); }
