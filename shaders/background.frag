// A soft gradient from top to bottom; colours as sRGB.
uniform vec3 top;
uniform vec3 bottom;

in vec2 texel;
layout(location = 0) out vec4 result;

void main() { result = vec4(mix(bottom, top, texel.y), 1.0); }
