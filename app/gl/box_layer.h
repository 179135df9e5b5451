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
    uint32_t word = 0;  ///< node: 2 * level + (1: leaf); reference: its primitive
};
static_assert(sizeof(BoxInstance) == 36);

/// The compute programs that find out what is visible.
struct BoxPrograms {
    Program cull{"cull_boxes.comp"};
    Program select{"select_boxes.comp"};
};

/// The quads of a box's twelve edges, as indices of vertices: see boxes.vert.
class BoxEdges {
public:
    static constexpr int kIndexCount = 72;
    BoxEdges();
    void bind() const { glBindVertexArray(vertex_array_.name()); }

private:
    Buffer indices_;
    VertexArray vertex_array_ = make_vertex_array();
};

/// Boxes on the GPU. The GPU itself chooses what of them is drawn, in their order, so that the same boxes
/// give the same picture.
class BoxLayer {
public:
    /// Uploads `count` boxes; `fill` writes the boxes from index `first` on into the span.
    void upload(uint32_t count, const std::function<void(uint32_t first, std::span<BoxInstance>)>& fill);
    void clear();

    /// Chooses the boxes to be drawn. The uniform block Frame is bound to 0.
    void choose(const BoxPrograms& programs, const BoxSelection& selection, uint32_t budget);
    /// Draws what was chosen, with the program in use and BoxEdges bound. Nothing if choose() was not called.
    void draw() const;

    /// What choose() found.
    BoxCounts counts() const;
    uint32_t box_count() const { return count_; }
    size_t byte_count() const { return byte_count_; }
    uint64_t upload_count() const { return upload_count_; }

private:
    struct Chunk {
        Buffer boxes;
        Buffer bins;
        uint32_t first = 0;
        uint32_t count = 0;
    };
    void reserve_drawn(uint32_t capacity);

    std::vector<Chunk> chunks_;
    Buffer state_, groups_, drawn_, command_;
    uint32_t drawn_capacity_ = 0;
    uint32_t count_ = 0;
    uint32_t candidates_ = 0;
    bool is_chosen_ = false;
    size_t byte_count_ = 0;
    uint64_t upload_count_ = 0;
};

}  // namespace boxwood
