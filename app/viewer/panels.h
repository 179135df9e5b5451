#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/viewer/action.h"
#include "app/viewer/background.h"
#include "app/viewer/build_job.h"
#include "app/viewer/draw_list.h"
#include "app/viewer/layout.h"
#include "app/viewer/node_facts.h"
#include "app/viewer/pointed.h"
#include "app/viewer/tree_work.h"
#include "app/viewer/visits.h"
#include "bench/picture_check.h"
#include "core/render/heat_compare.h"
#include "core/render/progressive_tracer.h"

namespace boxwood {

/// What was found out for one side.
struct SideInput {
    const Built* built = nullptr;        ///< what is on screen; null: no structure yet
    const TreeStats* tree = nullptr;     ///< of `built`
    const SlowMeasures* slow = nullptr;  ///< of `built`; null: not known yet
    WorkProgress slow_progress;
    const BoxValues* values = nullptr;  ///< of `built`
    uint64_t shared_count = 0;          ///< triangles in several leaves though one reference was made
    std::string build_error;  ///< why the side's recipe is not what is shown; empty: it is, or will be
    const NodeFacts* facts = nullptr;            ///< of the selected node; null: none
    const Visits* visits = nullptr;              ///< that box colours show; null: none (yet)
    Hit ray_hit;                                 ///< of the state's ray
    const bench::PictureCheck* check = nullptr;  ///< null: not asked for, or not done
    WorkProgress check_progress;
    TraceState trace;                  ///< of the traced view; converged or not
    double rays_per_second = 0.0;      ///< 0: not measured (yet)
    std::optional<PixelValue> pixel;   ///< of the traced picture, under the pointer
    BoxCounts boxes, reference_boxes;  ///< of the frame before
};

/// What panels show beside the state: results, progress, what other parts found out.
struct PanelInput {
    const Scene* scene = nullptr;  ///< null: none is open yet
    Box scene_bounds;              ///< empty without a scene
    std::array<SideInput, 2> sides;
    Camera camera;  ///< what the frame shows
    BuildProgress progress;
    const HeatComparison* heat = nullptr;  ///< null: no two heat pictures are shown
    size_t picked_place = 0;               ///< of the selected node among those under the last click
    size_t picked_count = 0;               ///< 0: it was not selected by a click
    bool cancelled = false;                ///< the state's recipes were cancelled
    double build_wait_ms = 0.0;            ///< from request to result of what is on screen
    size_t cache_bytes = 0, cache_limit = 0, gpu_bytes = 0;
    ColorScale scale;                                                   ///< of the boxes of both sides
    Vec3 empty_color{0.0f}, unvisited_color{0.0f}, shared_color{0.0f};  ///< sRGB
    std::optional<Pointed> pointed;
    Side pointed_side = Side::A;  ///< whose picture the pointer is on
    std::string message;          ///< empty: none
    bool message_is_error = false;
    std::span<const std::string> recent;
    size_t undo_count = 0, redo_count = 0;

    const SideInput& side(Side which) const { return sides[index_of(which)]; }
};

/// What widgets remember between frames: text being typed, dialogs. No part of the session.
struct PanelMemory {
    std::string recipe_text;                  ///< as typed
    std::string recipe_shown;                 ///< the state's recipe when recipe_text was last taken from it
    std::string recipe_error;                 ///< why recipe_text is no recipe
    std::string recipe_note;                  ///< what a change in the panel did beyond what was asked for
    std::string recipe_note_of;               ///< the recipe that it made
    std::set<uint32_t> folded_stages;         ///< whose parameters are hidden
    std::string last_b;                       ///< B's recipe when two were compared last
    bool ask_open = false, ask_save = false;  ///< opens the dialog in this frame
    std::string path;                         ///< typed in a dialog
    int verify_count = 1;                     ///< of the choices beside "Verify"
    int dragged_handle = 0;                   ///< of the level slider: 0 none, 1 first, 2 last, 3 both
    float drag_offset = 0.0f;
    bool playing = false;        ///< the frames of an animated scene, one after another
    float frame_seconds = 0.0f;  ///< since the last one, while playing
};

/// All panels, in the frame that ImGui::NewFrame began: edits the state, returns what else is asked for.
/// ImGui only; without a scene or a structure the panels say so.
std::vector<Action> edit(ViewerState& state, const PanelInput& input, const FrameLayout& layout,
                         PanelMemory& memory);

}  // namespace boxwood
