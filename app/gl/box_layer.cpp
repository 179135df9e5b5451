#include "app/gl/box_layer.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace boxwood {
namespace {

constexpr uint32_t kChunkBoxes = 1u << 21;  // 72 MiB of boxes: drivers allow buffers of 128 MiB in a shader
constexpr uint32_t kChunkSegments = 5u << 20;  // 120 MiB
constexpr uint32_t kCullLanes = 64;
constexpr uint32_t kBoxesPerGroup = 256 * 16;  // see select_boxes.comp
static_assert(kChunkBoxes % kBoxesPerGroup == 0);

constexpr uint32_t kThresholdStep = 0, kCountStep = 1, kCopyStep = 2;

// See box_instance.glsl.
constexpr uint32_t kPieceHeadWords = 11, kFirstPiece = 0x100;
constexpr uint32_t kSegmentWords = sizeof(UnitSegment) / sizeof(uint32_t);
constexpr uint32_t kOutlinePieceWords = kPieceHeadWords + BoxEdges::kSegments * kSegmentWords;

/// The buffer State of box_bins.glsl.
struct State {
    std::array<uint32_t, 5> command;
    uint32_t outside, under_pixel, visible, empty, drawn_boxes, threshold, rest;
    uint32_t histogram[256];
};

uint32_t group_count(uint32_t count, uint32_t group_size) { return (count + group_size - 1) / group_size; }

uint32_t pieces_of(uint32_t segment_count) {
    return std::max(group_count(segment_count, BoxEdges::kSegments), 1u);
}

uint32_t segments_of(const Outlines& outlines, uint32_t box) {
    return outlines.begin.empty() ? 0 : outlines.begin[box + 1] - outlines.begin[box];
}

void bind_storage(GLuint binding, const Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

void zero(const Buffer& buffer) {
    glClearNamedBufferData(buffer.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

}  // namespace

BoxEdges::BoxEdges() {
    std::vector<uint16_t> indices;
    for (int edge = 0; edge < kIndexCount / 6; ++edge) {
        for (const int corner : {0, 1, 2, 2, 1, 3})
            indices.push_back(static_cast<uint16_t>(4 * edge + corner));
    }
    indices_ = make_buffer(std::as_bytes(std::span(indices)));
    glVertexArrayElementBuffer(vertex_array_.name(), indices_.name());
}

void BoxLayer::upload(uint32_t count, const std::function<void(uint32_t first, std::span<BoxInstance>)>& fill,
                      const Outlines& outlines) {
    clear();
    count_ = count;
    has_outlines_ = !outlines.begin.empty();
    std::vector<BoxInstance> staging(std::min(count, kChunkBoxes));
    for (uint32_t first = 0; first < count;) {
        uint32_t end = first, segments = 0;
        while (end < count && end - first < kChunkBoxes && (segments < kChunkSegments)) {
            const uint32_t group_end = std::min(end + kBoxesPerGroup, count);
            if (has_outlines_) segments += outlines.begin[group_end] - outlines.begin[end];
            end = group_end;
        }
        const std::span<BoxInstance> part = std::span(staging).first(end - first);
        fill(first, part);
        add_chunk(first, end, part, outlines);
        first = end;
    }
    for (uint32_t box = 0; box < count; ++box) piece_count_ += pieces_of(segments_of(outlines, box));
    groups_ = make_empty_buffer(group_count(count, kBoxesPerGroup) * 2 * sizeof(uint32_t));
    state_ = make_empty_buffer(sizeof(State));
}

void BoxLayer::add_chunk(uint32_t first, uint32_t end, std::span<BoxInstance> boxes,
                         const Outlines& outlines) {
    Chunk chunk;
    chunk.first = first;
    chunk.count = end - first;
    chunk.boxes = make_buffer(std::as_bytes(boxes));
    chunk.bins = make_empty_buffer(boxes.size() * sizeof(uint32_t));
    chunk.marks = make_empty_buffer(0);
    std::vector<uint32_t> begin;
    std::span<const UnitSegment> segments;
    if (has_outlines_) {
        const uint32_t first_segment = outlines.begin[first];
        for (uint32_t box = first; box <= end; ++box) begin.push_back(outlines.begin[box] - first_segment);
        segments = std::span(outlines.segments).subspan(first_segment, begin.back());
    }
    chunk.segment_begin = make_buffer(std::as_bytes(std::span(begin)));
    chunk.segments = make_buffer(std::as_bytes(segments));
    chunks_.push_back(std::move(chunk));
    byte_count_ += boxes.size() * (sizeof(BoxInstance) + sizeof(uint32_t)) + begin.size() * sizeof(uint32_t) +
                   segments.size_bytes();
    ++upload_count_;
}

void BoxLayer::clear() {
    chunks_.clear();
    drawn_ = Buffer();
    drawn_capacity_ = 0;
    count_ = 0;
    piece_count_ = 0;
    has_outlines_ = false;
    has_marks_ = false;
    is_chosen_ = false;
    byte_count_ = 0;
}

void BoxLayer::set_marks(std::span<const uint32_t> marks) {
    if (has_marks_) byte_count_ -= count_ * sizeof(uint32_t);
    has_marks_ = !marks.empty();
    for (Chunk& chunk : chunks_) {
        const auto part = has_marks_ ? marks.subspan(chunk.first, chunk.count) : marks;
        chunk.marks = make_buffer(std::as_bytes(part));
    }
    if (has_marks_) byte_count_ += count_ * sizeof(uint32_t);
    ++upload_count_;
}

void BoxLayer::reserve_drawn(uint32_t capacity) {
    if (capacity <= drawn_capacity_) return;
    const uint32_t piece_bytes = (has_outlines_ ? kOutlinePieceWords : kPieceHeadWords) * 4;
    byte_count_ += size_t{capacity - drawn_capacity_} * piece_bytes;
    drawn_ = make_empty_buffer(size_t{capacity} * piece_bytes);
    drawn_capacity_ = capacity;
}

void BoxLayer::for_each_chunk(uint32_t end,
                              const std::function<void(const Chunk&, uint32_t chunk_end)>& run) const {
    for (const Chunk& chunk : chunks_) {
        if (chunk.first >= end) break;
        bind_storage(0, chunk.boxes);
        bind_storage(1, chunk.bins);
        bind_storage(5, chunk.segment_begin);
        bind_storage(6, chunk.marks);
        bind_storage(7, chunk.segments);
        run(chunk, std::min(end - chunk.first, chunk.count));
    }
}

void BoxLayer::choose(const BoxPrograms& programs, const BoxSelection& selection, uint32_t budget) {
    const uint32_t end = std::min(selection.end, count_);
    is_chosen_ = end > 0 && selection.count > 0 && budget > 0;
    if (!is_chosen_) return;
    reserve_drawn(std::min(budget, piece_count_));
    zero(state_);
    zero(groups_);
    bind_storage(2, state_);
    bind_storage(3, groups_);
    bind_storage(4, drawn_);
    for (const Program* program : {&programs.cull, &programs.select}) {
        program->set("has_outlines", has_outlines_ ? 1u : 0u);
        program->set("has_marks", has_marks_ ? 1u : 0u);
    }
    programs.cull.set("first_level", selection.first_level);
    programs.cull.set("leaves_above", selection.leaves_above ? 1u : 0u);
    programs.cull.set("show_empty", selection.empty_cells ? 1u : 0u);
    programs.cull.set("only_visited", selection.only_visited ? 1u : 0u);
    programs.cull.use();
    for_each_chunk(end, [&](const Chunk&, uint32_t chunk_end) {
        programs.cull.set("end", chunk_end);
        glDispatchCompute(group_count(chunk_end, kCullLanes), 1, 1);
    });
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    programs.select.set("budget", budget);
    programs.select.set("piece_words", has_outlines_ ? kOutlinePieceWords : kPieceHeadWords);
    programs.select.set("step_number", kThresholdStep);
    programs.select.use();
    glDispatchCompute(1, 1, 1);
    for (const uint32_t step : {kCountStep, kCopyStep}) {
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        programs.select.set("step_number", step);
        for_each_chunk(end, [&](const Chunk& chunk, uint32_t chunk_end) {
            programs.select.set("end", chunk_end);
            programs.select.set("first_group", chunk.first / kBoxesPerGroup);
            glDispatchCompute(group_count(chunk_end, kBoxesPerGroup), 1, 1);
        });
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void BoxLayer::draw(const Program& program) const {
    if (!is_chosen_) return;
    program.set("piece_words", has_outlines_ ? kOutlinePieceWords : kPieceHeadWords);
    bind_storage(4, drawn_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, state_.name());
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr);
}

BoxCounts BoxLayer::counts() const {
    BoxCounts counts;
    if (!is_chosen_) return counts;
    State state{};
    glGetNamedBufferSubData(state_.name(), 0, sizeof(State), &state);
    counts.candidates = state.outside + state.under_pixel + state.visible;
    counts.drawn = state.drawn_boxes;
    counts.outside = state.outside;
    counts.under_pixel = state.under_pixel;
    counts.over_budget = state.visible - state.drawn_boxes;
    counts.empty = state.empty;
    return counts;
}

void FewOutlines::set(const Box& unit_box, std::span<const UnitSegment> segments) {
    piece_count_ = pieces_of(static_cast<uint32_t>(segments.size()));
    std::vector<uint32_t> words(size_t{piece_count_} * kOutlinePieceWords);
    const BoxInstance box = {.lower = unit_box.lower, .upper = unit_box.upper};
    for (uint32_t piece = 0; piece < piece_count_; ++piece) {
        uint32_t* const to = words.data() + size_t{piece} * kOutlinePieceWords;
        const size_t first = piece * BoxEdges::kSegments;
        const auto part = segments.subspan(first, std::min(segments.size() - first, BoxEdges::kSegments));
        std::memcpy(to, &box, sizeof(box));
        to[10] = static_cast<uint32_t>(part.size()) | (piece == 0 ? kFirstPiece : 0u);
        if (!part.empty()) std::memcpy(to + kPieceHeadWords, part.data(), part.size_bytes());
    }
    pieces_ = make_buffer(std::as_bytes(std::span(words)));
}

void FewOutlines::draw(const Program& program) const {
    program.set("piece_words", kOutlinePieceWords);
    bind_storage(4, pieces_);
    glDrawElementsInstanced(GL_TRIANGLES, BoxEdges::kIndexCount, GL_UNSIGNED_SHORT, nullptr,
                            static_cast<GLsizei>(piece_count_));
}

}  // namespace boxwood
