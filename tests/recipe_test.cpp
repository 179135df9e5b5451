#include "core/catalog/recipe.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/catalog/param_text.h"
#include "tests/support/test_stages.h"

namespace boxwood {
namespace {

/// Gives every parameter a value within its range, drawn at random.
class Shuffle final : public ParamVisitor {
public:
    explicit Shuffle(uint64_t seed) : rng_(seed) {}

    void on_int(const char*, int& value, int lower, int upper, const char*) override {
        value = lower + static_cast<int>(rng_.next_index(static_cast<uint64_t>(upper - lower) + 1));
    }
    void on_float(const char*, float& value, float lower, float upper, const char*) override {
        value = rng_.next(lower, upper);
    }
    void on_bool(const char*, bool& value, const char*) override { value = rng_.next() < 0.5f; }
    void on_enum(const char*, int& value, std::span<const char* const> names, const char*) override {
        value = static_cast<int>(rng_.next_index(names.size()));
    }
    void on_area_limit(const char*, const char*, AreaLimit& value, const char*) override {
        value.absolute = rng_.next() < 0.5f;
        const double x = static_cast<double>(rng_.next());
        value.value = value.absolute ? x * 1e-9 + 1e-30 : x * 40.0;
    }

private:
    Rng rng_;
};

void expect_round_trips(const Catalog& catalog) {
    uint64_t seed = 1;
    for (const CatalogEntry& references : catalog.references) {
        for (const CatalogEntry& builder : catalog.builders) {
            for (int shuffled = 0; shuffled < 20; ++shuffled) {
                Recipe recipe{Stage(references), Stage(builder), {}};
                // Each time from another transform on, all that fit one after the other.
                const std::span<const CatalogEntry> transforms = catalog.transforms;
                std::string family = builder.output;
                for (size_t i = 0; i < transforms.size(); ++i) {
                    const CatalogEntry& next =
                        transforms[(i + static_cast<size_t>(shuffled)) % transforms.size()];
                    if (next.input != family) continue;
                    recipe.transforms.emplace_back(next);
                    family = next.output;
                }
                if (shuffled > 0) {
                    Shuffle shuffle(seed++);
                    recipe.references.method().describe(shuffle);
                    recipe.builder.method().describe(shuffle);
                    for (Stage& transform : recipe.transforms) transform.method().describe(shuffle);
                }
                const std::string text = print(recipe);
                const Recipe parsed = parse_recipe(text, catalog);
                EXPECT_EQ(print(parsed), text);
                EXPECT_EQ(param_texts(parsed.references.method()), param_texts(recipe.references.method()));
                EXPECT_EQ(param_texts(parsed.builder.method()), param_texts(recipe.builder.method()));
                EXPECT_EQ(parsed.transforms.size(), recipe.transforms.size());
                EXPECT_TRUE(parsed == recipe) << text;
            }
        }
    }
}

std::string refusal_of_recipe(const std::string& text, const Catalog& catalog = kTestCatalog) {
    try {
        parse_recipe(text, catalog);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::WrongUsage);
        return error.what();
    }
    return "accepted";
}

TEST(Recipe, EveryRowWithAnyParametersReadsBackAsItWasPrinted) {
    expect_round_trips(catalog());
    expect_round_trips(kTestCatalog);
}

TEST(Recipe, CanonicalTextLeavesOutDefaultsAndWholeReferences) {
    const auto canonical = [](const char* text) { return print(parse_recipe(text, kTestCatalog)); };
    EXPECT_EQ(canonical("whole>none"), "none");
    EXPECT_EQ(canonical("  bvh-binned-sah ( bins = 16 , max-leaf-size=4 )"),
              "bvh-binned-sah(max-leaf-size=4)");
    EXPECT_EQ(canonical("copies(weight=0.10, clip=on,order=morton)>bvh-binned-sah()>same"),
              "copies(weight=0.1, clip=on) > bvh-binned-sah > same");
    EXPECT_EQ(canonical("copies(weight=-0) > none"), "copies(weight=0) > none");
}

TEST(Recipe, AnAreaLimitIsPrintedAsItWasGiven) {
    const auto canonical = [](const char* text) { return print(parse_recipe(text, kTestCatalog)); };
    EXPECT_EQ(canonical("copies(s=12.5) > none"), "copies(s=12.5) > none");
    EXPECT_EQ(canonical("copies(s=10) > none"), "copies > none");
    EXPECT_EQ(canonical("copies(sa=10) > none"), "copies(sa=10) > none");
}

TEST(Recipe, PrefixesNameTheFirstStages) {
    const Recipe recipe =
        parse_recipe("copies(copies=3) > bvh-binned-sah > same > same(rounds=2)", kTestCatalog);
    EXPECT_EQ(prefix(recipe, 1), "copies(copies=3)");
    EXPECT_EQ(prefix(recipe, 2), "copies(copies=3) > bvh-binned-sah");
    EXPECT_EQ(prefix(recipe, 4), "copies(copies=3) > bvh-binned-sah > same > same(rounds=2)");
    EXPECT_EQ(prefix(parse_recipe("none", kTestCatalog), 1), "whole");
}

TEST(Recipe, CopiesOfAStageAreIndependent) {
    const Recipe recipe = parse_recipe("bvh-binned-sah", kTestCatalog);
    Recipe copy = recipe;
    set_params(copy.builder.method(), "bvh-binned-sah", std::vector<ParamText>{{"bins", "8"}});
    EXPECT_EQ(print(recipe), "bvh-binned-sah");
    EXPECT_EQ(print(copy), "bvh-binned-sah(bins=8)");
    EXPECT_FALSE(recipe == copy);
}

TEST(Recipe, AnUnknownWordIsRefusedWithTheNearestValidOne) {
    EXPECT_EQ(refusal_of_recipe("bvh-bined-sah"),
              "recipe: there is no stage \"bvh-bined-sah\"; did you mean bvh-binned-sah?");
    EXPECT_EQ(refusal_of_recipe("bvh-binned-sah(bin=8)"),
              "recipe: bvh-binned-sah has no parameter \"bin\"; did you mean bins?");
    EXPECT_EQ(refusal_of_recipe("none(t=1)"), "recipe: none has no parameter \"t\": it has none");
    EXPECT_EQ(refusal_of_recipe("copies(order=fil) > none"),
              "recipe: order of copies is \"fil\", expected file, morton or random; did you mean file?");
}

TEST(Recipe, AValueOutsideItsRangeIsRefusedWithTheRange) {
    EXPECT_EQ(refusal_of_recipe("bvh-binned-sah(bins=257)"),
              "recipe: bins of bvh-binned-sah is \"257\", expected a whole number from 2 to 256");
    for (const char* text :
         {"bvh-binned-sah(bins=8.5)", "bvh-binned-sah(bins=)", "bvh-binned-sah(bins=99999999999)",
          "bvh-binned-sah(traversal-cost=nan)", "bvh-binned-sah(traversal-cost=1x)",
          "copies(weight=2.001) > none", "copies(s=-1) > none", "copies(s=41) > none", "copies(sa=0) > none",
          "copies(sa=inf) > none", "copies(sa=nan) > none", "copies(clip=maybe) > none"})
        EXPECT_NE(refusal_of_recipe(text).find("expected"), std::string::npos)
            << text << ": " << refusal_of_recipe(text);
}

TEST(Recipe, WhatIsGivenTwiceIsRefused) {
    EXPECT_EQ(refusal_of_recipe("copies(s=1, sa=2) > none"),
              "recipe: s and sa of copies say the same thing: give one of them");
    EXPECT_EQ(refusal_of_recipe("bvh-binned-sah(bins=8, bins=9)"),
              "recipe: bins of bvh-binned-sah is given twice");
}

TEST(Recipe, StagesThatDoNotFitAreRefused) {
    EXPECT_EQ(refusal_of_recipe("none > same"), "recipe: same needs a binary BVH, none makes a list");
    EXPECT_EQ(refusal_of_recipe("same > bvh-binned-sah"),
              "recipe: same needs a binary BVH, but no builder comes before it");
    EXPECT_EQ(refusal_of_recipe("none > bvh-binned-sah"),
              "recipe: bvh-binned-sah after none: a recipe has one builder");
    EXPECT_EQ(refusal_of_recipe("copies > whole > none"),
              "recipe: whole after copies: one stage makes the references");
    EXPECT_EQ(refusal_of_recipe("none > copies"), "recipe: copies makes references and belongs before none");
    EXPECT_NE(refusal_of_recipe("copies").find("has no builder"), std::string::npos);
}

TEST(Recipe, TextThatIsNoRecipeIsRefused) {
    for (const char* text :
         {"", " ", ">", "none >", "> none", "none(", "none)", "none()x", "none(())", "none(x)", "(bins=2)",
          "bvh-binned-sah(bins=2", "bvh-binned-sah(bins=2,)", "none\xff"})
        EXPECT_TRUE(refusal_of_recipe(text).starts_with("recipe: "))
            << text << ": " << refusal_of_recipe(text);
}

TEST(Catalog, IdsAreLowerCaseWithHyphensAndStandOnce) {
    std::vector<std::string> ids = catalog().ids();
    for (const std::string& id : ids)
        EXPECT_EQ(id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string::npos) << id;
    std::ranges::sort(ids);
    EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
    EXPECT_EQ(find_entry("bvh-sweep-sah")->kind, StageKind::Builder);
    EXPECT_EQ(find_entry("bvh"), nullptr);
}

TEST(Catalog, EveryParameterIsDescribedForPeople) {
    const Catalog& all = catalog();
    for (const std::span<const CatalogEntry> table : {all.references, all.builders, all.transforms}) {
        for (const CatalogEntry& entry : table) {
            EXPECT_GT(std::string(entry.label).size(), 3u) << entry.id;
            EXPECT_GT(std::string(entry.source).size(), 3u) << entry.id;
            for (const ParamInfo& info : param_infos(*entry.make())) {
                EXPECT_GT(info.help.size(), 3u) << entry.id;
                EXPECT_FALSE(info.range.empty()) << entry.id;
                EXPECT_TRUE(info.initial.starts_with(info.keys.front())) << entry.id;
            }
        }
    }
}

TEST(Recipe, AStandInMakesTheSameFamilyAndHasNoneItself) {
    size_t count = 0;
    for (const CatalogEntry& entry : builder_catalog()) {
        const Recipe recipe = parse_recipe("evh(t=9) > " + std::string(entry.id));
        const std::optional<Recipe> other = stand_in(recipe);
        if (!other) continue;
        ++count;
        EXPECT_EQ(other->references, recipe.references);
        EXPECT_STREQ(other->builder.entry().output, entry.output) << entry.id;
        EXPECT_FALSE(stand_in(*other)) << entry.id;
    }
    EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace boxwood
