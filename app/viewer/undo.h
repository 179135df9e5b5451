#pragma once

#include <optional>
#include <vector>

#include "app/viewer/state.h"

namespace boxwood {

/// Undo and redo of every setting: snapshots of the state. While an edit goes on (a slider is held, the mouse
/// turns the camera) nothing is kept, so that a drag is one step.
class Undo {
public:
    explicit Undo(ViewerState state) : current_(std::move(state)) {}

    /// The state after a frame. A change becomes a step once `editing` is false.
    void note(const ViewerState& state, bool editing);
    /// The state one step back or forward; nothing if there is none. `state` is what is shown now: a change
    /// that was not noted yet becomes a step first.
    std::optional<ViewerState> back(const ViewerState& state);
    std::optional<ViewerState> forward(const ViewerState& state);

    size_t back_count() const { return past_.size(); }
    size_t forward_count() const { return future_.size(); }

private:
    static constexpr size_t kMaxSteps = 500;
    ViewerState current_;
    std::vector<ViewerState> past_, future_;  ///< the nearest step last
};

}  // namespace boxwood
