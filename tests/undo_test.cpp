#include "app/viewer/undo.h"

#include <gtest/gtest.h>

namespace boxwood {
namespace {

ViewerState with_recipe(const char* recipe) {
    ViewerState state;
    state.side().recipe = recipe;
    return state;
}

TEST(Undo, GoesBackAndForwardThroughEverySetting) {
    Undo undo(with_recipe("a"));
    undo.note(with_recipe("b"), false);
    undo.note(with_recipe("c"), false);
    EXPECT_EQ(undo.back(with_recipe("c"))->side().recipe, "b");
    EXPECT_EQ(undo.back(with_recipe("b"))->side().recipe, "a");
    EXPECT_FALSE(undo.back(with_recipe("a")));
    EXPECT_EQ(undo.forward(with_recipe("a"))->side().recipe, "b");
    EXPECT_EQ(undo.forward(with_recipe("b"))->side().recipe, "c");
    EXPECT_FALSE(undo.forward(with_recipe("c")));
}

TEST(Undo, ADragIsOneStep) {
    Undo undo(with_recipe("a"));
    for (const char* recipe : {"b", "c", "d"}) undo.note(with_recipe(recipe), /*editing=*/true);
    undo.note(with_recipe("d"), /*editing=*/false);
    EXPECT_EQ(undo.back_count(), 1u);
    EXPECT_EQ(undo.back(with_recipe("d"))->side().recipe, "a");
}

TEST(Undo, AnUnnotedChangeIsAStepToo) {
    Undo undo(with_recipe("a"));
    EXPECT_EQ(undo.back(with_recipe("b"))->side().recipe, "a");
    EXPECT_EQ(undo.forward(with_recipe("a"))->side().recipe, "b");
}

TEST(Undo, AChangeForgetsWhatWasUndone) {
    Undo undo(with_recipe("a"));
    undo.note(with_recipe("b"), false);
    undo.back(with_recipe("b"));
    undo.note(with_recipe("c"), false);
    EXPECT_FALSE(undo.forward(with_recipe("c")));
    EXPECT_EQ(undo.back(with_recipe("c"))->side().recipe, "a");
}

TEST(Undo, TheWindowKeepsItsSize) {
    Undo undo(with_recipe("a"));
    ViewerState wide = with_recipe("b");
    wide.width = 1920;
    undo.note(wide, false);
    EXPECT_EQ(undo.back(wide)->width, 1920);
    ViewerState wider = with_recipe("a");
    wider.width = 2560;
    undo.note(wider, false);
    EXPECT_EQ(undo.back_count(), 0u);
}

}  // namespace
}  // namespace boxwood
