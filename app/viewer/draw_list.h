#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/box_values.h"
#include "app/viewer/state.h"
#include "app/viewer/visits.h"
#include "core/base/box.h"
#include "core/base/vec.h"
#include "core/render/color_map.h"

namespace boxwood {

/// How the surface is drawn.
enum class MeshLook : uint8_t {
    Hidden,  ///< not at all: nothing hides a box
    Depth,   ///< it hides what lies behind it, and leaves its colour to the picture under it
    Shaded,
};

inline constexpr size_t kPaletteSize = 64;

/// What the colours of node boxes mean, and how: as the legend shows it.
struct ColorScale {
    BoxColor meaning = BoxColor::Level;
    ValueScale scale;                          ///< of levels, references, or shares in [0, 1]
    std::array<Vec3, kPaletteSize> palette{};  ///< linear RGB along the scale

    /// Interpolated; linear RGB.
    Vec3 color(double value) const;
};

/// What is known of a node's box, or of a reference's, beyond what was uploaded with it: one word for each.
struct BoxMark {
    static constexpr uint32_t kHidden = 0x80000000u;
    static constexpr uint32_t kVisits = 0x7fffffffu;  ///< bits of the number of visits
};

/// What is known of a triangle: bits.
struct TriangleMark {
    static constexpr uint8_t kSplit = 1;   ///< more than one reference out of the references stage
    static constexpr uint8_t kShared = 2;  ///< in several leaves, though the references stage made one
    static constexpr uint8_t kHidden = 4;
};

/// Boxes that are drawn: of the instance buffer in level order the entries [0, end), without the inner nodes
/// of levels above `first_level`, without their leaves too unless `leaves_above`.
struct BoxSelection {
    uint32_t first_level = 0;
    uint32_t end = 0;
    bool leaves_above = true;
    uint32_t count = 0;         ///< boxes in it; hidden, empty and not visited ones too
    bool empty_cells = true;    ///< leaves without primitives are drawn too
    bool only_visited = false;  ///< boxes whose mark says that no ray visited them are not drawn

    bool operator==(const BoxSelection&) const = default;
};

/// What one frame's 3D view shows: plain data, of lengths in pixels and colours in linear RGB.
struct DrawList {
    MeshLook mesh = MeshLook::Shaded;
    bool wire = false;
    bool red = true;      ///< primitives with more than one reference in red
    bool shared = false;  ///< primitives of which the builder made more references in a colour of their own
    std::optional<BoxSelection> boxes;
    bool reference_boxes = false;                  ///< of split primitives, coloured by primitive
    bool see_through = false;                      ///< hidden parts of boxes dimmer, in place of absent
    ColorScale colors;                             ///< of `boxes`
    std::optional<Box> selected;                   ///< drawn over all
    std::vector<OutlineSegment> selected_outline;  ///< drawn in place of the box `selected`
    std::vector<OutlineSegment> ray;               ///< a picked ray, drawn over all
    uint32_t selected_prim = kNoIndex;
    uint32_t box_budget = 200000;  ///< of each kind of boxes; the largest on screen are drawn
    float line_width = 1.5f;
    float line_casing = 0.0f;  ///< beside each line of a box, in casing_color
    float wire_width = 1.0f;
    float depth_fade = 0.0f;  ///< how much fainter the farthest boxes are, in [0, 1]
    float size_fade = 0.0f;   ///< how much fainter boxes of a few pixels are, in [0, 1]
    float interface_scale = 1.0f;
    Vec3 background_top{0.0f};
    Vec3 background_bottom{0.0f};
    Vec3 wire_color{0.0f};
    Vec3 casing_color{0.0f};
    Vec3 red_color{1.0f, 0.0f, 0.0f};
    Vec3 shared_color{0.0f, 0.0f, 1.0f};
    Vec3 empty_color{0.5f};      ///< of empty cells
    Vec3 unvisited_color{0.5f};  ///< where colours say visits
    Vec3 ray_color{1.0f};
    Vec3 selection_color{1.0f};
    bool axis_cross = true;
};

/// What became of the boxes of one kind in the last frame.
struct BoxCounts {
    uint32_t candidates = 0;  ///< all of the selection
    uint32_t drawn = 0;
    uint32_t outside = 0;      ///< outside the view
    uint32_t under_pixel = 0;  ///< smaller than a pixel
    uint32_t over_budget = 0;  ///< visible, not drawn: smaller on screen than those drawn
    uint32_t empty = 0;        ///< empty cells that are not to be drawn; no candidates

    bool operator==(const BoxCounts&) const = default;
};

/// The boxes of a range of levels, with the leaves above it if asked for.
BoxSelection select_boxes(const LevelTable& levels, const LevelRange& range, bool leaves_above);

/// What the colours of boxes span; of two sides what both span, so that a colour means the same in both.
struct BoxRanges {
    int deepest = 0;  ///< level
    ValueRange references, sah_share;
    uint32_t most_visits = 0;  ///< 0: none are known

    void extend(const LevelTable& levels, const BoxValues& values, const Visits* visits);
    static BoxRanges of(const LevelTable& levels, const BoxValues& values, const Visits* visits);
};

/// A side's 3D view. `levels` and `cast` are the side's; without levels no box is drawn.
DrawList make_draw_list(const ViewerState& state, Side side, const LevelTable& levels,
                        const CastResults& cast, const BoxRanges& ranges);
/// Of the active side, with colours of its own range.
DrawList make_draw_list(const ViewerState& state, const LevelTable& levels, const BoxValues& values,
                        const CastResults& cast = {});

/// "200,000 of 3,100,000 boxes, the largest on screen", and what else was left out.
std::string describe(const BoxCounts& counts);

}  // namespace boxwood
