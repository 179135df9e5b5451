#pragma once

#include <string>
#include <variant>

#include "core/base/vec.h"

namespace boxwood {

/// What panels, keys and dropped files ask for beyond a change of the state.
struct OpenPath {
    std::string path;  ///< a scene, a session or a picture with one, told apart by content
};
struct SaveSession {
    std::string path;
};
struct CopySession {};
struct PasteSession {};
struct CopyText {
    std::string text;
};
struct UndoStep {};
struct RedoStep {};
struct CancelWork {};
struct BuildAgain {};      ///< after a cancel
struct DismissMessage {};  ///< the user has read it
struct FocusPoint {
    Vec2 pointer;  ///< in the window, in pixels
};
struct FocusSelection {};  ///< the selected triangle or node
struct PickNode {
    Vec2 pointer;  ///< in the window, in pixels; the same place again: the next node there
};
struct PickRay {
    Vec2 pointer;
};
struct SwapSides {};  ///< A becomes B with all that was found out for it
struct CancelCheck {};
struct StoreView {
    int slot;  ///< 0 to 8
};

using Action = std::variant<OpenPath, SaveSession, CopySession, PasteSession, CopyText, UndoStep, RedoStep,
                            CancelWork, BuildAgain, DismissMessage, FocusPoint, FocusSelection, PickNode,
                            PickRay, SwapSides, CancelCheck, StoreView>;

}  // namespace boxwood
