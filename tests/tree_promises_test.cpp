#include "bench/tree_promises.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/random_mesh.h"

namespace boxwood::bench {
namespace {

TEST(TreePromise, ParsedPrintedAndParsedAgainIsTheSame) {
    for (const char* text : {"sah_cost: bvh-sweep-sah <= bvh-binned-sah",
                             "references: esc(s=6) > bvh-binned-sah <= 1.5 * bvh-sweep-sah > lsc"}) {
        EXPECT_EQ(print(parse_promise(text)), text);
    }
    const TreePromise promise = parse_promise("  bytes :none<=0.25*whole > grid ");
    EXPECT_EQ(promise.value, TreeValue::Bytes);
    EXPECT_EQ(promise.factor, 0.25);
    EXPECT_EQ(print(promise), "bytes: none <= 0.25 * grid");
}

TEST(TreePromise, WhatIsNoneIsRefused) {
    for (const char* text :
         {"", "sah_cost: none", "none <= none", "cost: none <= none", "sah_cost: none <= x * none",
          "sah_cost: none <= 0 * none", "sah_cost: none <= inf * none", "sah_cost: none <= nothing"})
        EXPECT_THROW(parse_promise(text), Error) << text;
}

TEST(TreePromise, OfTheCatalogCanBeParsed) {
    for (const char* text : catalog_promises()) EXPECT_NO_THROW(parse_promise(text)) << text;
}

class Promises : public ::testing::Test {
protected:
    KeptPromise check(const std::string& text) {
        Task task;
        return check_promise(parse_promise(text), scene_, cache_, task);
    }
    static std::shared_ptr<const Scene> make_scene() {
        auto scene = std::make_shared<Scene>();
        scene->mesh = random_triangles(10, 0.3f, 9);
        return scene;
    }
    std::shared_ptr<const Scene> scene_ = make_scene();
    StageCache cache_;
};

TEST_F(Promises, ValuesOfAListByHand) {
    // One leaf of ten primitives: ten tests, or three packs of four below the root.
    EXPECT_EQ(check("sah_cost: none <= none").value, 10.0);
    EXPECT_EQ(check("wide_cost: bvh-sweep-sah(max-leaf-size=64, traversal-cost=16) > wide4 <= "
                    "bvh-sweep-sah(max-leaf-size=64, traversal-cost=16) > wide4")
                  .value,
              4.0);
    EXPECT_THROW(check("wide_cost: none <= none"), Error);
    EXPECT_EQ(check("references: none <= none").value, 10.0);
    EXPECT_EQ(check("nodes: none <= none").value, 1.0);
    EXPECT_EQ(check("bytes: none <= none").value, 40.0);
}

TEST_F(Promises, HoldUpToTheFactorAndRounding) {
    EXPECT_TRUE(check("references: none <= none").holds);
    EXPECT_FALSE(check("references: none <= 0.99 * none").holds);
    EXPECT_TRUE(check("nodes: none <= bvh-sweep-sah(max-leaf-size=1)").holds);
    EXPECT_FALSE(check("nodes: bvh-sweep-sah(max-leaf-size=1) <= 18 * none").holds);
    EXPECT_TRUE(check("nodes: bvh-sweep-sah(max-leaf-size=1) <= 19 * none").holds);
}

}  // namespace
}  // namespace boxwood::bench
