// The camera. Unit space: the scene's box, moved to the origin and scaled to size 1. Eye space: x right, y up,
// the view along -z. Depth is 1 near and 0 far.
layout(std140, binding = 0) uniform Frame {
    mat4 view;        // unit space to eye space
    vec4 projection;  // half width, half height; near (perspective) or far (orthographic); 1: orthographic
    vec4 viewport;    // width, height in pixels; depths between which the scene lies
};

vec4 project(vec3 eye) {
    if (projection.w != 0.0) return vec4(eye.xy / projection.xy, 1.0 + eye.z / projection.z, 1.0);
    return vec4(eye.xy / projection.xy, projection.z, -eye.z);
}

// Least distance along the view that is visible.
float nearest_depth() { return projection.w != 0.0 ? 0.0 : projection.z; }

// Length in eye space of a pixel at this distance along the view.
float pixel_size(float depth) {
    return 2.0 * projection.y / viewport.y * (projection.w != 0.0 ? 1.0 : depth);
}

vec3 linear_from_srgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

vec3 srgb_from_linear(vec3 c) {
    vec3 x = clamp(c, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}
