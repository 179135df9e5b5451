#include <imgui.h>
#include <imgui_stdlib.h>

#include <optional>
#include <set>
#include <utility>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"
#include "app/viewer/recipe_edit.h"
#include "core/base/error.h"

namespace boxwood::panel {
namespace {

std::string stage_tip(const CatalogEntry& entry) {
    std::string text = std::string(entry.id) + ": " + entry.label + "\n" + entry.source;
    if (!entry.exact) text += "\nApproximate: its answers are not those of the mesh.";
    return text;
}

/// Where a stage's panel begins: its name folds and unfolds the parameters. True if they are shown. `column`:
/// where what follows stands, in pixels at scale 1.
bool stage_head(const Context& context, const char* label, float column = 104.0f) {
    std::set<uint32_t>& folded = context.memory.folded_stages;
    const uint32_t id = ImGui::GetID(label);
    const bool is_open = !folded.contains(id);
    ImGui::AlignTextToFramePadding();
    colored(context.colors.dim, std::string(is_open ? "\u25be " : "\u25b8 ") + label);
    if (ImGui::IsItemClicked()) {
        if (is_open) {
            folded.insert(id);
        } else {
            folded.erase(id);
        }
    }
    tooltip(context, is_open ? "Click: folds this stage's parameters away." : "Click: shows its parameters.");
    ImGui::SameLine(column * context.scale);
    return is_open;
}

/// The rows of a table beside each other, and which of them a stage is; the one that was picked, or nullptr.
/// A folded stage shows its parameters in short. `room`: that is left at the right end.
const CatalogEntry* pick(const Context& context, const Stage& current, bool is_open,
                         const std::vector<const CatalogEntry*>& rows, float room = 0.0f) {
    const CatalogEntry* picked = nullptr;
    ImGui::SetNextItemWidth(room > 0.0f ? -room : -1.0f);
    const std::string shown = is_open ? current.entry().id : current.text();
    if (ImGui::BeginCombo("##stage", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
        for (const CatalogEntry* entry : rows) {
            if (ImGui::Selectable(entry->id, entry == &current.entry())) picked = entry;
            tooltip(context, stage_tip(*entry));
            ImGui::SameLine(150.0f * context.scale);
            colored(context.colors.dim, entry->label);
        }
        ImGui::EndCombo();
    }
    tooltip(context, stage_tip(current.entry()) + (is_open ? "" : "\n" + current.text()));
    return picked;
}

std::vector<const CatalogEntry*> rows_of(std::span<const CatalogEntry> table) {
    std::vector<const CatalogEntry*> rows;
    for (const CatalogEntry& entry : table) rows.push_back(&entry);
    return rows;
}

/// A button that is only there to be pressed where the recipe it makes fits.
bool move_button(const Context& context, const char* sign, bool fits, const std::string& tip) {
    ImGui::SameLine(0.0f, 3.0f * context.scale);
    ImGui::BeginDisabled(!fits);
    const bool is_pressed = ImGui::Button(sign, {20.0f * context.scale, 0.0f});
    ImGui::EndDisabled();
    tooltip(context, fits ? tip : tip + " Not here: the stages would not fit together.");
    return is_pressed;
}

/// One transform; nothing if it stays as it is.
std::optional<Recipe> transform_row(const Context& context, Recipe& recipe, size_t i, bool& changed) {
    Stage& stage = recipe.transforms[i];
    const bool is_open = stage_head(context, "then", 64.0f);
    std::vector<const CatalogEntry*> rows;
    for (const CatalogEntry& entry : transform_catalog())
        if (fits_after(recipe, i, entry)) rows.push_back(&entry);
    if (const CatalogEntry* entry = pick(context, stage, is_open, rows, 69.0f * context.scale)) {
        stage = Stage(*entry);
        context.memory.recipe_note = drop_misfits(recipe);
        return recipe;
    }
    const bool fits_up = i > 0 && all_fit(with_swapped(recipe, i - 1));
    const bool fits_down = i + 1 < recipe.transforms.size() && all_fit(with_swapped(recipe, i));
    if (move_button(context, "\u2191", fits_up, "Before the transform above."))
        return with_swapped(recipe, i - 1);
    if (move_button(context, "\u2193", fits_down, "After the transform below."))
        return with_swapped(recipe, i);
    if (move_button(context, "\u00d7", true, "Takes this transform out.")) {
        recipe.transforms.erase(recipe.transforms.begin() + static_cast<std::ptrdiff_t>(i));
        context.memory.recipe_note = drop_misfits(recipe);
        return recipe;
    }
    if (is_open) changed |= stage_widgets(context, stage);
    return std::nullopt;
}

void add_transform(const Context& context, Recipe& recipe, bool& changed) {
    std::vector<std::pair<const CatalogEntry*, size_t>> fitting;
    for (const CatalogEntry& entry : transform_catalog())
        if (const std::optional<size_t> place = place_for(recipe, entry)) fitting.push_back({&entry, *place});
    if (fitting.empty()) return;
    ImGui::SetNextItemWidth(-1.0f);
    std::optional<std::pair<const CatalogEntry*, size_t>> added;
    if (ImGui::BeginCombo("##add", "add a transform")) {
        for (const auto& row : fitting) {
            const bool is_last = row.second == recipe.transforms.size();
            if (ImGui::Selectable(row.first->id)) added = row;
            tooltip(context, stage_tip(*row.first));
            ImGui::SameLine(110.0f * context.scale);
            colored(context.colors.dim,
                    is_last ? row.first->label
                            : std::string("before ") + recipe.transforms[row.second].entry().id);
        }
        ImGui::EndCombo();
    }
    tooltip(context, "Transforms that fit what the recipe makes, at its end or before what comes later.");
    if (!added) return;
    recipe = with_inserted(recipe, added->second, *added->first);
    changed = true;
}

bool transform_widgets(const Context& context, Recipe& recipe) {
    bool changed = false;
    std::optional<Recipe> next;
    for (size_t i = 0; i < recipe.transforms.size() && !next; ++i) {
        ImGui::PushID(static_cast<int>(i));
        next = transform_row(context, recipe, i, changed);
        ImGui::PopID();
    }
    if (next) {
        recipe = *next;
        return true;
    }
    add_transform(context, recipe, changed);
    return changed;
}

/// What the references stage did: the consequence of its sliders, beside them.
void consequence(const Context& context) {
    const Built* built = context.side.built;
    if (built == nullptr) return;
    const size_t triangles = built->scene->mesh.triangle_count(), made = built->references->refs.size();
    const double added = static_cast<double>(made) - static_cast<double>(triangles);
    const bool more = made > triangles;
    value_row(context, "references",
              grouped(made) + (more ? "  +" + percent_text(added, static_cast<double>(triangles)) : ""),
              "References made by the first stage: " + grouped(made) + " for " + grouped(triangles) +
                  " triangles, " + grouped(more ? made - triangles : 0) +
                  " added. Fewer is better for memory; tighter boxes are better for rays.");
    const size_t split = built->references->split_count;
    value_row(context, "triangles split", grouped(split),
              "Triangles with more than one reference, " +
                  percent_text(static_cast<double>(split), static_cast<double>(triangles)) +
                  " of all. They are red in the picture.");
    for (const auto& [reason, count] : built->skipped) {
        value_row(context, ("skipped, " + reason).c_str(), grouped(count),
                  "Not done because this scene does not need it: " + reason + ".");
    }
}

/// The recipe as text; a change takes effect when it is a recipe.
void recipe_text(const Context& context) {
    PanelMemory& memory = context.memory;
    if (memory.recipe_shown != context.state.side().recipe) {
        memory.recipe_shown = memory.recipe_text = context.state.side().recipe;
        memory.recipe_error.clear();
        if (memory.recipe_note_of != context.state.side().recipe) memory.recipe_note.clear();
    }
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::InputText("##recipe", &memory.recipe_text)) {
        try {
            const std::string canonical = print(parse_recipe(memory.recipe_text));
            memory.recipe_error.clear();
            context.state.side().recipe = memory.recipe_shown = canonical;
        } catch (const Error& error) {
            memory.recipe_error = error.what();
        }
    }
    if (ImGui::IsItemDeactivated()) {
        memory.recipe_text = context.state.side().recipe;
        memory.recipe_error.clear();
    }
    if (!ImGui::IsItemActive())
        tooltip(context, "The recipe, as on the command line: references > builder > transforms.\n" +
                             memory.recipe_text);
    if (!memory.recipe_error.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        colored(context.colors.error, memory.recipe_error);
        ImGui::PopTextWrapPos();
    }
}

void stages(const Context& context, Recipe recipe) {
    bool changed = false;
    ImGui::PushID("references");
    const bool are_references_open = stage_head(context, "references");
    if (const CatalogEntry* entry =
            pick(context, recipe.references, are_references_open, rows_of(reference_catalog()))) {
        recipe.references = Stage(*entry);
        changed = true;
    }
    if (are_references_open) {
        changed |= stage_widgets(context, recipe.references);
        consequence(context);
    }
    ImGui::PopID();
    ImGui::PushID("builder");
    const bool is_builder_open = stage_head(context, "builder");
    if (const CatalogEntry* entry =
            pick(context, recipe.builder, is_builder_open, rows_of(builder_catalog()))) {
        recipe.builder = Stage(*entry);
        context.memory.recipe_note = drop_misfits(recipe);
        changed = true;
    }
    if (is_builder_open) changed |= stage_widgets(context, recipe.builder);
    ImGui::PopID();
    changed |= transform_widgets(context, recipe);
    if (changed) {
        context.state.side().recipe = print(recipe);
        context.memory.recipe_note_of = context.state.side().recipe;
    }
    if (!context.memory.recipe_note.empty()) note(context, context.memory.recipe_note);
}

}  // namespace

void recipe_part(const Context& context) {
    compare_part(context);
    recipe_text(context);
    try {
        stages(context, parse_recipe(context.state.side().recipe));
    } catch (const Error& error) {
        ImGui::PushTextWrapPos(0.0f);
        colored(context.colors.error, error.what());
        ImGui::PopTextWrapPos();
    }
    for (const Side side : kSides) {
        const std::string& error = context.input.side(side).build_error;
        if (error.empty() || !context.state.has(side)) continue;
        ImGui::PushTextWrapPos(0.0f);
        colored(context.colors.error,
                (context.state.compares() ? std::string(side_name(side)) + ": " : std::string()) + error);
        ImGui::PopTextWrapPos();
    }
    if (context.input.cancelled) {
        note(context, "Cancelled: the picture shows what was built before.");
        if (ImGui::Button("Build")) context.actions.push_back(BuildAgain{});
    }
}

}  // namespace boxwood::panel
