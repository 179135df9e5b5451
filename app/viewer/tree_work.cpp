#include "app/viewer/tree_work.h"

namespace boxwood {

void TreeWork::update(const std::shared_ptr<const Built>& built, bool may_start) {
    if (std::optional<SlowMeasures> measures = work_.take())
        measures_ = std::make_shared<const SlowMeasures>(std::move(*measures));
    if (built_ != built) {
        built_ = built;
        measures_.reset();
        work_.cancel();
        is_due_ = built != nullptr;
    }
    if (!is_due_ || !may_start) return;
    is_due_ = false;
    work_.start([built](Task& task) {
        const NodeList& list = built->levels->list;
        SlowMeasures measures;
        measures.leaf_counts = count_leaves_on_lines(list, task);
        measures.end_points = end_point_overlap(list, built->scene->mesh, task);
        return measures;
    });
}

}  // namespace boxwood
