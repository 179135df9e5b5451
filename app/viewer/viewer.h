#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/viewer/action.h"
#include "app/viewer/build_job.h"
#include "app/viewer/marks.h"
#include "app/viewer/node_facts.h"
#include "app/viewer/panels.h"
#include "app/viewer/pick.h"
#include "app/viewer/ray_work.h"
#include "app/viewer/session.h"
#include "app/viewer/settings.h"
#include "app/viewer/undo.h"
#include "core/render/image.h"
#include "core/render/progressive_tracer.h"

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
    const std::shared_ptr<const Built>& built() const { return built_; }
    const std::shared_ptr<const BoxValues>& values() const { return values_; }
    /// What hidden and isolated nodes leave to be seen; null before the first update.
    const std::shared_ptr<const Visibility>& visibility() const { return visibility_; }
    const CastResults& cast() const { return rays_.cast(); }
    const std::shared_ptr<const bench::PictureCheck>& check() const { return rays_.check(); }
    /// The traced picture and its number; number 0: none yet.
    const Image& traced_image() const { return traced_image_; }
    uint64_t traced_version() const { return traced_version_; }
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
        std::string scene, recipe;
        static NodesKey of(const ViewerState& state) { return {state.scene, state.recipe}; }
        bool operator==(const NodesKey&) const = default;
    };
    void take(const BuildResult& result);
    /// Whether what is on screen is all that the request asks for.
    bool shows(const BuildRequest& request) const;
    void forget_nodes();
    void update_nodes();
    std::optional<PickPoint> pick_point(const Vec2& pointer) const;
    float visible_surface(const PickPoint& point) const;
    void pick_node(const Vec2& pointer);
    void pick_ray(const Vec2& pointer);
    void focus_selection();
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
    std::optional<Opening> opening_;
    bool cancelled_ = false;
    std::string build_error_;
    ExitCode build_exit_code_ = ExitCode::Done;
    double build_wait_ms_ = 0.0;
    std::shared_ptr<const Scene> scene_;
    Box scene_bounds_;
    std::shared_ptr<const Built> built_;
    std::shared_ptr<const BoxValues> values_;
    std::shared_ptr<const TreeStats> tree_;
    uint64_t shared_count_ = 0;

    NodesKey nodes_of_;
    std::shared_ptr<const Built> nodes_built_;  ///< that visibility_ and facts_ are of
    std::vector<uint32_t> hidden_shown_;
    uint32_t isolated_shown_ = kNoIndex;
    std::shared_ptr<const Visibility> visibility_;
    std::optional<NodeFacts> facts_;
    std::optional<Vec2> picked_at_;               ///< pointer of the last click that selected a node
    size_t picked_place_ = 0, picked_count_ = 0;  ///< the selected one among the nodes there
    RayWork rays_;

    std::unique_ptr<ProgressiveTracer> tracer_;  ///< made when the first traced view is asked for
    std::optional<TraceSettings> tracing_;       ///< what the tracer was started with
    std::shared_ptr<const Built> traced_built_;
    bool trace_paused_ = false;  ///< it stopped in favour of a build
    Image traced_image_;
    uint64_t traced_version_ = 0;

    Undo undo_;
    std::string message_;
    bool message_is_error_ = false;
};

}  // namespace boxwood
