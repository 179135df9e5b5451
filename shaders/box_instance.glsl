// A box as BoxInstance in app/gl/box_layer.h lays it out: nine words.
struct NodeBox {
    vec3 lower, upper;
    float references, sah_share;
    uint word;
};

#define READ_BOX(words, index) \
    NodeBox(vec3(words[9u * (index)], words[9u * (index) + 1u], words[9u * (index) + 2u]), \
            vec3(words[9u * (index) + 3u], words[9u * (index) + 4u], words[9u * (index) + 5u]), \
            words[9u * (index) + 6u], words[9u * (index) + 7u], floatBitsToUint(words[9u * (index) + 8u]))
