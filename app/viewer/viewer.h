#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/viewer/action.h"
#include "app/viewer/build_job.h"
#include "app/viewer/compare_work.h"
#include "app/viewer/panels.h"
#include "app/viewer/pick.h"
#include "app/viewer/session.h"
#include "app/viewer/settings.h"
#include "app/viewer/side_work.h"
#include "app/viewer/undo.h"

namespace boxwood {

/// A running session: its state, the results that belong to it, and the work under way. Neither window nor
/// OpenGL; one thread.
class Viewer {
public:
    explicit Viewer(Session session, Settings settings = {});

    ViewerState state;  ///< edited by panels, keys and mouse between two updates
    PanelMemory panel_memory;

    /// Takes over what the background has finished and starts what the state asks for. `editing`: a widget or
    /// the mouse is being held, so that the change is not whole yet.
    void update(bool editing);
    void apply(const std::vector<Action>& actions);

    /// Opens a scene, a session or a picture in the background; what is shown stays until it is read.
    void open(const std::string& path);
    /// Opens the scene's file again.
    void reload();

    /// Waits until state and results agree and the traced picture has converged. Throws Error where the scene
    /// or the recipe is refused.
    void wait();
    /// Work is under way whose result the window waits for.
    bool busy() const;

    const std::shared_ptr<const Scene>& scene() const { return scene_; }
    const Box& scene_bounds() const { return scene_bounds_; }
    const SideWork& work(Side side) const { return *works_[index_of(side)]; }
    /// Of the active side.
    const std::shared_ptr<const Built>& built() const { return work(state.active_side()).built(); }
    const CastResults& cast() const { return work(state.active_side()).rays.cast(); }
    const std::shared_ptr<const Visibility>& visibility() const {
        return work(state.active_side()).visibility();
    }
    const std::shared_ptr<const bench::PictureCheck>& check() const {
        return work(state.active_side()).rays.check();
    }
    /// Null where no two heat pictures are shown.
    const std::shared_ptr<const HeatComparison>& heat() const { return compare_.heat(); }
    /// What box colours span: one scale for all sides.
    BoxRanges box_ranges() const;

    /// The traced picture that a side shows: its own, or what compares it with the other's.
    struct TracedPicture {
        const Image* image = nullptr;
        uint64_t version = 0;  ///< 0: none yet; never the same for two pictures
    };
    TracedPicture traced_picture(Side side) const;
    /// The state's camera, or the scene's own.
    Camera camera() const;
    /// The session of this moment, for files and the clipboard.
    Session session() const;
    const Settings& settings() const { return settings_; }
    void remember_scale() { settings_.interface_scale = state.interface_scale; }
    /// The state of now becomes the first: there is nothing to undo.
    void forget_steps() { undo_ = Undo(state); }
    /// Throws Error where the first scene was refused, so that there is nothing to show.
    void require_scene() const;
    const std::string& message() const { return message_; }
    const StageCache& cache() const { return job_.cache(); }

    /// What panels show. `pointer`: in the window, in pixels.
    PanelInput panel_input(const Vec2& pointer) const;

private:
    /// What is shown once its scene is read.
    struct Opening {
        Session session;
        bool scene_only = false;  ///< all but scene and camera stays as it is then
    };
    /// What node and triangle numbers belong to.
    struct NodesKey {
        std::string scene;
        std::array<std::string, 2> recipes;
        static NodesKey of(const ViewerState& state) {
            return {state.scene, {state.side(Side::A).recipe, state.side(Side::B).recipe}};
        }
        bool operator==(const NodesKey&) const = default;
    };
    /// Where a traced picture comes from.
    struct PictureSource {
        const void* owner = nullptr;
        uint64_t version = 0;
        bool is_difference = false;
        bool operator==(const PictureSource&) const = default;
    };
    void take(const BuildResult& result);
    /// Whether what is on screen is all that the request asks for.
    bool shows(const BuildRequest& request) const;
    void forget_nodes();
    void update_pictures();
    PictureSource picture_source(Side side) const;
    bool have_converged() const;
    bool shows_two_heats() const {
        return state.compares() && is_heat(state.shading) && state.traced != TracedView::Off;
    }
    std::optional<CompareWork::RaceKey> wanted_race() const;
    float visible_surface(const SideWork& work, const PickPoint& point) const;
    void point_in(PanelInput& input, const Vec2& pointer) const;
    void pick_node(const Vec2& pointer);
    void pick_ray(const Vec2& pointer);
    void focus_selection();
    void swap_sides();
    void request_build();
    void update_trace();
    void show_state(const ViewerState& next);
    void open_session(Session session);
    void say(const std::string& sentence, bool is_error);
    void apply_one(const Action& action);
    void focus(const Vec2& pointer);
    BuildRequest wanted() const;
    std::optional<TraceSettings> wanted_trace() const;

    Session session_;  ///< limits and unknown keys; its state is not kept up to date
    Settings settings_;
    BuildJob job_{std::make_shared<StageCache>()};
    std::optional<BuildRequest> asked_;  ///< of the job, last
    std::optional<BuildRequest> shown_;  ///< what is on screen
    bool shows_stand_in_ = false;        ///< on some side, until the whole answer is there
    std::optional<Opening> opening_;
    bool cancelled_ = false;
    std::string build_error_;
    ExitCode build_exit_code_ = ExitCode::Done;
    double build_wait_ms_ = 0.0;
    std::shared_ptr<const Scene> scene_;
    Box scene_bounds_;

    NodesKey nodes_of_;
    std::optional<Vec2> picked_at_;               ///< pointer of the last click that selected a node
    size_t picked_place_ = 0, picked_count_ = 0;  ///< the selected one among the nodes there

    /// By side; what is found out for B goes where B goes.
    std::array<std::unique_ptr<SideWork>, 2> works_{std::make_unique<SideWork>(),
                                                    std::make_unique<SideWork>()};
    CompareWork compare_;
    std::array<PictureSource, 2> picture_sources_;
    std::array<uint64_t, 2> picture_versions_{};
    uint64_t picture_count_ = 0;

    Undo undo_;
    std::string message_;
    bool message_is_error_ = false;
};

}  // namespace boxwood
