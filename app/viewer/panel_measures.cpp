#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "app/viewer/level_report.h"
#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

constexpr const char* kNoValue = "\u2013";

void reference_rows(const Context& context, const Built& built) {
    const size_t triangles = built.scene->mesh.triangle_count(), made = built.references->refs.size();
    value_row(context, "triangles", grouped(triangles), "Triangles of the scene that structures see.");
    value_row(context, "references made", grouped(made),
              "Boxes that the references stage made; a leaf keeps each primitive once.");
    const double added = static_cast<double>(made) - static_cast<double>(triangles);
    value_row(context, "references added", percent_text(added, static_cast<double>(triangles)),
              "(references made - triangles) / triangles. Lower is better for memory.");
}

uint64_t largest_leaf(const TreeStats& tree) {
    return tree.leaf_sizes.empty() ? 0 : tree.leaf_sizes.size() - 1;
}

void tree_rows(const Context& context, const Built& built, const TreeStats& tree) {
    value_row(context, "references in leaves", grouped(tree.references),
              "References in all leaves, after duplicates of one primitive in a leaf were removed.\n" +
                  grouped(context.input.shared_count) +
                  " triangles of one reference are in several leaves (D shows them in blue).");
    value_row(context, "nodes", grouped(tree.nodes), "Inner nodes and leaves.");
    value_row(context, "leaves", grouped(tree.leaves),
              "Leaves, " + grouped(tree.empty_leaves) + " of them empty; the largest holds " +
                  grouped(largest_leaf(tree)) + " references.");
    value_row(context, "levels", grouped(tree.levels.size()), "Levels; the root is level 0.");
    value_row(context, "bytes", byte_text(built.structure.byte_count()),
              "Memory of the structure that rays traverse.\nIts node list for this window: " +
                  byte_text(built.levels->byte_count()) +
                  "; on the GPU: " + byte_text(context.input.gpu_bytes) +
                  ";\nstages kept for a return: " + byte_text(context.input.cache_bytes) + " of at most " +
                  byte_text(context.input.cache_limit) + ".");
    value_row(context, "SAH cost", number_text(tree.sah_cost),
              "Expected cost of a random ray that meets the root's box, in triangle tests: the sum over all "
              "nodes of (area / root area) x (1 for an inner node, the number of primitives for a leaf). "
              "Lower is better.");
    if (!context.state.show_times) return;
    value_row(context, "build time", time_text(built.references_ms + built.build_ms),
              "References " + time_text(built.references_ms) + ", builder and transforms " +
                  time_text(built.build_ms) +
                  ", as they took when they were run.\nFrom the request to this " +
                  "picture: " + time_text(context.input.build_wait_ms) + ".");
}

void ray_rows(const Context& context) {
    const TraceState& trace = context.input.trace;
    const bool counted = trace.counted_rays > 0;
    const double rays = static_cast<double>(trace.counted_rays);
    const std::string hint =
        context.state.traced == TracedView::Off ? " Shown with the ray-traced view (T)." : "";
    if (context.state.show_times) {
        value_row(context, "rays per second",
                  trace.rays_per_second > 0.0 ? rate_text(trace.rays_per_second) : kNoValue,
                  "Rays of the picture over the time spent on them, on all cores. Higher is better." + hint);
    }
    value_row(context, "nodes per ray",
              counted ? number_text(static_cast<double>(trace.counters.nodes) / rays) : kNoValue,
              "Nodes visited by a primary ray, in the mean. Lower is better." + hint);
    value_row(context, "tests per ray",
              counted ? number_text(static_cast<double>(trace.counters.tests) / rays) : kNoValue,
              "Primitives tested by a primary ray, in the mean. Lower is better." + hint);
}

/// A cell as a number, to sort by.
enum class Column : uint8_t { Level, Nodes, Leaves, References, Cost, Overlap };
struct ColumnText {
    const char* name;
    const char* tip;
};
constexpr std::array<ColumnText, 6> kColumns{{
    {"level", "The root is level 0. A click shows this level alone."},
    {"nodes", "Nodes of this level."},
    {"leaves", "Leaves of this level."},
    {"refs", "References in the leaves of this level."},
    {"cost", "This level's part of the SAH cost. Lower is better."},
    {"overlap",
     "Area of the siblings' common boxes over their parents' area: the probability that a ray which "
     "meets the parent has to visit both. Lower is better."},
}};

double cell_value(const TreeStats& tree, size_t level, Column column) {
    const LevelStats& row = tree.levels[level];
    switch (column) {
        case Column::Level:
            return static_cast<double>(level);
        case Column::Nodes:
            return static_cast<double>(row.nodes);
        case Column::Leaves:
            return static_cast<double>(row.leaves);
        case Column::References:
            return static_cast<double>(row.references);
        case Column::Cost:
            return cost_share(tree, level);
        case Column::Overlap:
            return row.sibling_overlap;
    }
    return 0.0;
}

std::string cell_text(const TreeStats& tree, size_t level, Column column) {
    const double value = cell_value(tree, level, column);
    const bool is_share = column == Column::Cost || column == Column::Overlap;
    return is_share ? percent_text(value, 1.0) : grouped(static_cast<uint64_t>(value));
}

std::vector<size_t> sorted_rows(const TreeStats& tree) {
    std::vector<size_t> order(tree.levels.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (specs == nullptr || specs->SpecsCount == 0) return order;
    const auto column = static_cast<Column>(specs->Specs[0].ColumnIndex);
    const bool down = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    std::ranges::stable_sort(order, [&](size_t a, size_t b) {
        const double x = cell_value(tree, a, column), y = cell_value(tree, b, column);
        return down ? x > y : x < y;
    });
    return order;
}

void right_text(const std::string& text) {
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(free, 0.0f));
    ImGui::TextUnformatted(text.c_str());
}

void level_row(const Context& context, const TreeStats& tree, size_t row, const LevelRange& shown) {
    ImGui::TableNextRow();
    const int level = static_cast<int>(row);
    if (level >= shown.first && level <= shown.last) {
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1,
                               im_packed(Vec4(Vec3(context.colors.accent), 0.16f)));
    }
    for (size_t c = 0; c < kColumns.size(); ++c) {
        ImGui::TableSetColumnIndex(static_cast<int>(c));
        if (c == 0) {
            ImGui::PushID(level);
            if (ImGui::Selectable("##row", false, ImGuiSelectableFlags_SpanAllColumns)) {
                context.state.levels = {level, level};
            }
            ImGui::PopID();
            ImGui::SameLine(0.0f, 0.0f);
        }
        right_text(cell_text(tree, row, static_cast<Column>(c)));
    }
}

}  // namespace

void measures_part(const Context& context) {
    const Built* built = context.input.built;
    heading(context, "Measures");
    if (built == nullptr) {
        note(context, "No structure yet.");
        return;
    }
    reference_rows(context, *built);
    tree_rows(context, *built, *context.input.tree);
    ray_rows(context);
}

void side_tabs(const Context& context) {
    constexpr std::array<const char*, 3> kNames{"Levels", "Node", "Verify"};
    constexpr std::array<const char*, 3> kTips{
        "What each level of the tree holds and costs.",
        "The selected node: its numbers, its path, its triangles. Click a box to select its node.",
        "Speed and wrong rays of both modes, on request, against rational arithmetic."};
    ImGui::Dummy({0.0f, 2.0f * context.scale});
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[2]);
    for (size_t i = 0; i < kNames.size(); ++i) {
        const bool is_shown = context.state.side == static_cast<SidePanel>(i);
        if (i > 0) ImGui::SameLine(0.0f, 18.0f * context.scale);
        ImGui::PushStyleColor(ImGuiCol_Text, im_color(is_shown ? context.colors.text : context.colors.dim));
        ImGui::TextUnformatted(kNames[i]);
        ImGui::PopStyleColor();
        if (ImGui::IsItemClicked()) context.state.side = static_cast<SidePanel>(i);
        const ImVec2 lower = ImGui::GetItemRectMin(), upper = ImGui::GetItemRectMax();
        if (is_shown || ImGui::IsItemHovered()) {
            ImGui::GetWindowDrawList()->AddRectFilled(
                {lower.x, upper.y + 1.0f * context.scale}, {upper.x, upper.y + 3.0f * context.scale},
                im_packed(is_shown ? context.colors.accent : context.colors.dim));
        }
        ImGui::PopFont();
        tooltip(context, kTips[i]);
        ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[2]);
    }
    ImGui::PopFont();
    ImGui::Separator();
}

void level_table_part(const Context& context) {
    const Built* built = context.input.built;
    if (built == nullptr) return;
    const TreeStats& tree = *context.input.tree;
    colored(context.colors.dim, "copy as");
    for (const auto& [name, text] : {std::pair{"TSV", &level_tsv}, std::pair{"Markdown", &level_markdown},
                                     std::pair{"JSON", &level_json}}) {
        ImGui::SameLine();
        if (ImGui::SmallButton(name)) context.actions.push_back(CopyText{text(tree)});
        tooltip(context, std::string("Copies this table as ") + name + ".");
    }
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                                       ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH |
                                       ImGuiTableFlags_SizingStretchProp;
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    if (ImGui::BeginTable("levels", static_cast<int>(kColumns.size()), kFlags, {0.0f, -1.0f})) {
        for (const ColumnText& column : kColumns) ImGui::TableSetupColumn(column.name);
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        for (size_t c = 0; c < kColumns.size(); ++c) {
            ImGui::TableSetColumnIndex(static_cast<int>(c));
            ImGui::TableHeader(kColumns[c].name);
            tooltip(context, std::string(kColumns[c].tip) + " Click: sort.");
        }
        const int deepest = static_cast<int>(tree.levels.size()) - 1;
        const LevelRange shown{std::min(context.state.levels.first, deepest),
                               std::min(context.state.levels.last, deepest)};
        for (const size_t row : sorted_rows(tree)) level_row(context, tree, row, shown);
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

}  // namespace boxwood::panel
