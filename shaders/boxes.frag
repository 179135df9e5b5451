// A line, and beside it a casing that sets it off from a surface of a like colour. The casing lies a little
// behind the line, so that it does not break a line beside it.
#include "frame.glsl"

layout(depth_less) out float gl_FragDepth;

uniform float opacity;
uniform float line_width;
uniform float casing;
uniform vec3 casing_color;  // sRGB

in vec4 color;
noperspective in float across;
layout(location = 0) out vec4 result;

const float kCasingOpacity = 0.4;
const float kCasingDepth = 3.0;  // pixels

// The depth of gl_FragCoord, this many pixels farther away.
float depth_behind(float pixels) {
    float z = gl_FragCoord.z;
    if (projection.w != 0.0) return z - pixels * pixel_size(1.0) / projection.z;
    return z / (1.0 + pixels * pixel_size(1.0));
}

void main() {
    float half_width = 0.5 * line_width;
    float core = 1.0, edge = 0.0;
    if (casing > 0.0) {
        core -= smoothstep(half_width - 0.4, half_width + 0.4, abs(across));
        edge = kCasingOpacity * (1.0 - smoothstep(half_width, half_width + casing, abs(across)));
    }
    float alpha = max(core, edge);
    gl_FragDepth = core > 0.5 ? gl_FragCoord.z : depth_behind(kCasingDepth);
    result = vec4(mix(casing_color, color.rgb, core / max(alpha, 1e-4)), color.a * opacity * alpha);
}
