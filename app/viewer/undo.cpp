#include "app/viewer/undo.h"

#include <utility>

namespace boxwood {
namespace {

/// What belongs to the window, not to the settings: undo leaves it as it is.
ViewerState with_window_of(ViewerState state, const ViewerState& shown) {
    state.width = shown.width;
    state.height = shown.height;
    return state;
}

}  // namespace

void Undo::note(const ViewerState& state, bool editing) {
    if (editing || with_window_of(current_, state) == state) return;
    past_.push_back(std::exchange(current_, state));
    if (past_.size() > kMaxSteps) past_.erase(past_.begin());
    future_.clear();
}

std::optional<ViewerState> Undo::back(const ViewerState& state) {
    note(state, false);
    if (past_.empty()) return std::nullopt;
    future_.push_back(std::exchange(current_, std::move(past_.back())));
    past_.pop_back();
    return with_window_of(current_, state);
}

std::optional<ViewerState> Undo::forward(const ViewerState& state) {
    note(state, false);
    if (future_.empty()) return std::nullopt;
    past_.push_back(std::exchange(current_, std::move(future_.back())));
    future_.pop_back();
    return with_window_of(current_, state);
}

}  // namespace boxwood
