// What the passes that choose the visible boxes hand on. A box's bin: 0 not drawn, otherwise 1 to 255, growing
// with its size on screen.
layout(std430, binding = 1) buffer Bins { uint bins[]; };
layout(std430, binding = 2) buffer State {
    uint outside;
    uint under_pixel;
    uint visible;
    uint threshold;  // boxes of larger bins are drawn, those of this bin as long as `rest` lasts
    uint rest;
    uint histogram[256];
};
