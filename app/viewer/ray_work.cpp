#include "app/viewer/ray_work.h"

namespace boxwood {
namespace {

constexpr double kTimingSeconds = 1.0;

}  // namespace

void RayWork::update(ViewerState& state, const std::shared_ptr<const Built>& built, const Camera& camera,
                     bool may_check) {
    if (std::optional<Visits> visits = visits_work_.take())
        cast_.visits = std::make_shared<const Visits>(std::move(*visits));
    if (std::optional<bench::PictureCheck> check = check_work_.take()) {
        check_ = last_check_ = std::make_shared<const bench::PictureCheck>(std::move(*check));
        checked_ = check_of_;
    }
    update_ray(state, built);
    update_visits(state, built, camera);
    update_check(state, built, camera);
    if (is_check_due_ && may_check) start_check(state.show_times);
    tree_work_.update(state.show_panels ? built : nullptr, may_check && !check_progress().running);
}

void RayWork::update_ray(const ViewerState& state, const std::shared_ptr<const Built>& built) {
    std::optional<VisitsKey> key;
    if (built && state.ray) key = VisitsKey{.built = built, .mode = state.mode, .ray = state.ray};
    if (hit_of_ == key) return;
    hit_of_ = key;
    cast_.ray_hit = Hit{};
    if (!key) return;
    const Ray ray = ray_of(*state.ray);
    built->structure.closest_hits(built->scene->mesh, std::span(&ray, 1), std::span(&cast_.ray_hit, 1),
                                  state.mode, Task{});
}

void RayWork::update_visits(const ViewerState& state, const std::shared_ptr<const Built>& built,
                            const Camera& camera) {
    std::optional<VisitsKey> key;
    if (built && state.box_color == BoxColor::Visits) {
        if (state.visit_rays == VisitRays::Picture) {
            const ViewRect view = make_layout(state).side(Side::A).scene.rect;
            key = VisitsKey{.built = built,
                            .mode = state.mode,
                            .camera = camera,
                            .width = static_cast<int>(view.width),
                            .height = static_cast<int>(view.height)};
            if (key->width <= 0 || key->height <= 0) key.reset();
        } else if (state.ray) {
            key = VisitsKey{.built = built, .mode = state.mode, .ray = state.ray};
        }
    }
    if (visits_of_ == key) return;
    // What is shown stays until the next is whole, but not over another structure or other rays.
    const bool is_like =
        key && visits_of_ && key->built == visits_of_->built && !key->ray && !visits_of_->ray;
    if (!is_like) cast_.visits.reset();
    visits_of_ = key;
    visits_work_.cancel();
    if (!key) return;
    if (key->ray) {
        Task task;
        const Ray ray = ray_of(*key->ray);
        cast_.visits =
            std::make_shared<const Visits>(count_visits(*built, std::span(&ray, 1), key->mode, task));
        return;
    }
    visits_work_.start([key = *key](Task& task) {
        return count_visits(*key.built, picture_rays(key.camera, key.width, key.height), key.mode, task);
    });
}

void RayWork::update_check(ViewerState& state, const std::shared_ptr<const Built>& built,
                           const Camera& camera) {
    if (!built && state.verify_rays > 0 && !check_of_) return;  // it waits for the first structure
    const SideLayout places = make_layout(state).side(Side::A);
    const ViewRect& view = (state.traced == TracedView::Off ? places.scene : places.traced).rect;
    CheckKey key{built, camera, static_cast<int>(view.width), static_cast<int>(view.height),
                 state.verify_rays};
    if (check_of_ && state.verify_rays > 0) {
        CheckKey same_view = key;
        same_view.rays = check_of_->rays;
        if (same_view != *check_of_) state.verify_rays = 0;
    }
    if (state.verify_rays == 0 || key.width <= 0 || key.height <= 0) {
        if (check_of_) check_work_.cancel();
        check_of_.reset();
        check_.reset();
        is_check_due_ = false;
        return;
    }
    if (check_of_ == key) return;
    check_of_ = key;
    check_.reset();
    check_work_.cancel();
    is_check_due_ = checked_ != key;
    if (!is_check_due_) check_ = last_check_;
}

void RayWork::start_check(bool is_timed) {
    is_check_due_ = false;
    check_work_.start([key = *check_of_, is_timed](Task& task) {
        const bench::PictureCheckSettings settings{.camera = key.camera,
                                                   .width = key.width,
                                                   .height = key.height,
                                                   .sample_count = static_cast<uint64_t>(key.rays),
                                                   .seconds = is_timed ? kTimingSeconds : 0.0};
        return bench::check_picture(key.built->scene->mesh, key.built->structure, settings, task);
    });
}

void RayWork::cancel_check(ViewerState& state) {
    state.verify_rays = 0;
    check_work_.cancel();
    check_of_.reset();
    check_.reset();
    is_check_due_ = false;
}

void RayWork::wait() const {
    visits_work_.wait();
    check_work_.wait();
    tree_work_.wait();
}

}  // namespace boxwood
