#pragma once

#include <memory>
#include <optional>

#include "app/viewer/build_job.h"
#include "app/viewer/marks.h"
#include "app/viewer/node_facts.h"
#include "app/viewer/ray_work.h"
#include "core/render/heat_compare.h"
#include "core/render/image.h"
#include "core/render/progressive_tracer.h"

namespace boxwood {

/// What one side of the window has beside its state: the structure of its recipe, what is left to be seen of
/// it, its traced picture, and the rays that were cast through it. One thread.
class SideWork {
public:
    /// Forgets everything: another scene, or no such side.
    void clear();
    /// The answer of a build; without a structure in it what was there stays.
    void take(const SideResult& result);
    const std::string& build_error() const { return build_error_; }
    ExitCode build_exit_code() const { return build_exit_code_; }

    const std::shared_ptr<const Built>& built() const { return result_.built; }
    const std::shared_ptr<const BoxValues>& values() const { return result_.values; }
    const std::shared_ptr<const TreeStats>& tree() const { return result_.tree; }
    uint64_t shared_count() const { return result_.shared_count; }

    /// Finds out anew what the state's nodes need where they or the structure are others.
    void update_nodes(const SideState& state);
    /// What hidden and isolated nodes leave to be seen; null before the first update.
    const std::shared_ptr<const Visibility>& visibility() const { return visibility_; }
    /// Of the selected node; null: none.
    const NodeFacts* facts() const { return facts_ ? &*facts_ : nullptr; }

    /// Traces that picture, or none; while `is_building` a stopped one is not resumed.
    void update_trace(const std::optional<TraceSettings>& settings, bool is_building);
    /// In favour of a build.
    void pause_trace();
    bool is_tracing() const { return tracing_.has_value(); }
    bool has_converged() const { return !tracing_ || tracer_->state().converged; }
    /// The picture is being made, and will go on by itself.
    bool is_trace_busy() const { return tracing_ && !trace_paused_ && !tracer_->state().converged; }
    void wait_for_trace() const;
    TraceState trace_state() const { return tracing_ ? tracer_->state() : TraceState{}; }
    std::optional<PixelValue> pixel(int x, int y) const;
    /// Version 0: none yet.
    const Image& image() const { return image_; }
    uint64_t image_version() const { return image_version_; }
    /// Of a heat picture, the newest that is known; null: none.
    const std::shared_ptr<const HeatCounts>& counts() const { return counts_; }

    RayWork rays;

private:
    void update_counts();

    SideResult result_;
    std::string build_error_;
    ExitCode build_exit_code_ = ExitCode::Done;
    std::shared_ptr<const Built> nodes_built_;  ///< that visibility_ and facts_ are of
    std::vector<uint32_t> hidden_shown_;
    uint32_t isolated_shown_ = kNoIndex;
    std::shared_ptr<const Visibility> visibility_;
    std::optional<NodeFacts> facts_;

    std::unique_ptr<ProgressiveTracer> tracer_;  ///< made when the first traced view is asked for
    std::optional<TraceSettings> tracing_;       ///< what the tracer was started with
    std::shared_ptr<const Built> traced_built_;
    bool trace_paused_ = false;
    Image image_;
    uint64_t image_version_ = 0;
    int counted_step_ = 0;  ///< of counts_, since the last start
    std::shared_ptr<const HeatCounts> counts_;
};

}  // namespace boxwood
