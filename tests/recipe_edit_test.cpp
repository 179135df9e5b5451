#include "app/viewer/recipe_edit.h"

#include <gtest/gtest.h>

namespace boxwood {
namespace {

const CatalogEntry& entry(const char* id) { return *find_entry(id); }

TEST(RecipeEdit, ATransformGoesToTheLastPlaceWhereAllStillFit) {
    // lsc makes another family than it takes: what works on a binary tree goes before it.
    const Recipe recipe = parse_recipe("bvh-sweep-sah > lsc");
    EXPECT_TRUE(all_fit(recipe));
    EXPECT_EQ(place_for(recipe, entry("refit")), 0u);
    EXPECT_EQ(print(with_inserted(recipe, 0, entry("refit"))), "bvh-sweep-sah > refit > lsc");
    EXPECT_EQ(place_for(parse_recipe("bvh-sweep-sah"), entry("refit")), 0u);
    EXPECT_EQ(place_for(parse_recipe("bvh-sweep-sah > refit"), entry("refit")), 1u);
    EXPECT_EQ(place_for(parse_recipe("grid"), entry("refit")), std::nullopt);
}

TEST(RecipeEdit, AnotherOrderIsRefusedWhereItDoesNotFit) {
    const Recipe recipe = parse_recipe("bvh-sweep-sah > refit > lsc");
    EXPECT_FALSE(all_fit(with_swapped(recipe, 0)));
    const Recipe twice = parse_recipe("bvh-sweep-sah > refit(from=1) > refit(from=2)");
    EXPECT_TRUE(all_fit(with_swapped(twice, 0)));
    EXPECT_EQ(print(with_swapped(twice, 0)), "bvh-sweep-sah > refit(from=2) > refit(from=1)");
}

TEST(RecipeEdit, WhatDoesNotFitAnotherBuilderIsTakenOutAndNamed) {
    Recipe recipe = parse_recipe("bvh-sweep-sah > refit > lsc");
    EXPECT_EQ(drop_misfits(recipe), "");
    recipe.builder = Stage(entry("grid"));
    const std::string note = drop_misfits(recipe);
    EXPECT_EQ(print(recipe), "grid");
    EXPECT_NE(note.find("refit was taken out"), std::string::npos) << note;
    EXPECT_NE(note.find("lsc was taken out"), std::string::npos) << note;
    EXPECT_NE(note.find(entry("lsc").input), std::string::npos) << note;
}

}  // namespace
}  // namespace boxwood
