// A picture, its row 0 on top.
layout(binding = 0) uniform sampler2D picture;
uniform float opacity;

in vec2 texel;
layout(location = 0) out vec4 result;

void main() { result = vec4(texture(picture, vec2(texel.x, 1.0 - texel.y)).rgb, opacity); }
