#include "app/gl/scene_renderer.h"

#include <algorithm>
#include <array>

#include "app/gl/axis_cross.h"
#include "app/gl/box_layer.h"
#include "app/gl/mesh_layer.h"
#include "app/gl/program.h"
#include "app/gl/view_transform.h"
#include "core/base/parallel.h"

namespace boxwood {
namespace {

/// What boxes.vert calls its ways to colour a box. The first three are those of BoxColor.
enum class Coloring : int { Level, References, SahShare, Primitive, One, Visits };

constexpr float kHiddenOpacity = 0.22f;          // of what lies behind the surface, see-through
constexpr float kHiddenSelectionOpacity = 0.5f;  // of the selected box
constexpr float kWireOpacity = 0.6f;

int coloring_of(BoxColor meaning) {
    switch (meaning) {
        case BoxColor::Level:
            return static_cast<int>(Coloring::Level);
        case BoxColor::Primitives:
            return static_cast<int>(Coloring::References);
        case BoxColor::SahShare:
            return static_cast<int>(Coloring::SahShare);
        case BoxColor::Visits:
            return static_cast<int>(Coloring::Visits);
    }
    return static_cast<int>(Coloring::One);
}

/// The outlines of the nodes, in level order.
Outlines outlines_of(const LevelTable& levels, const UnitSpace& space) {
    Outlines outlines;
    if (levels.outline_begin.empty()) return outlines;
    outlines.segments.reserve(levels.list.outlines.size());
    outlines.begin.push_back(0);
    for (const uint32_t node : levels.order) {
        for (const OutlineSegment& segment : levels.outline(node))
            outlines.segments.push_back({space.from_world(segment.from), space.from_world(segment.to)});
        outlines.begin.push_back(static_cast<uint32_t>(outlines.segments.size()));
    }
    return outlines;
}

void blend_over() {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace

struct SceneRenderer::Impl {
    Program mesh_program{"mesh.vert", "mesh.frag"};
    Program box_program{"boxes.vert", "boxes.frag"};
    Program background_program{"picture.vert", "background.frag"};
    BoxPrograms box_programs;
    BoxEdges box_edges;
    AxisCross axis_cross;
    VertexArray no_vertices = make_vertex_array();
    Buffer frame = make_dynamic_buffer(sizeof(FrameUniforms));
    FewOutlines few;
    UnitSpace space;
    MeshLayer mesh;
    /// What belongs to one structure.
    struct Set {
        BoxLayer nodes;
        BoxLayer references;
        std::vector<uint32_t> split_prims;  ///< of each box of `references`
        PictureRenderer picture;
    };
    std::array<Set, 2> sets;

    void draw_background(const DrawList& list, const Set& set);
    void draw_mesh(const DrawList& list, const Vec3& up, size_t set);
    void draw_boxes(const DrawList& list, const Set& set);
    void draw_over_all(const DrawList& list);
    void draw_few(const Box& box, std::span<const OutlineSegment> outline, const Vec3& color);
    template <class Draw>
    void draw_in_passes(bool see_through, float hidden_opacity, const Draw& draw);
};

SceneRenderer::SceneRenderer() : impl_(std::make_unique<Impl>()) {}
SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::set_mesh(const Mesh& mesh) {
    impl_->space = UnitSpace::of(mesh.bounds());
    impl_->mesh.upload(mesh, impl_->space);
    for (Impl::Set& set : impl_->sets) {
        set.nodes.clear();
        set.references.clear();
        set.split_prims.clear();
    }
}

void SceneRenderer::clear(size_t set) {
    Impl::Set& of = impl_->sets[set];
    of.nodes.clear();
    of.references.clear();
    of.split_prims.clear();
    of.picture.clear();
    impl_->mesh.clear_marks(set);
}

void SceneRenderer::set_boxes(const LevelTable& levels, const BoxValues& values, size_t set) {
    const auto fill = [&](uint32_t first, std::span<BoxInstance> boxes) {
        parallel_for(boxes.size(), 4096, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const uint32_t node = levels.order[first + i];
                const NodeView& view = levels.list.nodes[node];
                boxes[i] = {impl_->space.from_world(view.bounds.lower),
                            impl_->space.from_world(view.bounds.upper), values.references[node],
                            values.sah_share[node], node_word(view)};
            }
        });
    };
    impl_->sets[set].nodes.upload(static_cast<uint32_t>(levels.order.size()), fill,
                                  outlines_of(levels, impl_->space));
}

void SceneRenderer::set_box_marks(const LevelTable& levels, std::span<const uint32_t> marks, size_t set) {
    std::vector<uint32_t> in_order;
    if (!marks.empty()) {
        in_order.reserve(levels.order.size());
        for (const uint32_t node : levels.order) in_order.push_back(marks[node]);
    }
    impl_->sets[set].nodes.set_marks(in_order);
}

void SceneRenderer::set_triangle_marks(std::span<const uint8_t> marks, size_t set) {
    impl_->mesh.upload_marks(marks, set);
    std::vector<uint32_t> box_marks;
    for (const uint32_t prim : impl_->sets[set].split_prims)
        box_marks.push_back((marks[prim] & TriangleMark::kHidden) != 0 ? BoxMark::kHidden : 0u);
    impl_->sets[set].references.set_marks(box_marks);
}

void SceneRenderer::set_references(std::span<const PrimRef> refs, size_t triangle_count, size_t set) {
    const std::vector<uint8_t> flags = split_flags(refs, triangle_count);
    impl_->mesh.upload_marks(flags, set);
    std::vector<uint32_t> split_refs;
    std::vector<uint32_t>& split_prims = impl_->sets[set].split_prims;
    split_prims.clear();
    for (size_t i = 0; i < refs.size(); ++i) {
        if (flags[refs[i].prim] == 0) continue;
        split_refs.push_back(static_cast<uint32_t>(i));
        split_prims.push_back(refs[i].prim);
    }
    const auto fill = [&](uint32_t first, std::span<BoxInstance> boxes) {
        for (size_t i = 0; i < boxes.size(); ++i) {
            const PrimRef& ref = refs[split_refs[first + i]];
            boxes[i] = {.lower = impl_->space.from_world(ref.bounds.lower),
                        .upper = impl_->space.from_world(ref.bounds.upper),
                        .word = ref.prim};
        }
    };
    impl_->sets[set].references.upload(static_cast<uint32_t>(split_refs.size()), fill);
}

void SceneRenderer::set_picture(const Image& image, uint64_t version, size_t set) {
    impl_->sets[set].picture.set(image, version);
}
void SceneRenderer::clear_picture(size_t set) { impl_->sets[set].picture.clear(); }

void SceneRenderer::draw(const DrawList& list, const Camera& camera, RenderTarget& target,
                         const PixelRect& rect, const PixelRect& part, size_t set) {
    if (rect.width <= 0 || rect.height <= 0 || part.width <= 0 || part.height <= 0) return;
    Impl::Set& of = impl_->sets[set];
    const CameraFrame view = camera_frame(camera, static_cast<double>(rect.width) / rect.height);
    const FrameUniforms uniforms = frame_uniforms(view, impl_->space, rect.width, rect.height);
    glNamedBufferSubData(impl_->frame.name(), 0, sizeof(uniforms), &uniforms);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, impl_->frame.name());

    of.nodes.choose(impl_->box_programs, list.boxes.value_or(BoxSelection{}), list.box_budget);
    const uint32_t reference_count = list.reference_boxes ? of.references.box_count() : 0;
    of.references.choose(impl_->box_programs, {.end = reference_count, .count = reference_count},
                         list.box_budget);

    target.bind_samples(rect, part);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glClearDepth(0.0);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    impl_->draw_background(list, of);
    glEnable(GL_DEPTH_TEST);
    impl_->draw_mesh(list, glm::length(camera.up) > 0.0f ? glm::normalize(camera.up) : Vec3(view.up), set);
    impl_->draw_boxes(list, of);
    impl_->draw_over_all(list);
    glDisable(GL_DEPTH_TEST);
    if (list.axis_cross) impl_->axis_cross.draw(view, rect.width, rect.height, list.interface_scale);
    target.resolve(part);
}

void SceneRenderer::Impl::draw_background(const DrawList& list, const Set& set) {
    glDisable(GL_DEPTH_TEST);
    if (set.picture.is_set()) {
        set.picture.fill(1.0f);
        return;
    }
    glDisable(GL_BLEND);
    background_program.set("top", srgb_from_linear(list.background_top));
    background_program.set("bottom", srgb_from_linear(list.background_bottom));
    background_program.use();
    glBindVertexArray(no_vertices.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SceneRenderer::Impl::draw_mesh(const DrawList& list, const Vec3& up, size_t set) {
    const bool only_edges = list.mesh == MeshLook::Hidden;
    if (only_edges && !list.wire) return;
    mesh_program.set("show_red", list.red ? 1 : 0);
    mesh_program.set("red_color", list.red_color);
    mesh_program.set("show_shared", list.shared ? 1 : 0);
    mesh_program.set("shared_color", list.shared_color);
    mesh_program.set("selection_color", list.selection_color);
    mesh_program.set("scene_up", up);
    mesh_program.set("fill", only_edges ? 0 : 1);
    mesh_program.set("wire_width", list.wire ? list.wire_width : 0.0f);
    mesh_program.set("wire_color", list.wire_color);
    mesh_program.set("wire_opacity", kWireOpacity);
    mesh_program.use();
    const GLboolean color = list.mesh == MeshLook::Depth ? GL_FALSE : GL_TRUE;
    glColorMask(color, color, color, color);
    glDepthMask(only_edges ? GL_FALSE : GL_TRUE);
    glDepthFunc(GL_GREATER);
    if (only_edges) {
        blend_over();
    } else {
        glDisable(GL_BLEND);
    }
    mesh.draw(mesh_program, list.selected_prim, set);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
}

/// What lies behind the surface first, dimmer, then what lies before it.
template <class Draw>
void SceneRenderer::Impl::draw_in_passes(bool see_through, float hidden_opacity, const Draw& draw) {
    blend_over();
    if (see_through) {
        glDepthFunc(GL_LESS);
        glDepthMask(GL_FALSE);
        box_program.set("opacity", hidden_opacity);
        draw();
        glDepthMask(GL_TRUE);
    }
    glDepthFunc(GL_GEQUAL);
    box_program.set("opacity", 1.0f);
    draw();
}

void SceneRenderer::Impl::draw_boxes(const DrawList& list, const Set& set) {
    box_program.set("line_width", list.line_width);
    box_program.set("casing", list.line_casing);
    box_program.set("casing_color", srgb_from_linear(list.casing_color));
    box_program.set("depth_fade", list.depth_fade);
    box_program.set("size_fade", list.size_fade);
    box_program.set("palette", std::span<const Vec3>(list.colors.palette));
    box_program.set("scale", Vec2(static_cast<float>(list.colors.scale.lower),
                                  static_cast<float>(list.colors.scale.upper)));
    box_program.set("is_logarithmic", list.colors.scale.logarithmic ? 1 : 0);
    box_program.set("empty_color", list.empty_color);
    box_program.set("unvisited_color", list.unvisited_color);
    box_program.use();
    box_edges.bind();
    box_program.set("coloring", static_cast<int>(Coloring::Primitive));
    draw_in_passes(list.see_through, kHiddenOpacity, [&] { set.references.draw(box_program); });
    box_program.set("coloring", coloring_of(list.colors.meaning));
    draw_in_passes(list.see_through, kHiddenOpacity, [&] { set.nodes.draw(box_program); });
}

void SceneRenderer::Impl::draw_few(const Box& box, std::span<const OutlineSegment> outline,
                                   const Vec3& color) {
    std::vector<UnitSegment> segments;
    for (const OutlineSegment& segment : outline)
        segments.push_back({space.from_world(segment.from), space.from_world(segment.to)});
    few.set({space.from_world(box.lower), space.from_world(box.upper)}, segments);
    box_program.set("one_color", color);
    draw_in_passes(true, kHiddenSelectionOpacity, [&] { few.draw(box_program); });
}

void SceneRenderer::Impl::draw_over_all(const DrawList& list) {
    box_program.set("coloring", static_cast<int>(Coloring::One));
    box_program.set("line_width", 2.0f * list.line_width);
    box_program.set("depth_fade", 0.0f);
    box_program.set("size_fade", 0.0f);
    box_program.use();
    box_edges.bind();
    if (list.selected && !list.selected->is_empty())
        draw_few(*list.selected, list.selected_outline, list.selection_color);
    if (list.ray.empty()) return;
    Box box;
    for (const OutlineSegment& segment : list.ray) {
        box.extend(segment.from);
        box.extend(segment.to);
    }
    draw_few(box, list.ray, list.ray_color);
}

BoxCounts SceneRenderer::box_counts(size_t set) const { return impl_->sets[set].nodes.counts(); }
BoxCounts SceneRenderer::reference_box_counts(size_t set) const {
    return impl_->sets[set].references.counts();
}

uint64_t SceneRenderer::upload_count() const {
    uint64_t count = impl_->mesh.upload_count();
    for (const Impl::Set& set : impl_->sets)
        count += set.nodes.upload_count() + set.references.upload_count();
    return count;
}

size_t SceneRenderer::byte_count() const {
    size_t bytes = impl_->mesh.byte_count();
    for (const Impl::Set& set : impl_->sets) bytes += set.nodes.byte_count() + set.references.byte_count();
    return bytes;
}

}  // namespace boxwood
