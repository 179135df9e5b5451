#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "app/gl/program.h"
#include "app/viewer/draw_list.h"
#include "core/base/vec.h"

namespace boxwood {

/// A box as the shaders read it, in unit space.
struct BoxInstance {
    Vec3 lower;
    Vec3 upper;
    float references = 0.0f;
    float sah_share = 0.0f;
    uint32_t word = 0;  ///< node: see node_word; reference: its primitive
};
static_assert(sizeof(BoxInstance) == 36);

/// Flags and level of a node: see box_instance.glsl.
inline uint32_t node_word(const NodeView& node) {
    const bool is_leaf = node.kind == NodeKind::Leaf;
    return node.level << 2 | (is_leaf && node.ref_count == 0 ? 2u : 0u) | (is_leaf ? 1u : 0u);
}

/// Line segment of an outline, in unit space.
struct UnitSegment {
    Vec3 from, to;
};
static_assert(sizeof(UnitSegment) == 24);

/// Outlines that are drawn in place of boxes: of box i segments[begin[i], begin[i + 1]); of a box that has
/// none its edges are drawn. begin is empty where no box has one.
struct Outlines {
    std::vector<uint32_t> begin;
    std::vector<UnitSegment> segments;
};

/// The compute programs that find out what is visible.
struct BoxPrograms {
    Program cull{"cull_boxes.comp"};
    Program select{"select_boxes.comp"};
};

/// The quads of a piece's twelve segments, as indices of vertices: see boxes.vert.
class BoxEdges {
public:
    static constexpr int kIndexCount = 72;
    static constexpr size_t kSegments = 12;
    BoxEdges();
    void bind() const { glBindVertexArray(vertex_array_.name()); }

private:
    Buffer indices_;
    VertexArray vertex_array_ = make_vertex_array();
};

/// Boxes on the GPU, or the outlines of what they bound. The GPU itself chooses what of them is drawn, in
/// their order, so that the same boxes give the same picture.
class BoxLayer {
public:
    /// Uploads `count` boxes; `fill` writes the boxes from index `first` on into the span.
    void upload(uint32_t count, const std::function<void(uint32_t first, std::span<BoxInstance>)>& fill,
                const Outlines& outlines = {});
    void clear();
    /// A mark for each box, see BoxMarks; none: all marks are 0.
    void set_marks(std::span<const uint32_t> marks);

    /// Chooses the boxes to be drawn; `budget` counts boxes, an outline as one for every twelve of its
    /// segments. The uniform block Frame is bound to 0.
    void choose(const BoxPrograms& programs, const BoxSelection& selection, uint32_t budget);
    /// Draws what was chosen, with `program`, which is in use, and BoxEdges bound. Nothing if choose() was
    /// not called.
    void draw(const Program& program) const;

    /// What choose() found.
    BoxCounts counts() const;
    uint32_t box_count() const { return count_; }
    size_t byte_count() const { return byte_count_; }
    uint64_t upload_count() const { return upload_count_; }

private:
    struct Chunk {
        Buffer boxes, bins, segment_begin, segments, marks;
        uint32_t first = 0;
        uint32_t count = 0;
    };
    void add_chunk(uint32_t first, uint32_t end, std::span<BoxInstance> boxes, const Outlines& outlines);
    void reserve_drawn(uint32_t capacity);
    void for_each_chunk(uint32_t end, const std::function<void(const Chunk&, uint32_t chunk_end)>& run) const;

    std::vector<Chunk> chunks_;
    Buffer state_, groups_, drawn_;
    uint32_t drawn_capacity_ = 0;
    uint32_t count_ = 0;
    uint32_t piece_count_ = 0;
    bool has_outlines_ = false;
    bool has_marks_ = false;
    bool is_chosen_ = false;
    size_t byte_count_ = 0;
    uint64_t upload_count_ = 0;
};

/// A few boxes or outlines that are always drawn, such as what is selected.
class FewOutlines {
public:
    /// `segments` of one outline, or, if there are none, the box.
    void set(const Box& unit_box, std::span<const UnitSegment> segments);
    /// As BoxLayer::draw.
    void draw(const Program& program) const;

private:
    Buffer pieces_;
    uint32_t piece_count_ = 0;
};

}  // namespace boxwood
