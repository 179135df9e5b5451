// Copies the pieces of the visible boxes, in their order, to where they are drawn from; of too many those of the
// boxes that are largest on screen. Three steps, each a dispatch: the threshold of size; how many pieces each
// group has; the copies.
#include "box_instance.glsl"
#include "box_bins.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Boxes { uint boxes[]; };
layout(std430, binding = 3) buffer Groups { uvec2 group_counts[]; };  // above the threshold, and at it
layout(std430, binding = 4) writeonly buffer Drawn { uint drawn[]; };
layout(std430, binding = 7) readonly buffer Segments { uint segments[]; };

const uint kThresholdStep = 0u, kCountStep = 1u;
const uint kIndicesPerPiece = 72u;
const uint kBoxesPerLane = 16u;
const uint kLanes = 256u;

uniform uint step_number;
uniform uint end;          // boxes of this chunk
uniform uint first_group;  // of this chunk
uniform uint budget;       // pieces
uniform uint piece_words;  // of a piece, with room for segments where there are outlines

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
    command[0] = kIndicesPerPiece;
    command[1] = threshold != 0u ? budget : above;
    command[2] = 0u;
    command[3] = 0u;
    command[4] = 0u;
}

// The box's pieces, above the threshold or at it.
uvec2 classify(uint index) {
    uint bin = index < end ? bins[index] : 0u;
    if (bin == 0u || bin < threshold) return uvec2(0u);
    uint pieces = piece_count(index);
    return bin > threshold ? uvec2(pieces, 0u) : uvec2(0u, pieces);
}

void copy_piece(uint index, uint piece, uint to) {
    uint at = piece_words * to;
    for (uint word = 0u; word < kBoxWords; ++word) drawn[at + word] = boxes[kBoxWords * index + word];
    uint first = has_outlines != 0u ? segment_begin[index] + kSegmentsOfPiece * piece : 0u;
    uint count = min(segment_count(index) - kSegmentsOfPiece * piece, kSegmentsOfPiece);
    drawn[at + 9u] = mark_of(index);
    drawn[at + 10u] = count | (piece == 0u ? kFirstPiece : 0u);
    for (uint word = 0u; word < kSegmentWords * count; ++word)
        drawn[at + kPieceHeadWords + word] = segments[kSegmentWords * first + word];
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
        uint room = min(offset.y, rest);
        uint pieces = one.x + min(one.y, rest - room);
        if (pieces > 0u) atomicAdd(drawn_boxes, 1u);
        for (uint piece = 0u; piece < pieces; ++piece)
            copy_piece(begin + i, piece, offset.x + room + piece);
        offset += one;
    }
}
