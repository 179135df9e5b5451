// What the passes that choose the visible boxes hand on. A box's bin: 0 not drawn, otherwise 1 to 255, growing
// with its size on screen.
layout(std430, binding = 1) buffer Bins { uint bins[]; };
layout(std430, binding = 2) buffer State {
    uint command[5];  // of the indirect draw: its second number is the count of pieces
    uint outside;
    uint under_pixel;
    uint visible;
    uint empty;      // empty cells that are not to be drawn
    uint drawn_boxes;
    uint threshold;  // pieces of larger bins are drawn, those of this bin as long as `rest` lasts
    uint rest;
    uint histogram[256];  // pieces of the boxes of each bin
};
layout(std430, binding = 5) readonly buffer SegmentBegin { uint segment_begin[]; };  // of each box, and the end
layout(std430, binding = 6) readonly buffer Marks { uint marks[]; };
uniform uint has_outlines;  // 0: segment_begin is not there, every box is drawn as one
uniform uint has_marks;     // 0: all marks are 0

uint segment_count(uint index) {
    return has_outlines != 0u ? segment_begin[index + 1u] - segment_begin[index] : 0u;
}
uint piece_count(uint index) { return max((segment_count(index) + 11u) / 12u, 1u); }
uint mark_of(uint index) { return has_marks != 0u ? marks[index] : 0u; }
