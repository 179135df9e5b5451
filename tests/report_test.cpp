#include "core/measure/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace boxwood {
namespace {

Report small_report() {
    Report report{"stats", {"bunny.obj"}, {}, {}};
    report.rows.push_back(ReportRow()
                              .set("recipe", std::string("none"))
                              .set("triangles", uint64_t{1234567})
                              .set("build_ms", 0.1)
                              .set("skipped", std::map<std::string, uint64_t>{{"zero area", 3}}));
    report.rows.push_back(ReportRow()
                              .set("recipe", std::string("a\xffz"))
                              .set("build_ms", std::numeric_limits<double>::infinity())
                              .set("exact", true));
    return report;
}

TEST(Report, JsonHoldsTheKeysOfTheDesignInTheirOrder) {
    const auto json = nlohmann::ordered_json::parse(to_json(small_report()));
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"command", "scene", "machine", "commit", "rows"}));
    for (const char* key : {"cpu", "cores", "compiler", "build_type"})
        EXPECT_TRUE(json["machine"].contains(key)) << key;
    EXPECT_GT(json["machine"]["cores"].get<int>(), 0);
    EXPECT_FALSE(json["commit"].get<std::string>().empty());
    EXPECT_EQ(json["scene"], "bunny.obj");
    EXPECT_EQ(json["rows"][0]["triangles"], 1234567);
    EXPECT_EQ(json["rows"][0]["build_ms"], 0.1);
    EXPECT_EQ(json["rows"][0]["skipped"]["zero area"], 3);
}

TEST(Report, JsonIsValidForNumbersThatAreNotFiniteAndForBrokenText) {
    const auto json = nlohmann::json::parse(to_json(small_report()));
    EXPECT_TRUE(json["rows"][1]["build_ms"].is_null());
    EXPECT_EQ(json["rows"][1]["recipe"], "a\xef\xbf\xbdz");
}

TEST(Report, SceneIsAnArrayOnlyForSeveral) {
    Report report{"list", {}, {}, {}};
    EXPECT_TRUE(nlohmann::json::parse(to_json(report))["scene"].is_null());
    report.scenes = {"a", "b"};
    EXPECT_EQ(nlohmann::json::parse(to_json(report))["scene"], (std::vector<std::string>{"a", "b"}));
}

TEST(Report, FurtherTablesStandUnderTheirOwnKeys) {
    Report report{"list", {}, {}, {}};
    report.tables.push_back({"builders", {ReportRow().set("id", std::string("none"))}});
    EXPECT_EQ(nlohmann::json::parse(to_json(report))["builders"][0]["id"], "none");
}

TEST(Report, TheTableAlignsTextLeftAndNumbersRight) {
    std::vector<ReportRow> rows;
    rows.push_back(ReportRow().set("name", std::string("\u00e9t\u00e9")).set("n", uint64_t{12345}));
    rows.push_back(ReportRow().set("name", std::string("winter")).set("n", 0.5));
    EXPECT_EQ(to_table(rows),
              "name         n\n"
              "\u00e9t\u00e9     12,345\n"
              "winter   0.500\n");
    EXPECT_EQ(to_table({}), "");
}

TEST(ReportRow, AKeySetTwiceKeepsItsPlaceAndTheLastValue) {
    ReportRow row;
    row.set("a", uint64_t{1}).set("b", uint64_t{2}).set("a", uint64_t{3});
    ASSERT_EQ(row.cells().size(), 2u);
    EXPECT_EQ(std::get<uint64_t>(row.cells()[0].second), 3u);
}

}  // namespace
}  // namespace boxwood
