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
    return {.scene = state.scene,
            .recipes = {state.side(Side::A).recipe, state.side(Side::B).recipe},
            .structure = needs_structure(state)};
}

/// Whether a frame that shows one request shows all of the other.
bool satisfies(const BuildRequest& shown, const BuildRequest& wanted) {
    if (shown.scene != wanted.scene) return false;
    return !wanted.structure || (shown.structure && shown.recipes == wanted.recipes);
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
    const ViewRect view = make_layout(state).side(Side::A).scene.rect;
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
    if (panel_memory.playing || job_.progress().running || asked_ != wanted() || compare_.busy()) return true;
    return std::ranges::any_of(works_, [](const std::unique_ptr<SideWork>& work) {
        return work->rays.busy() || work->is_trace_busy();
    });
}

void Viewer::say(const std::string& sentence, bool is_error) {
    message_ = sentence;
    message_is_error_ = is_error;
}

BuildRequest Viewer::wanted() const {
    const ViewerState& next = opening_ ? opening_->session.state : state;
    BuildRequest request = request_of(next);
    // The nodes that a state names are those of its recipe: in a stand-in their numbers mean nothing.
    request.stand_in =
        std::ranges::none_of(next.sides, [](const SideState& side) { return side.has_nodes(); });
    if (!scene_) request.structure = false;  // the surface can be seen before its structure is built
    return request;
}

void Viewer::update(bool editing) {
    if (const std::optional<BuildResult> result = job_.take()) take(*result);
    if (!state.compares() && work(Side::B).built()) works_[1] = std::make_unique<SideWork>();
    forget_nodes();
    request_build();
    update_trace();
    // The pictures first: a check beside them would slow both down, and be timed as slow.
    bool may_check = have_converged();
    for (const Side side : kSides) {
        SideWork& work = *works_[index_of(side)];
        work.rays.update(state, work.built(), camera(), may_check);
        work.update_nodes(state.side(side));
        may_check = may_check && !work.rays.busy();
    }
    compare_.update_race(wanted_race(), may_check && !job_.progress().running);
    undo_.note(state, editing || opening_.has_value() || panel_memory.playing);
}

bool Viewer::have_converged() const {
    return std::ranges::all_of(works_,
                               [](const std::unique_ptr<SideWork>& work) { return work->has_converged(); });
}

bool Viewer::shows(const BuildRequest& request) const { return shown_ && satisfies(*shown_, request); }

void Viewer::forget_nodes() {
    const NodesKey key = NodesKey::of(state);
    if (key == nodes_of_) return;
    const bool is_other_scene = key.scene != nodes_of_.scene;
    if (is_other_scene) state.ray.reset();
    for (size_t side = 0; side < state.sides.size(); ++side) {
        if (is_other_scene || key.recipes[side] != nodes_of_.recipes[side])
            state.sides[side] = SideState{.recipe = state.sides[side].recipe};
    }
    state.prim = kNoIndex;
    nodes_of_ = key;
    picked_at_.reset();
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
    for (const std::unique_ptr<SideWork>& work : works_) work->pause_trace();
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
    build_error_.clear();
    if (scene_ != result.scene) {
        if (!is_built_in(state.scene)) settings_.add_recent(scene_file(state.scene));
        scene_ = result.scene;
        scene_bounds_ = scene_->mesh.bounds();
        for (const std::unique_ptr<SideWork>& work : works_) work->clear();
    }
    if (scene_->mesh.triangle_count() == 0) {
        say(scene_->title + (scene_->mesh.points.positions.empty()
                                 ? " has no triangles: there is nothing to build or trace."
                                 : " holds points alone: surfaces for points come later."),
            false);
    }
    shown_ = result.request;
    shown_->reload = false;
    shown_->structure = !result.is_stand_in && result.sides[0].built != nullptr &&
                        (result.request.recipes[1].empty() || result.sides[1].built != nullptr);
    for (const Side side : kSides) {
        SideWork& work = *works_[index_of(side)];
        const std::shared_ptr<const Built> before = work.built();
        work.take(result.sides[index_of(side)]);
        if (shows_stand_in_ && before && work.built() != before)
            find_nodes_again(state.sides[index_of(side)], before->levels->list, work.built()->levels->list);
    }
    shows_stand_in_ = result.is_stand_in;
    if (shown_->structure) build_wait_ms_ = result.ms;
}

std::optional<TraceSettings> Viewer::wanted_trace() const {
    const ViewRect view = make_layout(state).side(Side::A).traced.rect;
    if (state.traced == TracedView::Off || view.width < 1.0f || view.height < 1.0f) return std::nullopt;
    TraceSettings settings;
    settings.camera = camera();
    settings.width = static_cast<int>(view.width);
    settings.height = static_cast<int>(view.height);
    settings.shading = state.shading;
    settings.mode = state.mode;
    settings.spp = shows_two_heats() ? 1 : state.spp;  // pixel centres are what is compared
    if (!shows_two_heats()) {
        settings.color_map = state.color_map;
        settings.log_heat = state.log_heat;
        settings.heat_max = static_cast<double>(state.heat_max);
    }
    if (state.theme == Theme::Light) settings.background = linear_from_srgb(Vec3(0.93f, 0.94f, 0.95f));
    settings.measure = state.show_panels;
    return settings;
}

void Viewer::update_trace() {
    const std::optional<TraceSettings> settings = wanted_trace();
    for (const Side side : kSides) {
        works_[index_of(side)]->update_trace(state.has(side) ? settings : std::nullopt,
                                             job_.progress().running);
    }
    if (shows_two_heats()) {
        compare_.update_heat({work(Side::A).counts(), work(Side::B).counts()},
                             {.shading = state.shading,
                              .color_map = state.color_map,
                              .log_heat = state.log_heat,
                              .heat_max = static_cast<double>(state.heat_max),
                              .dark_middle = state.theme == Theme::Dark});
    } else {
        compare_.clear_heat();
    }
    update_pictures();
}

Viewer::PictureSource Viewer::picture_source(Side side) const {
    if (!shows_two_heats()) return {&work(side), work(side).image_version()};
    return {compare_.heat().get(), compare_.heat_version(), state.shows_difference()};
}

void Viewer::update_pictures() {
    for (const Side side : kSides) {
        const PictureSource source = picture_source(side);
        PictureSource& last = picture_sources_[index_of(side)];
        if (source != last) picture_versions_[index_of(side)] = ++picture_count_;
        last = source;
    }
}

Viewer::TracedPicture Viewer::traced_picture(Side side) const {
    const PictureSource& source = picture_sources_[index_of(side)];
    if (source.owner == nullptr || source.version == 0) return {};
    const uint64_t version = picture_versions_[index_of(side)];
    const HeatComparison* heat = shows_two_heats() ? compare_.heat().get() : nullptr;
    if (heat == nullptr) return {&work(side).image(), version};
    return {source.is_difference ? &heat->difference : &heat->images[index_of(side)], version};
}

std::optional<CompareWork::RaceKey> Viewer::wanted_race() const {
    const std::optional<TraceSettings> settings = wanted_trace();
    if (!settings || !state.compares() || !state.show_times || !state.show_panels || !scene_)
        return std::nullopt;
    const auto &a = work(Side::A).built(), &b = work(Side::B).built();
    if (!a || !b) return std::nullopt;
    return CompareWork::RaceKey{{a, b}, settings->mode, settings->camera, settings->width, settings->height};
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
        for (const std::unique_ptr<SideWork>& work : works_)
            if (!work->build_error().empty()) throw Error(work->build_exit_code(), work->build_error());
    } while (job_.progress().running || opening_ || !shows(request_of(state)));
    const auto is_busy = [](const std::unique_ptr<SideWork>& work) { return work->rays.busy(); };
    do {
        update(false);
        for (const std::unique_ptr<SideWork>& work : works_) work->wait_for_trace();
        update(false);
        for (const std::unique_ptr<SideWork>& work : works_) work->rays.wait();
        compare_.wait();
        update(false);
    } while (std::ranges::any_of(works_, is_busy) || compare_.busy());
}

BoxRanges Viewer::box_ranges() const {
    BoxRanges ranges;
    for (const Side side : kSides) {
        const SideWork& of = work(side);
        if (of.built()) ranges.extend(*of.built()->levels, *of.values(), of.rays.cast().visits.get());
    }
    return ranges;
}

PanelInput Viewer::panel_input(const Vec2& pointer) const {
    PanelInput input;
    input.scene = scene_.get();
    input.scene_bounds = scene_bounds_;
    input.camera = camera();
    input.progress = job_.progress();
    input.cancelled = cancelled_;
    input.build_wait_ms = build_wait_ms_;
    input.cache_bytes = job_.cache().byte_count();
    input.cache_limit = job_.cache().byte_limit();
    input.message = message_;
    input.message_is_error = message_is_error_;
    input.recent = settings_.recent;
    input.picked_place = picked_place_;
    input.picked_count = picked_at_ ? picked_count_ : 0;
    input.heat = compare_.heat().get();
    input.undo_count = undo_.back_count();
    input.redo_count = undo_.forward_count();
    const std::array<double, 2> rates = compare_.rays_per_second();
    for (const Side side : kSides) {
        const SideWork& from = work(side);
        SideInput& to = input.sides[index_of(side)];
        to.built = from.built().get();
        to.tree = from.tree().get();
        to.slow = from.rays.tree_measures().get();
        to.slow_progress = from.rays.tree_progress();
        to.values = from.values().get();
        to.shared_count = from.shared_count();
        to.build_error = from.build_error();
        to.facts = from.facts();
        to.visits = from.rays.cast().visits.get();
        to.ray_hit = from.rays.cast().ray_hit;
        to.check = from.rays.check().get();
        to.check_progress = from.rays.check_progress();
        to.trace = from.trace_state();
        to.rays_per_second = state.compares() ? rates[index_of(side)] : to.trace.rays_per_second;
    }
    point_in(input, pointer);
    return input;
}

void Viewer::point_in(PanelInput& input, const Vec2& pointer) const {
    const FrameLayout layout = make_layout(state);
    const std::optional<PictureHit> picture = picture_at(layout, pointer);
    if (!picture) return;
    const SideWork& of = work(picture->side);
    input.pointed_side = picture->side;
    constexpr size_t kTooManyToTest = 200000;  // without nodes each would be tested for each frame
    const Built* built = of.built().get();
    if (built == nullptr ||
        (built->levels->level_count() <= 1 && scene_->mesh.triangle_count() > kTooManyToTest))
        return;
    input.pointed = point_at(*built, *of.values(), state, pointer_ray(camera(), pointer, picture->rect));
    const PicturePlace& traced = layout.side(picture->side).traced;
    if (!traced.part.contains(pointer)) return;
    const int x = static_cast<int>(pointer.x - traced.rect.x),
              y = static_cast<int>(pointer.y - traced.rect.y);
    for (const Side side : kSides) input.sides[index_of(side)].pixel = work(side).pixel(x, y);
}

}  // namespace boxwood
