#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "app/viewer/level_report.h"
#include "app/viewer/measures.h"
#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

float text_width(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

/// Both sides beside each other; the better value in colour.
void compare_table(const Context& context, const std::vector<MeasurePair>& pairs) {
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingFixedFit;
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    if (ImGui::BeginTable("compare", 4, kFlags)) {
        // As wide as their texts: a table that sizes itself by right-aligned cells never shrinks.
        std::array<float, 3> widths{text_width("A"), text_width("B"), text_width("A \u2212 B")};
        for (const MeasurePair& pair : pairs) {
            const std::array<std::optional<double>, 3> values{pair.a.value, pair.b.value, pair.difference()};
            for (size_t i = 0; i < values.size(); ++i)
                widths[i] = std::max(widths[i], text_width(measure_text(pair.a.unit, values[i])));
        }
        ImGui::TableSetupColumn("measure", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("A", ImGuiTableColumnFlags_WidthFixed, widths[0]);
        ImGui::TableSetupColumn("B", ImGuiTableColumnFlags_WidthFixed, widths[1]);
        ImGui::TableSetupColumn("A \u2212 B", ImGuiTableColumnFlags_WidthFixed, widths[2]);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        for (const Side side : kSides) {
            ImGui::TableSetColumnIndex(static_cast<int>(index_of(side)) + 1);
            right_text(side_name(side));
            tooltip(context, context.input.side(side).built != nullptr
                                 ? print(context.input.side(side).built->recipe)
                                 : "not built yet");
        }
        ImGui::TableSetColumnIndex(3);
        right_text("A \u2212 B");
        for (const MeasurePair& pair : pairs) {
            const std::optional<Side> winner = pair.winner();
            ImGui::TableNextRow();
            ImGui::TableSetColumnIndex(0);
            colored(context.colors.dim, pair.a.name);
            tooltip(context, pair.a.tip);
            const auto cell = [&](int column, const Measure& of, const std::optional<double>& value,
                                  bool is_better) {
                ImGui::TableSetColumnIndex(column);
                if (is_better) ImGui::PushStyleColor(ImGuiCol_Text, im_color(context.colors.good));
                right_text(measure_text(of.unit, value));
                if (is_better) ImGui::PopStyleColor();
                tooltip(context, of.tip);
            };
            cell(1, pair.a, pair.a.value, winner == Side::A);
            cell(2, pair.b, pair.b.value, winner == Side::B);
            cell(3, pair.a, pair.difference(), false);
        }
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

/// Three digits at most: "12.3", "0.45", "<0.01"; a dash where there is no value.
std::string short_text(double value) {
    if (!std::isfinite(value)) return "\u2013";
    if (value == 0.0) return "0";
    if (value < 0.01) return "<0.01";
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2, value);
    return text;
}

/// A cell as a number, to sort by.
enum class Column : uint8_t { Level, Nodes, Leaves, References, Cost, EndPoints, Overlap, Empty };
constexpr size_t kColumnCount = 8;
struct ColumnText {
    const char* name;
    const char* tip;
};
constexpr std::array<ColumnText, kColumnCount> kColumns{{
    {"level", "The root is level 0. A click shows this level alone."},
    {"nodes", "Nodes of this level."},
    {"leaves", "Leaves of this level."},
    {"refs", "References in the leaves of this level."},
    {"cost", "This level's part of the SAH cost, in %. Lower is better."},
    {"EPO",
     "This level's part of the end-point overlap, in triangle tests: cost of its nodes around the ends of "
     "rays whose triangles are elsewhere. Lower is better."},
    {"over",
     "Overlap, in %: area of the siblings' common boxes over their parents' area, the probability that a "
     "ray which meets the parent has to visit both. Lower is better."},
    {"empty",
     "Empty volume, in %: the share of their parents' boxes (of the area of flat ones) that the nodes of "
     "this level leave empty, the mean weighted by the parents' area."},
}};

/// NaN: not known (yet).
double cell_value(const Context& context, size_t level, Column column) {
    const TreeStats& tree = *context.side.tree;
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
            return 100.0 * cost_share(tree, level);
        case Column::EndPoints:
            return end_point_part(context.side.slow, level);
        case Column::Overlap:
            return 100.0 * row.sibling_overlap;
        case Column::Empty:
            return 100.0 * row.empty_volume;
    }
    return 0.0;
}

std::string cell_text(const Context& context, size_t level, Column column) {
    const double value = cell_value(context, level, column);
    return column < Column::Cost ? grouped(static_cast<uint64_t>(value)) : short_text(value);
}

std::vector<size_t> sorted_rows(const Context& context) {
    std::vector<size_t> order(context.side.tree->levels.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (specs == nullptr || specs->SpecsCount == 0) return order;
    const auto column = static_cast<Column>(specs->Specs[0].ColumnIndex);
    const bool down = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    std::ranges::stable_sort(order, [&](size_t a, size_t b) {
        const double x = cell_value(context, a, column), y = cell_value(context, b, column);
        return down ? x > y : x < y;
    });
    return order;
}

void level_row(const Context& context, size_t row, const LevelRange& shown) {
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
        right_text(cell_text(context, row, static_cast<Column>(c)));
    }
}

}  // namespace

void measures_part(const Context& context) {
    const ViewerState& state = context.state;
    heading(context, "Measures");
    if (!state.compares()) {
        const std::vector<Measure> measures = measures_of(state, context.input, Side::A);
        if (measures.empty()) note(context, "No structure yet.");
        for (const Measure& of : measures)
            value_row(context, of.name, measure_text(of.unit, of.value), of.tip);
        return;
    }
    const std::vector<MeasurePair> pairs =
        pairs_of(measures_of(state, context.input, Side::A), measures_of(state, context.input, Side::B));
    if (pairs.empty()) {
        note(context, "Not both structures yet.");
        return;
    }
    const auto recipe = [&](Side side) { return print(context.input.side(side).built->recipe); };
    copy_buttons(
        context, "measures", [&] { return measures_tsv(pairs); }, [&] { return measures_markdown(pairs); },
        [&] { return measures_json(pairs, recipe(Side::A), recipe(Side::B)); });
    compare_table(context, pairs);
}

void side_tabs(const Context& context) {
    const std::string of = of_side(context.state);
    const Vec4& accent = context.colors.accent;
    const std::array<Tab, 3> all{
        {{"Levels" + of, "What each level of the tree holds and costs.", accent},
         {"Node", "The selected node: its numbers, its path, its triangles. Click a box to select its node.",
          accent},
         {"Verify", "Speed and wrong rays of both modes, on request, against rational arithmetic.", accent}}};
    ImGui::Dummy({0.0f, 2.0f * context.scale});
    const auto shown = static_cast<size_t>(context.state.side_panel);
    if (const std::optional<size_t> chosen = tabs(context, all, shown))
        context.state.side_panel = static_cast<SidePanel>(*chosen);
    ImGui::Separator();
}

/// What heads and cells need; the first head has the arrow of the order at most times.
std::array<float, kColumnCount> column_widths(const TreeStats& tree) {
    LevelStats most;
    for (const LevelStats& level : tree.levels) {
        most.nodes = std::max(most.nodes, level.nodes);
        most.leaves = std::max(most.leaves, level.leaves);
        most.references = std::max(most.references, level.references);
    }
    const std::array<std::string, kColumnCount> longest{"level ww",
                                                        grouped(most.nodes),
                                                        grouped(most.leaves),
                                                        grouped(most.references),
                                                        "<0.01",
                                                        "<0.01",
                                                        "<0.01",
                                                        "<0.01"};
    std::array<float, kColumnCount> widths{};
    for (size_t c = 0; c < kColumnCount; ++c)
        widths[c] = std::max(text_width(kColumns[c].name), text_width(longest[c]));
    return widths;
}

void level_table_part(const Context& context) {
    if (context.side.built == nullptr) return;
    const TreeStats& tree = *context.side.tree;
    copy_buttons(
        context, "levels", [&] { return level_tsv(tree, context.side.slow); },
        [&] { return level_markdown(tree, context.side.slow); },
        [&] { return level_json(tree, context.side.slow); });
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                                       ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH |
                                       ImGuiTableFlags_SizingStretchProp;
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {2.0f * context.scale, 2.0f * context.scale});
    if (ImGui::BeginTable("levels", static_cast<int>(kColumns.size()), kFlags, {0.0f, -1.0f})) {
        const std::array<float, kColumnCount> widths = column_widths(tree);
        for (size_t c = 0; c < kColumns.size(); ++c)
            ImGui::TableSetupColumn(kColumns[c].name, ImGuiTableColumnFlags_WidthStretch, widths[c]);
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        for (size_t c = 0; c < kColumns.size(); ++c) {
            ImGui::TableSetColumnIndex(static_cast<int>(c));
            // A head with a label keeps room for an arrow in every column, where one has it.
            const ImVec2 place = ImGui::GetCursorPos();
            ImGui::TableHeader((std::string("##") + kColumns[c].name).c_str());
            tooltip(context, std::string(kColumns[c].tip) + " Click: sort.");
            ImGui::SetCursorPos(place);
            ImGui::TextUnformatted(kColumns[c].name);
        }
        const int deepest = static_cast<int>(tree.levels.size()) - 1;
        const LevelRange shown{std::min(context.state.levels.first, deepest),
                               std::min(context.state.levels.last, deepest)};
        for (const size_t row : sorted_rows(context)) level_row(context, row, shown);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

}  // namespace boxwood::panel
