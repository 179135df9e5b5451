// A box as BoxInstance in app/gl/box_layer.h lays it out: nine words.
struct NodeBox {
    vec3 lower, upper;
    float references, sah_share;
    uint word;
};

#define READ_VEC3(words, at) \
    uintBitsToFloat(uvec3(words[at], words[(at) + 1u], words[(at) + 2u]))
#define READ_BOX(words, at) \
    NodeBox(READ_VEC3(words, at), READ_VEC3(words, (at) + 3u), uintBitsToFloat(words[(at) + 6u]), \
            uintBitsToFloat(words[(at) + 7u]), words[(at) + 8u])

const uint kBoxWords = 9u;

// Of a node's word: its flags below its level.
bool is_leaf(NodeBox box) { return (box.word & 1u) != 0u; }
bool is_empty(NodeBox box) { return (box.word & 2u) != 0u; }
uint level_of(NodeBox box) { return box.word >> 2; }

// What is drawn is made of pieces of up to twelve segments: the edges of a box, or a part of an outline. A piece:
// its box, the box's mark, the piece's own word, and the two ends of each segment of an outline.
const uint kPieceHeadWords = 11u;
const uint kSegmentsOfPiece = 12u;
const uint kSegmentWords = 6u;
const uint kPieceSegments = 0xffu;    // bits: segments of the outline; 0: the box's own edges
const uint kFirstPiece = 0x100u;      // of its box

// Of a box's mark.
const uint kHiddenMark = 0x80000000u;
const uint kVisitsOfMark = 0x7fffffffu;
