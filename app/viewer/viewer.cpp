#include "app/viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/viewer/clipboard.h"
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
    : state(session.state), session_(std::move(session)), settings_(std::move(settings)), undo_(state) {
    for (const std::string& note : session_.notes) say(note, false);
}

Camera Viewer::camera() const {
    if (state.camera) return *state.camera;
    if (!scene_) return Camera{};
    Camera camera = scene_->camera
                        ? *scene_->camera
                        : fit_camera(scene_->mesh.bounds(), Camera{}.fov, up_vector(state.up_axis));
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
    if (job_.progress().running || asked_ != wanted()) return true;
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
    request_build();
    update_trace();
    undo_.note(state, editing || opening_.has_value() || panel_memory.playing);
}

void Viewer::request_build() {
    const BuildRequest request = wanted();
    if (asked_ == request) return;
    asked_ = request;
    build_error_.clear();
    cancelled_ = false;
    if (shown_ && satisfies(*shown_, request)) {
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
    } while (job_.progress().running || opening_ || !shown_ || !satisfies(*shown_, request_of(state)));
    if (!tracing_) return;
    constexpr double kLong = 1000.0;  // ms
    while (!tracer_->wait(kLong)) {
    }
    update(false);
}

void Viewer::show_state(const ViewerState& next) {
    const int width = state.width, height = state.height;
    state = next;
    state.width = width;
    state.height = height;
}

void Viewer::open_session(Session session) {
    if (session.state.scene == state.scene && scene_) {
        show_state(session.state);
        for (const std::string& note : session.notes) say(note, false);
        session_ = std::move(session);
    } else {
        opening_ = Opening{.session = std::move(session)};
    }
}

void Viewer::open(const std::string& path) {
    try {
        if (std::optional<Session> session = load_session(path)) {
            open_session(*std::move(session));
            settings_.add_recent(path);
        } else {
            Session scene;
            scene.state = state;
            scene.state.scene = path;
            opening_ = Opening{.session = std::move(scene), .scene_only = true};
        }
    } catch (const Error& error) {
        say(error.what(), true);
    }
}

void Viewer::reload() {
    BuildRequest request = wanted();
    asked_ = request;
    request.reload = true;
    job_.request(std::move(request));
}

void Viewer::focus(const Vec2& pointer) {
    const FrameLayout layout = make_layout(state);
    const ViewRect& view = layout.scene.contains(pointer) ? layout.scene : layout.traced;
    if (!built_ || !view.contains(pointer)) return;
    const auto pointed = point_at(*built_, *values_, state, pointer_ray(camera(), pointer, view));
    if (pointed) state.camera = focus_on(camera(), pointed->point, scene_->mesh.bounds());
}

void Viewer::apply(const std::vector<Action>& actions) {
    for (const Action& action : actions) {
        try {
            apply_one(action);
        } catch (const Error& error) {
            say(error.what(), true);
        }
    }
}

void Viewer::apply_one(const Action& action) {
    const auto go_to = [this](const std::optional<ViewerState>& step) {
        if (!step) return;
        if (step->scene == state.scene) {
            state = *step;
        } else {
            Session session = this->session();
            session.state = *step;
            opening_ = Opening{.session = std::move(session)};
        }
    };
    if (const auto* open_path = std::get_if<OpenPath>(&action)) {
        open(open_path->path);
    } else if (const auto* save = std::get_if<SaveSession>(&action)) {
        save_session(session(), save->path);
        settings_.add_recent(save->path);
        say("saved " + save->path, false);
    } else if (std::holds_alternative<CopySession>(action)) {
        set_clipboard(print_session(session(), "."));
        say("copied the session as text", false);
    } else if (std::holds_alternative<PasteSession>(action)) {
        open_session(parse_session(clipboard(), ".", "clipboard"));
    } else if (const auto* copy = std::get_if<CopyText>(&action)) {
        set_clipboard(copy->text);
    } else if (std::holds_alternative<UndoStep>(action)) {
        go_to(undo_.back(state));
    } else if (std::holds_alternative<RedoStep>(action)) {
        go_to(undo_.forward(state));
    } else if (std::holds_alternative<CancelWork>(action)) {
        job_.cancel();
        opening_.reset();
        asked_ = wanted();
        cancelled_ = !shown_ || !satisfies(*shown_, *asked_);
    } else if (std::holds_alternative<BuildAgain>(action)) {
        asked_.reset();
    } else if (std::holds_alternative<DismissMessage>(action)) {
        message_.clear();
    } else if (const auto* point = std::get_if<FocusPoint>(&action)) {
        focus(point->pointer);
    } else if (const auto* store = std::get_if<StoreView>(&action)) {
        state.stored_views[static_cast<size_t>(store->slot)] = camera();
        say("stored view " + std::to_string(store->slot + 1), false);
    }
}

PanelInput Viewer::panel_input(const Vec2& pointer) const {
    PanelInput input;
    input.scene = scene_.get();
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
