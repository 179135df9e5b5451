// Copies the visible boxes, in their order, to where they are drawn from; of too many the largest on screen.
// Three steps, each a dispatch: the threshold of size; how many boxes each group has; the copies.
#include "box_instance.glsl"
#include "box_bins.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Boxes { float boxes[]; };
layout(std430, binding = 3) buffer Groups { uvec2 group_counts[]; };  // above the threshold, and at it
layout(std430, binding = 4) writeonly buffer Drawn { float drawn[]; };
layout(std430, binding = 5) writeonly buffer Command { uint command[5]; };

const uint kThresholdStep = 0u, kCountStep = 1u;
const uint kIndicesPerBox = 72u;
const uint kBoxesPerLane = 16u;
const uint kLanes = 256u;

uniform uint step_number;
uniform uint end;          // boxes of this chunk
uniform uint first_group;  // of this chunk
uniform uint budget;

shared uvec2 lane_counts[kLanes];
shared uvec2 lane_offsets[kLanes];

void find_threshold() {
    uint above = 0u;
    threshold = 0u;
    rest = 0u;
    for (uint bin = 255u; bin > 0u; --bin) {
        uint count = histogram[bin];
        if (above + count > budget) {
            threshold = bin;
            rest = budget - above;
            break;
        }
        above += count;
    }
    command[0] = kIndicesPerBox;
    command[1] = min(visible, budget);
    command[2] = 0u;
    command[3] = 0u;
    command[4] = 0u;
}

uvec2 classify(uint index) {
    uint bin = index < end ? bins[index] : 0u;
    return uvec2(bin > threshold ? 1u : 0u, bin != 0u && bin == threshold ? 1u : 0u);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (step_number == kThresholdStep) {
        if (gl_GlobalInvocationID.x == 0u) find_threshold();
        return;
    }
    uint group = first_group + gl_WorkGroupID.x;
    uint begin = (gl_WorkGroupID.x * kLanes + lane) * kBoxesPerLane;
    uvec2 own = uvec2(0u);
    for (uint i = 0u; i < kBoxesPerLane; ++i) own += classify(begin + i);
    lane_counts[lane] = own;
    uvec2 before = uvec2(0u);
    if (step_number != kCountStep) {
        for (uint g = lane; g < group; g += kLanes) before += group_counts[g];
        lane_offsets[lane] = before;
    }
    barrier();
    if (lane == 0u) {
        uvec2 offset = uvec2(0u);
        if (step_number != kCountStep) {
            for (uint l = 0u; l < kLanes; ++l) offset += lane_offsets[l];
        }
        for (uint l = 0u; l < kLanes; ++l) {
            lane_offsets[l] = offset;
            offset += lane_counts[l];
        }
        if (step_number == kCountStep) group_counts[group] = offset;
    }
    barrier();
    if (step_number == kCountStep || own == uvec2(0u)) return;
    uvec2 offset = lane_offsets[lane];
    for (uint i = 0u; i < kBoxesPerLane; ++i) {
        uvec2 one = classify(begin + i);
        if (one.x != 0u || (one.y != 0u && offset.y < rest)) {
            uint to = 9u * (offset.x + min(offset.y, rest));
            uint from = 9u * (begin + i);
            for (uint word = 0u; word < 9u; ++word) drawn[to + word] = boxes[from + word];
        }
        offset += one;
    }
}
