#pragma once

#include <memory>

#include "app/viewer/background.h"
#include "core/catalog/pipeline.h"
#include "core/measure/end_point_overlap.h"
#include "core/measure/leaf_count_variability.h"

namespace boxwood {

/// Measures of a structure that take long.
struct SlowMeasures {
    EndPointOverlap end_points;
    LeafCounts leaf_counts;
};

/// Finds out a structure's measures in the background. One thread.
class TreeWork {
public:
    /// Takes over what is finished; starts what `built` (null: nothing) needs once it `may_start`.
    void update(const std::shared_ptr<const Built>& built, bool may_start);

    /// Of the structure of the last update; null: not known yet.
    const std::shared_ptr<const SlowMeasures>& measures() const { return measures_; }
    WorkProgress progress() const { return work_.progress(); }
    bool busy() const { return is_due_ || work_.progress().running; }
    void wait() const { work_.wait(); }

private:
    std::shared_ptr<const Built> built_;
    std::shared_ptr<const SlowMeasures> measures_;
    bool is_due_ = false;  ///< asked for and not started
    Background<SlowMeasures> work_;
};

}  // namespace boxwood
