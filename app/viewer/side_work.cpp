#include "app/viewer/side_work.h"

namespace boxwood {

void SideWork::clear() {
    update_trace(std::nullopt, false);
    result_ = {};
    build_error_.clear();
    traced_built_.reset();
    counts_.reset();
}

void SideWork::take(const SideResult& result) {
    build_error_ = result.error;
    build_exit_code_ = result.exit_code;
    if (result.built) result_ = result;
}

void SideWork::update_nodes(const SideState& state) {
    const Built* built = result_.built.get();
    const bool is_other = nodes_built_ != result_.built;
    nodes_built_ = result_.built;
    if (is_other || !visibility_ || hidden_shown_ != state.hidden_nodes ||
        isolated_shown_ != state.isolated) {
        hidden_shown_ = state.hidden_nodes;
        isolated_shown_ = state.isolated;
        visibility_ = std::make_shared<const Visibility>(
            built != nullptr ? visible_parts(state, built->levels->list, built->scene->mesh.triangle_count())
                             : Visibility{});
    }
    const bool exists = built != nullptr && state.node < built->levels->list.nodes.size();
    if (!exists) facts_.reset();
    if (exists && (is_other || !facts_ || facts_->node != state.node))
        facts_ = node_facts(built->levels->list, *result_.values, state.node);
}

void SideWork::update_trace(const std::optional<TraceSettings>& settings, bool is_building) {
    if (!settings || !result_.built) {
        if (tracing_) tracer_->stop();
        tracing_.reset();
        return;
    }
    const bool same = tracing_ == settings && traced_built_ == result_.built;
    if (!same || (trace_paused_ && !is_building)) {
        if (!tracer_) tracer_ = std::make_unique<ProgressiveTracer>();
        tracer_->start(result_.built->scene, result_.built->structure, *settings);
        tracing_ = settings;
        traced_built_ = result_.built;
        trace_paused_ = false;
        counted_step_ = 0;
    }
    tracer_->snapshot(image_, image_version_);
    update_counts();
}

void SideWork::update_counts() {
    const int step = tracer_->state().step;
    if (!is_heat(tracing_->shading) || step == 0 || step == counted_step_) return;
    auto counts = std::make_shared<HeatCounts>();
    counts->step = tracer_->snapshot_counts(counts->counts);
    if (counts->step == 0) return;
    counts->width = tracing_->width;
    counts->height = tracing_->height;
    counted_step_ = counts->step;
    counts_ = std::move(counts);
}

void SideWork::pause_trace() {
    if (!tracing_) return;
    tracer_->stop();
    trace_paused_ = true;
}

void SideWork::wait_for_trace() const {
    constexpr double kLong = 1000.0;  // ms
    while (tracing_ && !tracer_->wait(kLong)) {
    }
}

std::optional<PixelValue> SideWork::pixel(int x, int y) const {
    return tracing_ ? tracer_->picked(x, y) : std::nullopt;
}

}  // namespace boxwood
