#include "app/viewer/layout.h"

#include <algorithm>
#include <cmath>

namespace boxwood {
namespace {

constexpr float kLeftWidth = 296.0f, kRightWidth = 344.0f, kStatusHeight = 24.0f;  // at interface scale 1
constexpr float kNarrowestView = 180.0f;
constexpr float kBarReach = 6.0f;  // pixels to either side of a wipe bar, at interface scale 1

ViewRect left_part(const ViewRect& rect, float width) { return {rect.x, rect.y, width, rect.height}; }
ViewRect right_part(const ViewRect& rect, float width) {
    return {rect.x + rect.width - width, rect.y, width, rect.height};
}
ViewRect upper_half(const ViewRect& rect) {
    return {rect.x, rect.y, rect.width, std::floor(0.5f * rect.height)};
}
ViewRect lower_half(const ViewRect& rect) {
    const float height = std::floor(0.5f * rect.height);
    return {rect.x, rect.y + rect.height - height, rect.width, height};
}

/// The pictures of one recipe alone, or of both at the same place.
SideLayout one_place(const ViewerState& state, const ViewRect& view) {
    ViewRect scene = view, traced{view.x, view.y, 0.0f, 0.0f};
    if (state.traced == TracedView::Over) traced = view;
    if (state.traced == TracedView::Beside) {
        scene = left_part(view, std::floor(0.5f * view.width));
        traced = right_part(view, scene.width);
    }
    return {{scene, scene}, {traced, traced}};
}

/// Divides a picture of both sides at the state's wipe.
WipeBar divide(float wipe, PicturePlace& a, PicturePlace& b) {
    const ViewRect& rect = a.rect;
    const float width = std::round(std::clamp(wipe, 0.0f, 1.0f) * rect.width);
    a.part = left_part(rect, width);
    b.part = right_part(rect, rect.width - width);
    return {rect.x + width, rect};
}

void lay_out_wipe(const ViewerState& state, FrameLayout& layout) {
    SideLayout &a = layout.sides[0], &b = layout.sides[1];
    a = b = one_place(state, layout.view);
    const bool is_over = state.traced == TracedView::Over;
    layout.bars[0] = divide(state.wipe, a.scene, b.scene);
    if (is_over) a.traced.part = a.scene.part, b.traced.part = b.scene.part;
    if (state.traced == TracedView::Beside && !state.shows_difference())
        layout.bars[1] = divide(state.wipe, a.traced, b.traced);
}

void lay_out_beside(const ViewerState& state, FrameLayout& layout) {
    const ViewRect& view = layout.view;
    const float width = std::floor(0.5f * view.width);
    for (const Side side : kSides) {
        SideLayout& place = layout.sides[index_of(side)];
        const ViewRect column = side == Side::A ? left_part(view, width) : right_part(view, width);
        if (state.traced != TracedView::Beside) {
            place = one_place(state, column);
            continue;
        }
        const ViewRect scene = upper_half(column);
        const ViewRect traced = lower_half(state.shows_difference() ? view : column);
        place = {{scene, scene}, {traced, traced}};
    }
}

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
    if (!state.compares()) {
        layout.sides[0] = one_place(state, layout.view);
    } else if (state.compare_view == CompareView::Wipe) {
        lay_out_wipe(state, layout);
    } else {
        lay_out_beside(state, layout);
    }
    return layout;
}

std::optional<PictureHit> picture_at(const FrameLayout& layout, const Vec2& position) {
    for (const bool is_traced : {false, true}) {
        for (const Side side : kSides) {
            const SideLayout& places = layout.side(side);
            const PicturePlace& place = is_traced ? places.traced : places.scene;
            if (place.part.contains(position)) return PictureHit{side, is_traced, place.rect};
        }
    }
    return std::nullopt;
}

std::optional<WipeBar> bar_at(const FrameLayout& layout, const Vec2& position, float scale) {
    for (const std::optional<WipeBar>& bar : layout.bars) {
        if (!bar || !bar->rect.contains(position)) continue;
        if (std::abs(position.x - bar->x) <= kBarReach * scale) return bar;
    }
    return std::nullopt;
}

float wipe_at(const WipeBar& bar, float x) {
    return bar.rect.width > 0.0f ? std::clamp((x - bar.rect.x) / bar.rect.width, 0.0f, 1.0f) : 0.5f;
}

}  // namespace boxwood
