#include "app/gl/box_layer.h"

#include <algorithm>
#include <array>

namespace boxwood {
namespace {

constexpr uint32_t kChunkSize = 1u << 21;  // 72 MiB of boxes: drivers allow buffers of 128 MiB in a shader
constexpr uint32_t kCullLanes = 64;
constexpr uint32_t kBoxesPerGroup = 256 * 16;  // see select_boxes.comp
static_assert(kChunkSize % kBoxesPerGroup == 0);

constexpr uint32_t kThresholdStep = 0, kCountStep = 1, kCopyStep = 2;

/// The buffer State of box_bins.glsl.
struct State {
    uint32_t outside, under_pixel, visible, threshold, rest;
    uint32_t histogram[256];
};

uint32_t group_count(uint32_t count, uint32_t group_size) { return (count + group_size - 1) / group_size; }

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

void BoxLayer::upload(uint32_t count,
                      const std::function<void(uint32_t first, std::span<BoxInstance>)>& fill) {
    clear();
    count_ = count;
    std::vector<BoxInstance> staging(std::min(count, kChunkSize));
    for (uint32_t first = 0; first < count; first += kChunkSize) {
        const std::span<BoxInstance> part = std::span(staging).first(std::min(count - first, kChunkSize));
        fill(first, part);
        Chunk chunk;
        chunk.boxes = make_buffer(std::as_bytes(part));
        chunk.bins = make_empty_buffer(part.size() * sizeof(uint32_t));
        chunk.first = first;
        chunk.count = static_cast<uint32_t>(part.size());
        chunks_.push_back(std::move(chunk));
        byte_count_ += part.size() * (sizeof(BoxInstance) + sizeof(uint32_t));
        ++upload_count_;
    }
    groups_ = make_empty_buffer(group_count(count, kBoxesPerGroup) * 2 * sizeof(uint32_t));
    state_ = make_empty_buffer(sizeof(State));
    command_ = make_empty_buffer(5 * sizeof(uint32_t));
}

void BoxLayer::clear() {
    chunks_.clear();
    drawn_ = Buffer();
    drawn_capacity_ = 0;
    count_ = 0;
    candidates_ = 0;
    is_chosen_ = false;
    byte_count_ = 0;
}

void BoxLayer::reserve_drawn(uint32_t capacity) {
    if (capacity <= drawn_capacity_) return;
    byte_count_ += (capacity - drawn_capacity_) * sizeof(BoxInstance);
    drawn_ = make_empty_buffer(capacity * sizeof(BoxInstance));
    drawn_capacity_ = capacity;
}

void BoxLayer::choose(const BoxPrograms& programs, const BoxSelection& selection, uint32_t budget) {
    const uint32_t end = std::min(selection.end, count_);
    candidates_ = selection.count;
    is_chosen_ = end > 0 && selection.count > 0 && budget > 0;
    if (!is_chosen_) return;
    reserve_drawn(std::min(budget, count_));
    zero(state_);
    zero(groups_);
    bind_storage(2, state_);
    bind_storage(3, groups_);
    bind_storage(4, drawn_);
    bind_storage(5, command_);

    programs.cull.use();
    programs.cull.set("first_level", selection.first_level);
    programs.cull.set("leaves_above", selection.leaves_above ? 1u : 0u);
    for (const Chunk& chunk : chunks_) {
        if (chunk.first >= end) break;
        bind_storage(0, chunk.boxes);
        bind_storage(1, chunk.bins);
        const uint32_t chunk_end = std::min(end - chunk.first, chunk.count);
        programs.cull.set("end", chunk_end);
        glDispatchCompute(group_count(chunk_end, kCullLanes), 1, 1);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

    programs.select.use();
    programs.select.set("budget", budget);
    programs.select.set("step_number", kThresholdStep);
    glDispatchCompute(1, 1, 1);
    for (const uint32_t step : {kCountStep, kCopyStep}) {
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        programs.select.set("step_number", step);
        for (const Chunk& chunk : chunks_) {
            if (chunk.first >= end) break;
            bind_storage(0, chunk.boxes);
            bind_storage(1, chunk.bins);
            const uint32_t chunk_end = std::min(end - chunk.first, chunk.count);
            programs.select.set("end", chunk_end);
            programs.select.set("first_group", chunk.first / kBoxesPerGroup);
            glDispatchCompute(group_count(chunk_end, kBoxesPerGroup), 1, 1);
        }
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void BoxLayer::draw() const {
    if (!is_chosen_) return;
    bind_storage(4, drawn_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_.name());
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr);
}

BoxCounts BoxLayer::counts() const {
    BoxCounts counts;
    if (!is_chosen_) return counts;
    State state{};
    std::array<uint32_t, 5> command{};
    glGetNamedBufferSubData(state_.name(), 0, sizeof(State), &state);
    glGetNamedBufferSubData(command_.name(), 0, sizeof(command), command.data());
    counts.candidates = candidates_;
    counts.drawn = command[1];
    counts.outside = state.outside;
    counts.under_pixel = state.under_pixel;
    counts.over_budget = state.visible - command[1];
    return counts;
}

}  // namespace boxwood
