#include "app/viewer/layout.h"

#include <cmath>

namespace boxwood {
namespace {

constexpr float kLeftWidth = 296.0f, kRightWidth = 300.0f, kStatusHeight = 24.0f;  // at interface scale 1
constexpr float kNarrowestView = 200.0f;

}  // namespace

FrameLayout make_layout(const ViewerState& state) {
    FrameLayout layout;
    const float width = static_cast<float>(state.width), height = static_cast<float>(state.height);
    layout.view = {0.0f, 0.0f, width, height};
    const float scale = state.interface_scale;
    const float left = std::round(kLeftWidth * scale), right = std::round(kRightWidth * scale);
    const float status = std::round(kStatusHeight * scale);
    if (state.show_panels && width >= left + right + kNarrowestView && height > 2.0f * status) {
        layout.left = {0.0f, 0.0f, left, height};
        layout.right = {width - right, 0.0f, right, height};
        layout.view = {left, 0.0f, width - left - right, height - status};
        layout.status = {left, height - status, layout.view.width, status};
    }
    layout.scene = layout.view;
    layout.traced = {layout.view.x, layout.view.y, 0.0f, 0.0f};
    if (state.traced == TracedView::Over) layout.traced = layout.view;
    if (state.traced == TracedView::Beside) {
        layout.scene.width = std::floor(0.5f * layout.view.width);
        layout.traced = layout.scene;
        layout.traced.x += layout.view.width - layout.scene.width;
    }
    return layout;
}

}  // namespace boxwood
