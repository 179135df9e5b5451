#include "core/scene/frame.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace boxwood {
namespace {

TEST(SceneFrame, IsWhatTheSpecSays) {
    EXPECT_EQ(scene_frame("kitchen")->frame, 0);
    EXPECT_EQ(scene_frame("kitchen")->count, 120);
    EXPECT_EQ(scene_frame("kitchen@frame=12@scale=2")->frame, 12);
    EXPECT_EQ(scene_frame("kitchen@scale=2@frame=119")->frame, 119);
    for (const char* spec : {"cornell", "kitchen@frame=120", "kitchen@frame=x", "kitchen@oops", "a.obj", ""})
        EXPECT_FALSE(scene_frame(spec).has_value()) << spec;
}

TEST(WithFrame, ChangesTheFrameAndNothingElse) {
    EXPECT_EQ(with_frame("kitchen", 3), "kitchen@frame=3");
    EXPECT_EQ(with_frame("kitchen@frame=12", 3), "kitchen@frame=3");
    EXPECT_EQ(with_frame("kitchen@scale=2@frame=12@rot=4,0,1,0", 3), "kitchen@frame=3@scale=2@rot=4,0,1,0");
    EXPECT_EQ(with_frame("kitchen@frame=12@scale=2", 0), "kitchen@scale=2");
}

TEST(WithFrame, RefusesWithASentence) {
    const auto refusal = [](const std::string& spec, int frame) -> std::string {
        try {
            with_frame(spec, frame);
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::WrongUsage);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal("cornell", 3),
              "scene 'cornell' has no frames; built-in scenes that have some: kitchen");
    EXPECT_EQ(refusal("kitchen@scale=2", 120),
              "scene 'kitchen@scale=2' has no frame 120, but frames 0 to 119");
    EXPECT_EQ(refusal("kitchen", -1), "scene 'kitchen' has no frame -1, but frames 0 to 119");
}

}  // namespace
}  // namespace boxwood
