#pragma once

#include <memory>
#include <optional>

#include "app/viewer/background.h"
#include "app/viewer/layout.h"
#include "app/viewer/tree_work.h"
#include "app/viewer/visits.h"
#include "bench/picture_check.h"
#include "core/catalog/pipeline.h"

namespace boxwood {

/// What a session asks for beside the traced picture: the picked ray, the visits of the nodes, the check of
/// the picture, and measures of the tree. What takes long is done in the background. One thread.
class RayWork {
public:
    /// Takes over what is finished and starts what the state asks for. A check is of the structure, view and
    /// size it was asked for: where one of these changes the state's request is taken back. It waits until
    /// `may_check`, as measures do.
    void update(ViewerState& state, const std::shared_ptr<const Built>& built, const Camera& camera,
                bool may_check);
    /// Stops the check; the state's request is taken back.
    void cancel_check(ViewerState& state);

    const CastResults& cast() const { return cast_; }
    /// Null: not asked for, or not done.
    const std::shared_ptr<const bench::PictureCheck>& check() const { return check_; }
    /// Null: not known yet, or no panel shows them.
    const std::shared_ptr<const SlowMeasures>& tree_measures() const { return tree_work_.measures(); }
    WorkProgress tree_progress() const { return tree_work_.progress(); }
    WorkProgress check_progress() const { return check_work_.progress(); }
    WorkProgress visits_progress() const { return visits_work_.progress(); }
    bool busy() const {
        return is_check_due_ || visits_progress().running || check_progress().running || tree_work_.busy();
    }
    void wait() const;

private:
    struct VisitsKey {
        std::shared_ptr<const Built> built;
        Mode mode = Mode::Exact;
        std::optional<PickedRay> ray{};  ///< none: of the picture
        Camera camera{};
        int width = 0, height = 0;
        bool operator==(const VisitsKey&) const = default;
    };
    struct CheckKey {
        std::shared_ptr<const Built> built;
        Camera camera;
        int width = 0, height = 0, rays = 0;
        bool operator==(const CheckKey&) const = default;
    };
    void update_ray(const ViewerState& state, const std::shared_ptr<const Built>& built);
    void update_visits(const ViewerState& state, const std::shared_ptr<const Built>& built,
                       const Camera& camera);
    void update_check(ViewerState& state, const std::shared_ptr<const Built>& built, const Camera& camera);
    void start_check(bool is_timed);

    CastResults cast_;
    std::optional<VisitsKey> hit_of_, visits_of_;  ///< what was asked for last; none: nothing
    std::shared_ptr<const bench::PictureCheck> check_;
    std::optional<CheckKey> check_of_, checked_;  ///< what was asked for, what the last result is of
    std::shared_ptr<const bench::PictureCheck> last_check_;
    bool is_check_due_ = false;  ///< asked for and not started
    Background<Visits> visits_work_;
    Background<bench::PictureCheck> check_work_;
    TreeWork tree_work_;
};

}  // namespace boxwood
