layout(binding = 0) uniform sampler2D atlas;

in vec2 texel;
in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = color * texture(atlas, texel); }
