#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/viewer/clipboard.h"
#include "app/viewer/viewer.h"
#include "core/base/error.h"

namespace boxwood {

void Viewer::show_state(const ViewerState& next) {
    const int width = state.width, height = state.height;
    state = next;
    state.width = width;
    state.height = height;
    nodes_of_ = NodesKey::of(state);
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
    const std::optional<PictureHit> picture = picture_at(make_layout(state), pointer);
    if (!picture || !work(picture->side).built()) return;
    const SideWork& of = work(picture->side);
    const auto pointed =
        point_at(*of.built(), *of.values(), state, pointer_ray(camera(), pointer, picture->rect));
    if (pointed) state.camera = focus_on(camera(), pointed->point, scene_bounds_);
}

float Viewer::visible_surface(const SideWork& of, const PickPoint& point) const {
    if (!state.show_mesh) return point.surface_t;
    Ray ray = pointer_ray(point.camera, point.pointer, point.view);
    constexpr int kMostHidden = 1000;  // triangles passed through
    const Visibility& visibility = *of.visibility();
    for (int i = 0; i < kMostHidden; ++i) {
        Hit hit;
        of.built()->structure.closest_hits(scene_->mesh, std::span(&ray, 1), std::span(&hit, 1), state.mode,
                                           Task{});
        if (!hit.is_hit() || visibility.is_whole() || visibility.triangles[hit.prim] != 0) return hit.t;
        ray.t_min = std::nextafter(hit.t, std::numeric_limits<float>::infinity());
    }
    return point.surface_t;
}

void Viewer::pick_node(const Vec2& pointer) {
    const std::optional<PictureHit> picture = picture_at(make_layout(state), pointer);
    if (!picture || !work(picture->side).built()) return;
    const SideWork& of = work(picture->side);
    if (!of.visibility()) return;
    PickPoint point{pointer, picture->rect, camera(), std::numeric_limits<float>::infinity()};
    point.surface_t = visible_surface(of, point);
    const std::vector<uint32_t> candidates =
        pick_nodes(state, *of.built()->levels, *of.visibility(), of.rays.cast().visits.get(), point);
    constexpr float kSamePlace = 3.0f;  // pixels
    const bool is_again = picked_at_ && state.active_side() == picture->side &&
                          glm::distance(*picked_at_, pointer) <= kSamePlace;
    if (state.compares()) state.active = picture->side;
    SideState& side = state.side();
    side.node = next_candidate(candidates, is_again ? side.node : kNoIndex);
    state.prim = kNoIndex;
    if (!is_again) picked_at_ = pointer;
    picked_count_ = candidates.size();
    picked_place_ = static_cast<size_t>(std::ranges::find(candidates, side.node) - candidates.begin());
    if (side.node == kNoIndex) {
        picked_at_.reset();
    } else {
        state.side_panel = SidePanel::Node;
    }
}

void Viewer::pick_ray(const Vec2& pointer) {
    const std::optional<PictureHit> picture = picture_at(make_layout(state), pointer);
    if (!picture || !work(picture->side).built()) return;
    const Ray ray = pointer_ray(camera(), pointer, picture->rect);
    state.ray = PickedRay{ray.origin, ray.direction};
    state.box_color = BoxColor::Visits;
    state.visit_rays = VisitRays::Picked;
}

void Viewer::focus_selection() {
    if (!built()) return;
    const NodeList& list = built()->levels->list;
    Box box;
    if (state.prim < scene_->mesh.triangle_count()) {
        box = scene_->mesh.triangle(state.prim).bounds();
    } else if (state.side().node < list.nodes.size()) {
        box = list.nodes[state.side().node].bounds;
    }
    if (!box.is_empty()) state.camera = whole_view(camera(), box, up_vector(state.up_axis));
}

void Viewer::swap_sides() {
    if (!state.compares()) return;
    std::swap(state.sides[0], state.sides[1]);
    state.active = other_side(state.active);
    std::swap(nodes_of_.recipes[0], nodes_of_.recipes[1]);
    std::swap(works_[0], works_[1]);
    if (shown_) std::swap(shown_->recipes[0], shown_->recipes[1]);
    picked_at_.reset();
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
            nodes_of_ = NodesKey::of(state);
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
        cancelled_ = !shows(*asked_);
    } else if (std::holds_alternative<BuildAgain>(action)) {
        asked_.reset();
    } else if (std::holds_alternative<DismissMessage>(action)) {
        message_.clear();
    } else if (const auto* point = std::get_if<FocusPoint>(&action)) {
        focus(point->pointer);
    } else if (std::holds_alternative<FocusSelection>(action)) {
        focus_selection();
    } else if (const auto* pick = std::get_if<PickNode>(&action)) {
        pick_node(pick->pointer);
    } else if (const auto* ray = std::get_if<PickRay>(&action)) {
        pick_ray(ray->pointer);
    } else if (std::holds_alternative<SwapSides>(action)) {
        swap_sides();
    } else if (std::holds_alternative<CancelCheck>(action)) {
        for (const std::unique_ptr<SideWork>& of : works_) of->rays.cancel_check(state);
    } else if (const auto* store = std::get_if<StoreView>(&action)) {
        state.stored_views[static_cast<size_t>(store->slot)] = camera();
        say("stored view " + std::to_string(store->slot + 1), false);
    }
}

}  // namespace boxwood
