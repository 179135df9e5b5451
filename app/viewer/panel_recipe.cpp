#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"
#include "core/base/error.h"

namespace boxwood::panel {
namespace {

std::string stage_tip(const CatalogEntry& entry) {
    std::string text = std::string(entry.id) + ": " + entry.label + "\n" + entry.source;
    if (!entry.exact) text += "\nApproximate: its answers are not those of the mesh.";
    return text;
}

/// A combo box over a table; the row that was picked, or nullptr.
const CatalogEntry* pick(const Context& context, const char* label, const CatalogEntry& current,
                         std::span<const CatalogEntry> table) {
    const CatalogEntry* picked = nullptr;
    ImGui::AlignTextToFramePadding();
    colored(context.colors.dim, label);
    ImGui::SameLine(104.0f * context.scale);
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::PushID(label);
    if (ImGui::BeginCombo("##stage", current.id)) {
        for (const CatalogEntry& entry : table) {
            if (ImGui::Selectable(entry.id, &entry == &current)) picked = &entry;
            tooltip(context, stage_tip(entry));
        }
        ImGui::EndCombo();
    }
    tooltip(context, stage_tip(current));
    ImGui::PopID();
    return picked;
}

const char* last_family(const Recipe& recipe) {
    return recipe.transforms.empty() ? recipe.builder.entry().output
                                     : recipe.transforms.back().entry().output;
}

/// Drops the transforms that do not fit what comes before them.
void drop_misfits(Recipe& recipe) {
    std::string family = recipe.builder.entry().output;
    for (size_t i = 0; i < recipe.transforms.size(); ++i) {
        if (family != recipe.transforms[i].entry().input) {
            recipe.transforms.erase(recipe.transforms.begin() + static_cast<std::ptrdiff_t>(i),
                                    recipe.transforms.end());
            return;
        }
        family = recipe.transforms[i].entry().output;
    }
}

bool transform_widgets(const Context& context, Recipe& recipe) {
    bool changed = false;
    std::optional<size_t> removed;
    for (size_t i = 0; i < recipe.transforms.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        ImGui::AlignTextToFramePadding();
        colored(context.colors.dim, "then");
        ImGui::SameLine(104.0f * context.scale);
        ImGui::TextUnformatted(recipe.transforms[i].entry().id);
        tooltip(context, stage_tip(recipe.transforms[i].entry()));
        ImGui::SameLine();
        if (ImGui::SmallButton("remove")) removed = i;
        changed |= stage_widgets(context, recipe.transforms[i]);
        ImGui::PopID();
    }
    if (removed) {
        recipe.transforms.erase(recipe.transforms.begin() + static_cast<std::ptrdiff_t>(*removed));
        drop_misfits(recipe);
        changed = true;
    }
    std::vector<const CatalogEntry*> fitting;
    for (const CatalogEntry& entry : transform_catalog()) {
        if (std::string(entry.input) == last_family(recipe)) fitting.push_back(&entry);
    }
    if (fitting.empty()) return changed;
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##add", "add a transform")) {
        for (const CatalogEntry* entry : fitting) {
            if (ImGui::Selectable(entry->id)) recipe.transforms.push_back(Stage(*entry)), changed = true;
            tooltip(context, stage_tip(*entry));
        }
        ImGui::EndCombo();
    }
    return changed;
}

/// What the references stage did: the consequence of its sliders, beside them.
void consequence(const Context& context) {
    const Built* built = context.input.built;
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
    if (memory.recipe_shown != context.state.recipe) {
        memory.recipe_shown = memory.recipe_text = context.state.recipe;
        memory.recipe_error.clear();
    }
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::InputText("##recipe", &memory.recipe_text)) {
        try {
            const std::string canonical = print(parse_recipe(memory.recipe_text));
            memory.recipe_error.clear();
            context.state.recipe = memory.recipe_shown = canonical;
        } catch (const Error& error) {
            memory.recipe_error = error.what();
        }
    }
    if (ImGui::IsItemDeactivated()) {
        memory.recipe_text = context.state.recipe;
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
    if (const CatalogEntry* entry =
            pick(context, "references", recipe.references.entry(), reference_catalog())) {
        recipe.references = Stage(*entry);
        changed = true;
    }
    ImGui::PushID("references");
    changed |= stage_widgets(context, recipe.references);
    ImGui::PopID();
    consequence(context);
    if (const CatalogEntry* entry = pick(context, "builder", recipe.builder.entry(), builder_catalog())) {
        recipe.builder = Stage(*entry);
        drop_misfits(recipe);
        changed = true;
    }
    ImGui::PushID("builder");
    changed |= stage_widgets(context, recipe.builder);
    ImGui::PopID();
    changed |= transform_widgets(context, recipe);
    if (changed) context.state.recipe = print(recipe);
}

}  // namespace

void recipe_part(const Context& context) {
    heading(context, "Recipe");
    recipe_text(context);
    try {
        stages(context, parse_recipe(context.state.recipe));
    } catch (const Error& error) {
        ImGui::PushTextWrapPos(0.0f);
        colored(context.colors.error, error.what());
        ImGui::PopTextWrapPos();
    }
    if (!context.input.build_error.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        colored(context.colors.error, context.input.build_error);
        ImGui::PopTextWrapPos();
    }
    if (context.input.cancelled) {
        note(context, "Cancelled: the picture shows what was built before.");
        if (ImGui::Button("Build")) context.actions.push_back(BuildAgain{});
    }
}

}  // namespace boxwood::panel
