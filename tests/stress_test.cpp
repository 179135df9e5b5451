#include "bench/stress.h"

#include <gtest/gtest.h>

#include "bench/stress_cases.h"
#include "oracle/oracle.h"

namespace boxwood::bench {
namespace {

TEST(Stress, NoWrongAnswerInExactModeForEveryBuilder) {
    StressSettings settings;
    for (const CatalogEntry& builder : builder_catalog())
        settings.recipes.push_back(parse_recipe(builder.id));
    settings.seconds = 0.5;
    Task task;
    uint64_t exact_decisions = 0;
    for (const StressRow& row : run_stress(settings, task)) {
        EXPECT_TRUE(row.holds()) << row.first_failure;
        EXPECT_GT(row.rays, 0u) << row.kind;
        exact_decisions += row.exact_decisions;
    }
    EXPECT_GT(exact_decisions, 0u);
}

TEST(Stress, CasesHaveSomethingToHit) {
    for (const StressKind& kind : stress_kinds()) {
        if (kind.judge != Judge::Oracle) continue;
        const StressCase test = kind.make(1, 48);
        size_t hit_count = 0;
        for (const Ray& ray : test.rays) hit_count += oracle::closest_hit(test.mesh, ray).has_value();
        EXPECT_GT(hit_count, 4u) << kind.name;
    }
}

}  // namespace
}  // namespace boxwood::bench
