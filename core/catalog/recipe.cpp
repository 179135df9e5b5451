#include "core/catalog/recipe.h"

#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/catalog/family_text.h"
#include "core/catalog/param_text.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

constexpr const char* kExample = "evh(t=14) > bvh-binned-sah";

[[noreturn]] void refuse(const std::string& sentence) {
    throw Error(ExitCode::WrongUsage, "recipe: " + sentence);
}

std::string trimmed(const std::string& text) {
    const size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// The parts between the separators, trimmed; one more than there are separators.
std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    size_t begin = 0;
    while (true) {
        const size_t end = text.find(separator, begin);
        parts.push_back(trimmed(text.substr(begin, end - begin)));
        if (end == std::string::npos) return parts;
        begin = end + 1;
    }
}

/// "key=value, key=value" without the brackets.
std::vector<ParamText> parse_params(const std::string& text, const std::string& stage) {
    std::vector<ParamText> params;
    if (trimmed(text).empty()) return params;
    for (const std::string& part : split(text, ',')) {
        const size_t equals = part.find('=');
        if (equals == std::string::npos)
            refuse("\"" + to_utf8(part) + "\" in " + stage + " is no parameter, expected key=value");
        params.push_back({trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 1))});
    }
    return params;
}

/// One stage: "id" or "id(key=value, ...)".
Stage parse_stage(const std::string& text, const Catalog& catalog) {
    if (text.empty()) refuse("a stage is missing, expected for example \"" + std::string(kExample) + "\"");
    const size_t bracket = text.find('(');
    const std::string id = trimmed(text.substr(0, bracket));
    const CatalogEntry* entry = catalog.find(id);
    if (!entry)
        refuse("there is no stage \"" + to_utf8(id) + "\"; did you mean " + nearest_word(id, catalog.ids()) +
               "?");
    Stage stage(*entry);
    if (bracket == std::string::npos) return stage;
    if (text.back() != ')' || text.find(')') != text.size() - 1 ||
        text.find('(', bracket + 1) != std::string::npos)
        refuse("\"" + to_utf8(text) + "\": expected one closing bracket, at the end of the stage");
    try {
        set_params(stage.method(), id, parse_params(text.substr(bracket + 1, text.size() - bracket - 2), id));
    } catch (const Error& error) {
        const std::string sentence = error.what();
        if (sentence.starts_with("recipe: ")) throw;
        refuse(sentence);
    }
    return stage;
}

/// Throws where a transform does not take what the stage before it makes.
void check_fit(const Stage& transform, const CatalogEntry& before) {
    const CatalogEntry& entry = transform.entry();
    if (std::string(entry.input) == before.output) return;
    refuse(std::string(entry.id) + " needs " + with_article(entry.input) + ", " + before.id + " makes " +
           with_article(before.output));
}

}  // namespace

Stage::Stage(const CatalogEntry& entry) : entry_(&entry), method_(entry.make()) {}
Stage::Stage(const Stage& other) : entry_(other.entry_), method_(other.method_->clone()) {}
Stage& Stage::operator=(const Stage& other) {
    Stage copy(other);
    *this = std::move(copy);
    return *this;
}

std::string Stage::text() const {
    const std::vector<ParamText> params = param_texts(*method_);
    const std::vector<ParamText> defaults = param_texts(*entry_->make());
    std::string changed;
    for (size_t i = 0; i < params.size(); ++i) {
        if (params[i] == defaults[i]) continue;
        changed += (changed.empty() ? "" : ", ") + params[i].key + "=" + params[i].value;
    }
    return entry_->id + (changed.empty() ? "" : "(" + changed + ")");
}

Recipe parse_recipe(const std::string& text, const Catalog& catalog) {
    if (trimmed(text).empty()) refuse("it is empty, expected for example \"" + std::string(kExample) + "\"");
    std::optional<Stage> references;
    std::optional<Stage> builder;
    std::vector<Stage> transforms;
    for (const std::string& part : split(text, '>')) {
        Stage stage = parse_stage(part, catalog);
        const std::string id = stage.entry().id;
        switch (stage.entry().kind) {
            case StageKind::References:
                if (references)
                    refuse(id + " after " + references->entry().id + ": one stage makes the references");
                if (builder) refuse(id + " makes references and belongs before " + builder->entry().id);
                references = std::move(stage);
                break;
            case StageKind::Builder:
                if (builder) refuse(id + " after " + builder->entry().id + ": a recipe has one builder");
                builder = std::move(stage);
                break;
            case StageKind::Transform:
                if (!builder)
                    refuse(id + " needs " + with_article(stage.entry().input) +
                           ", but no builder comes before it");
                check_fit(stage, transforms.empty() ? builder->entry() : transforms.back().entry());
                transforms.push_back(std::move(stage));
                break;
        }
    }
    if (!builder)
        refuse("\"" + to_utf8(trimmed(text)) + "\" has no builder, expected for example \"" + kExample +
               "\"");
    if (!references) references.emplace(catalog.references.front());
    return {std::move(*references), std::move(*builder), std::move(transforms)};
}

Recipe parse_recipe(const std::string& text) { return parse_recipe(text, catalog()); }

std::string print(const Recipe& recipe) { return prefix(recipe, 2 + recipe.transforms.size()); }

std::optional<Recipe> stand_in(const Recipe& recipe) {
    const char* id = recipe.builder.method().stand_in();
    if (id == nullptr) return std::nullopt;
    Recipe result = recipe;
    result.builder = Stage(*find_entry(id));
    return result;
}

std::string prefix(const Recipe& recipe, size_t stage_count) {
    std::string text = recipe.references.text();
    if (stage_count == 1) return text;
    text = text == kWholeReferences ? "" : text + " > ";
    text += recipe.builder.text();
    for (size_t i = 0; i + 2 < stage_count; ++i) text += " > " + recipe.transforms[i].text();
    return text;
}

}  // namespace boxwood
