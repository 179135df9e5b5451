#include "app/viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/viewer/scene_path.h"
#include "core/base/error.h"
#include "core/render/image.h"

namespace boxwood {
namespace {

/// Whether the state shows anything that needs references or a structure.
bool needs_structure(const ViewerState& state) {
    return state.show_panels || state.show_boxes || state.show_reference_boxes ||
           (state.show_red && state.show_mesh) || state.traced != TracedView::Off;
}

BuildRequest request_of(const ViewerState& state) {
    return {.scene = state.scene, .recipe = state.recipe, .structure = needs_structure(state)};
}

/// Whether a frame that shows one request shows all of the other.
bool satisfies(const BuildRequest& shown, const BuildRequest& wanted) {
    if (shown.scene != wanted.scene) return false;
    return !wanted.structure || (shown.structure && shown.recipe == wanted.recipe);
}

}  // namespace

Viewer::Viewer(Session session, Settings settings)
    : state(session.state),
      session_(std::move(session)),
      settings_(std::move(settings)),
      nodes_of_(NodesKey::of(state)),
      undo_(state) {
    for (const std::string& note : session_.notes) say(note, false);
}

Camera Viewer::camera() const {
    if (state.camera) return *state.camera;
    if (!scene_) return Camera{};
    Camera camera =
        scene_->camera ? *scene_->camera : fit_camera(scene_bounds_, Camera{}.fov, up_vector(state.up_axis));
    // A view narrower than the one such cameras are made for keeps the width of what they show.
    const float aspect = scene_->camera ? 1.25f : 1.0f;
    const ViewRect view = make_layout(state).scene;
    if (view.width < aspect * view.height) {
        const float slope = std::tan(glm::radians(0.5f * camera.fov)) * aspect * view.height / view.width;
        camera.fov = std::min(glm::degrees(2.0f * std::atan(slope)), 100.0f);
    }
    return camera;
}

Session Viewer::session() const {
    Session session = session_;
    session.state = state;
    return session;
}

bool Viewer::busy() const {
    if (panel_memory.playing) return true;
    if (job_.progress().running || asked_ != wanted() || rays_.busy()) return true;
    return tracing_ && !trace_paused_ && !tracer_->state().converged;
}

void Viewer::say(const std::string& sentence, bool is_error) {
    message_ = sentence;
    message_is_error_ = is_error;
}

BuildRequest Viewer::wanted() const {
    BuildRequest request = request_of(opening_ ? opening_->session.state : state);
    if (!scene_) request.structure = false;  // the surface can be seen before its structure is built
    return request;
}

void Viewer::update(bool editing) {
    if (const std::optional<BuildResult> result = job_.take()) take(*result);
    forget_nodes();
    request_build();
    update_trace();
    // The picture first: a check beside it would slow both down, and be timed as slow.
    rays_.update(state, built_, camera(), !tracing_ || tracer_->state().converged);
    update_nodes();
    undo_.note(state, editing || opening_.has_value() || panel_memory.playing);
}

bool Viewer::shows(const BuildRequest& request) const { return shown_ && satisfies(*shown_, request); }

void Viewer::forget_nodes() {
    const NodesKey key = NodesKey::of(state);
    if (key == nodes_of_) return;
    if (key.scene != nodes_of_.scene) state.ray.reset();
    nodes_of_ = key;
    state.node = state.prim = state.isolated = kNoIndex;
    state.hidden_nodes.clear();
    picked_at_.reset();
}

void Viewer::update_nodes() {
    const bool is_other = nodes_built_ != built_;
    nodes_built_ = built_;
    if (is_other || !visibility_ || hidden_shown_ != state.hidden_nodes ||
        isolated_shown_ != state.isolated) {
        hidden_shown_ = state.hidden_nodes;
        isolated_shown_ = state.isolated;
        visibility_ = std::make_shared<const Visibility>(
            built_ ? visible_parts(state, built_->levels->list, built_->scene->mesh.triangle_count())
                   : Visibility{});
    }
    const bool exists = built_ && state.node < built_->levels->list.nodes.size();
    if (!exists) facts_.reset();
    if (exists && (is_other || !facts_ || facts_->node != state.node))
        facts_ = node_facts(built_->levels->list, *values_, state.node);
}

void Viewer::request_build() {
    const BuildRequest request = wanted();
    if (asked_ == request) return;
    asked_ = request;
    build_error_.clear();
    cancelled_ = false;
    if (shows(request)) {
        job_.cancel();
        return;
    }
    if (tracing_) {
        tracer_->stop();
        trace_paused_ = true;
    }
    job_.request(request);
}

void Viewer::take(const BuildResult& result) {
    if (!result.scene) {
        say(result.error, true);
        build_exit_code_ = result.exit_code;
        if (opening_) opening_.reset();
        if (!scene_) build_error_ = result.error;
        return;
    }
    if (opening_) {
        const Opening opening = *std::exchange(opening_, std::nullopt);
        if (opening.scene_only) {
            state.scene = opening.session.state.scene;
            state.camera.reset();
            state.stored_views = {};
            session_ = Session{};
        } else {
            show_state(opening.session.state);
            session_ = opening.session;
        }
        message_.clear();
        for (const std::string& note : session_.notes) say(note, false);
    }
    build_error_ = result.error;
    build_exit_code_ = result.exit_code;
    if (scene_ != result.scene) {
        if (!is_built_in(state.scene)) settings_.add_recent(scene_file(state.scene));
        scene_ = result.scene;
        scene_bounds_ = scene_->mesh.bounds();
        built_.reset();
        values_.reset();
        tree_.reset();
    }
    if (scene_->mesh.triangle_count() == 0) {
        say(scene_->title + (scene_->mesh.points.positions.empty()
                                 ? " has no triangles: there is nothing to build or trace."
                                 : " holds points alone: surfaces for points come later."),
            false);
    }
    shown_ = result.request;
    shown_->reload = false;
    shown_->structure = result.built != nullptr;
    if (!result.built) return;
    built_ = result.built;
    values_ = result.values;
    tree_ = result.tree;
    shared_count_ = result.shared_count;
    build_wait_ms_ = result.ms;
}

std::optional<TraceSettings> Viewer::wanted_trace() const {
    const FrameLayout layout = make_layout(state);
    if (state.traced == TracedView::Off || !built_ || layout.traced.width < 1.0f ||
        layout.traced.height < 1.0f) {
        return std::nullopt;
    }
    TraceSettings settings;
    settings.camera = camera();
    settings.width = static_cast<int>(layout.traced.width);
    settings.height = static_cast<int>(layout.traced.height);
    settings.shading = state.shading;
    settings.mode = state.mode;
    settings.spp = state.spp;
    settings.color_map = state.color_map;
    settings.log_heat = state.log_heat;
    settings.heat_max = static_cast<double>(state.heat_max);
    if (state.theme == Theme::Light) settings.background = linear_from_srgb(Vec3(0.93f, 0.94f, 0.95f));
    settings.measure = state.show_panels;
    return settings;
}

void Viewer::update_trace() {
    const std::optional<TraceSettings> settings = wanted_trace();
    if (!settings) {
        if (tracing_) tracer_->stop();
        tracing_.reset();
        return;
    }
    const bool same = tracing_ == settings && traced_built_ == built_;
    if (!same || (trace_paused_ && !job_.progress().running)) {
        if (!tracer_) tracer_ = std::make_unique<ProgressiveTracer>();
        tracer_->start(scene_, built_->structure, *settings);
        tracing_ = settings;
        traced_built_ = built_;
        trace_paused_ = false;
    }
    tracer_->snapshot(traced_image_, traced_version_);
}

void Viewer::require_scene() const {
    if (!scene_ && !build_error_.empty()) throw Error(build_exit_code_, build_error_);
}

void Viewer::wait() {
    do {
        update(false);
        job_.wait();
        update(false);
        if (!build_error_.empty()) throw Error(build_exit_code_, build_error_);
    } while (job_.progress().running || opening_ || !shows(request_of(state)));
    constexpr double kLong = 1000.0;  // ms
    do {
        update(false);
        while (tracing_ && !tracer_->wait(kLong)) {
        }
        update(false);
        rays_.wait();
        update(false);
    } while (rays_.busy());
}

PanelInput Viewer::panel_input(const Vec2& pointer) const {
    PanelInput input;
    input.scene = scene_.get();
    input.scene_bounds = scene_bounds_;
    input.built = built_.get();
    input.tree = tree_.get();
    input.camera = camera();
    input.progress = job_.progress();
    input.build_error = build_error_;
    input.cancelled = cancelled_;
    input.build_wait_ms = build_wait_ms_;
    input.cache_bytes = job_.cache().byte_count();
    input.cache_limit = job_.cache().byte_limit();
    if (tracing_) input.trace = tracer_->state();
    input.message = message_;
    input.message_is_error = message_is_error_;
    input.recent = settings_.recent;
    input.values = values_.get();
    input.shared_count = shared_count_;
    input.facts = facts_ ? &*facts_ : nullptr;
    input.picked_place = picked_place_;
    input.picked_count = picked_at_ ? picked_count_ : 0;
    input.visits = rays_.cast().visits.get();
    input.visits_progress = rays_.visits_progress();
    input.ray_hit = rays_.cast().ray_hit;
    input.check = rays_.check().get();
    input.check_progress = rays_.check_progress();
    input.undo_count = undo_.back_count();
    input.redo_count = undo_.forward_count();

    constexpr size_t kTooManyToTest = 200000;  // without nodes each would be tested for each frame
    const bool is_list = built_ && built_->levels->level_count() <= 1;
    if (!built_ || (is_list && scene_->mesh.triangle_count() > kTooManyToTest)) return input;
    const FrameLayout layout = make_layout(state);
    const bool on_scene = layout.scene.contains(pointer), on_traced = layout.traced.contains(pointer);
    if (!on_scene && !on_traced) return input;
    const ViewRect& view = on_scene ? layout.scene : layout.traced;
    input.pointed = point_at(*built_, *values_, state, pointer_ray(camera(), pointer, view));
    if (tracing_ && on_traced) {
        input.pixel = tracer_->picked(static_cast<int>(pointer.x - layout.traced.x),
                                      static_cast<int>(pointer.y - layout.traced.y));
    }
    return input;
}

}  // namespace boxwood
