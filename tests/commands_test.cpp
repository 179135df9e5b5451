#include <gtest/gtest.h>
#include <sys/wait.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "app/command/peer_options.h"
#include "core/render/png.h"
#include "support/temporary_folder.h"

namespace boxwood {
namespace {

using Json = nlohmann::json;

/// What a run of the program left behind.
struct Ended {
    int exit_code = -1;
    std::string output;
    std::string error;
};

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The program itself, in a folder of its own.
class CommandLine : public ::testing::Test {
protected:
    Ended run(const std::string& arguments, const std::string& input = "") const {
        const std::string errors = folder_.write("errors.txt", "");
        const std::string from = folder_.write("input.txt", input);
        const std::string command =
            std::string(BOXWOOD_PROGRAM) + " " + arguments + " 2>'" + errors + "' <'" + from + "'";
        Ended result;
        std::FILE* pipe = ::popen(command.c_str(), "r");
        char block[4096];
        while (const size_t count = std::fread(block, 1, sizeof(block), pipe))
            result.output.append(block, count);
        const int status = ::pclose(pipe);
        result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        result.error = content_of(errors);
        return result;
    }
    /// Runs it and expects this exit code and these words on standard error.
    void expect_refusal(const std::string& arguments, int exit_code, const std::string& words) const {
        const Ended result = run(arguments);
        EXPECT_EQ(result.exit_code, exit_code) << arguments << ": " << result.error;
        EXPECT_NE(result.error.find(words), std::string::npos) << arguments << ": " << result.error;
        EXPECT_EQ(result.output, "") << arguments;
    }

    TemporaryFolder folder_;
};

TEST_F(CommandLine, HelpNamesEveryCommandAndEveryCommandHasHelp) {
    const Ended help = run("--help");
    EXPECT_EQ(help.exit_code, 0);
    for (const char* command : {"trace", "stats", "verify", "cast", "scenes", "list", "bench"}) {
        EXPECT_NE(help.output.find("\n  " + std::string(command) + " "), std::string::npos) << command;
        const Ended own = run(std::string(command) + " --help");
        EXPECT_EQ(own.exit_code, 0) << command;
        EXPECT_NE(own.output.find("Usage: boxwood " + std::string(command)), std::string::npos) << own.output;
    }
    EXPECT_EQ(run("--version").output.substr(0, 8), "boxwood ");
}

TEST_F(CommandLine, WrongUsageExitsWith2AndNamesTheNearestWord) {
    expect_refusal("stast cornell", 2, "did you mean stats?");
    expect_refusal("cornel", 2, "did you mean cornell?");
    expect_refusal("stats cornell --jsn -", 2, "did you mean --json?");
    expect_refusal("stats", 2, "SCENE is required");
    expect_refusal("stats cornell --recipe 'bvh-bined-sah'", 2, "did you mean bvh-binned-sah?");
    expect_refusal("stats cornell@rott=1", 2, "'@rot'");
    expect_refusal("verify cornell --rays many", 2, "expected a whole number from 1");
    expect_refusal("trace cornell --shade hat -o x.png", 2, "did you mean heat?");
    expect_refusal("trace cornell --size 0x5 -o x.png", 2, "expected WxH");
    expect_refusal("list more", 2, "one argument too many");
    expect_refusal("bench interakt", 2, "did you mean interact?");
    expect_refusal("trace cornell -o no/such/folder/x.png", 2, "no/such/folder/x.png");
}

TEST_F(CommandLine, InputThatCannotBeReadExitsWith3) {
    expect_refusal("stats no_such_file.obj --json -", 3, "no_such_file.obj");
    const std::string points = folder_.write(
        "points.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n0 0 0\n1 1 1\n");
    const Ended run_points = run("stats " + points);
    EXPECT_EQ(run_points.exit_code, 3);
    EXPECT_NE(run_points.error.find("2 points and no triangles"), std::string::npos) << run_points.error;
}

TEST_F(CommandLine, StatsPrintsARowForEachSceneAndRecipe) {
    const Ended result =
        run("stats cornell two-triangles -r bvh-sweep-sah -r 'evh(t=12) > bvh-binned-sah' --json -");
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json json = Json::parse(result.output);
    EXPECT_EQ(json["command"], "stats");
    EXPECT_EQ(json["scene"], (std::vector<std::string>{"cornell", "two-triangles"}));
    ASSERT_EQ(json["rows"].size(), 4u);
    for (const Json& row : json["rows"])
        for (const char* key : {"scene", "recipe", "triangles", "references", "references_made", "nodes",
                                "leaves", "levels", "bytes", "sah_cost", "epo", "build_ms", "skipped"})
            EXPECT_TRUE(row.contains(key)) << key;
    const Json& row = json["rows"][2];
    EXPECT_EQ(row["scene"], "two-triangles");
    EXPECT_EQ(row["recipe"], "bvh-sweep-sah");
    EXPECT_EQ(row["triangles"], 2);
    EXPECT_EQ(row["references_made"], 2);
    EXPECT_EQ(row["references"], 2);
    EXPECT_EQ(json["rows"][3]["recipe"], "evh(t=12) > bvh-binned-sah");
    EXPECT_GT(json["rows"][3]["references_made"].get<int>(), 2);
}

TEST_F(CommandLine, AnUnreadableSceneDoesNotKeepTheOthersFromBeingDone) {
    const Ended result = run("stats no_such_file.obj cornell -r bvh-sweep-sah --json -");
    EXPECT_EQ(result.exit_code, 3);
    ASSERT_EQ(Json::parse(result.output)["rows"].size(), 1u);
}

TEST_F(CommandLine, AJsonFileIsWrittenBesideTheTable) {
    const std::string file = folder_.write("out.json", "old");
    const Ended result = run("scenes --json " + file);
    EXPECT_NE(result.output.find("two-triangles"), std::string::npos);
    EXPECT_GE(Json::parse(content_of(file))["rows"].size(), 5u);
}

TEST_F(CommandLine, ListGivesTheThreeTables) {
    const Json json = Json::parse(run("list --json -").output);
    EXPECT_EQ(json["references"][0]["id"], "whole");
    EXPECT_EQ(json["builders"][0]["id"], "none");
    EXPECT_TRUE(json["transforms"].is_array());
    const Ended text = run("list");
    EXPECT_NE(text.output.find("t=14 (0 to 40)"), std::string::npos) << text.output;
}

TEST_F(CommandLine, VerifyComparesEveryStageWithBruteForce) {
    const Ended result = run("verify two-triangles cornell --rays 400 --json -");
    EXPECT_EQ(result.exit_code, 0) << result.error;
    const Json json = Json::parse(result.output);
    EXPECT_GE(json["rows"].size(), 24u);
    for (const Json& row : json["rows"]) {
        EXPECT_EQ(row["wrong"], 0) << row;
        EXPECT_EQ(row["rays"], 400);
    }
}

TEST_F(CommandLine, CastNamesPrimitivesAndDistances) {
    // The triangle of the file counted as 1 is the only one with an area.
    const std::string scene =
        folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 4\nf 1 2 3\n");
    const std::string rays =
        "hit 0.25 0.25 2 0 0 -0x1p+1 0 inf\n"
        "miss 5 5 2 0 0 -1 0 inf\n"
        "short 0.25 0.25 2 0 0 -1 0 1.5\n";
    const Ended result = run("cast " + scene + " -r bvh-binned-sah --rays - -o -", rays);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.output, "hit 1 1\nmiss -1 inf\nshort -1 inf\n");
    const std::string file = folder_.write("rays.txt", rays);
    const std::string output = folder_.write("hits.txt", "");
    EXPECT_EQ(run("cast " + scene + " -r none --rays " + file + " -o " + output).exit_code, 0);
    EXPECT_EQ(content_of(output), result.output);
}

TEST_F(CommandLine, CastRefusesABadLineAndLeavesTheOldOutput) {
    const std::string rays = folder_.write("rays.txt", "a 0 0 0 0 0 1 -1 1\n");
    const std::string output = folder_.write("hits.txt", "old");
    expect_refusal("cast cornell --rays " + rays + " -o " + output, 3, "line 1: tmin is -1");
    EXPECT_EQ(content_of(output), "old");
}

TEST_F(CommandLine, TraceWritesAPictureAndItsCost) {
    const std::string file = folder_.write("a.png", "");
    const Ended result = run("trace cornell --size 40x30 --spp 1 -r bvh-sweep-sah -o " + file + " --json -");
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json row = Json::parse(result.output)["rows"][0];
    EXPECT_EQ(row["rays"], 40 * 30);
    for (const char* key : {"trace_ms", "mrays_per_s", "nodes_per_ray", "tests_per_ray"})
        EXPECT_GT(row[key].get<double>(), 0.0) << key;
    const PngFile png = read_png(file);
    EXPECT_EQ(png.image.width, 40);
    EXPECT_EQ(png.image.height, 30);
    EXPECT_EQ(Json::parse(png.session_text)["scene"], "cornell");
}

TEST_F(CommandLine, ACameraComesFromATableOfViews) {
    const std::string scene = folder_.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string views =
        folder_.write("views.tsv",
                      "file\tview\teye_x\teye_y\teye_z\ttarget_x\ttarget_y\ttarget_z\tup_x\tup_y\tup_z\tfov\n"
                      "a.obj\taway\t0.2\t0.2\t1\t0.2\t0.2\t2\t0\t1\t0\t45\n"
                      "a.obj\tat\t0.2\t0.2\t1\t0.2\t0.2\t0\t0\t1\t0\t1\n");
    const auto picture = [&](const std::string& view) {
        const std::string file = folder_.write(view + ".png", "");
        const Ended ended = run("trace " + scene + " --size 8x8 --spp 1 -r none --views " + views +
                                " --view " + view + " -o " + file);
        EXPECT_EQ(ended.exit_code, 0) << ended.error;
        return read_png(file).image.rgba;
    };
    EXPECT_NE(picture("at"), picture("away"));
    expect_refusal("trace " + scene + " -r none --views " + views + " --view of", 3, "did you mean at?");
    expect_refusal("trace " + scene + " -r none --view at", 2, "--views FILE");
}

TEST_F(CommandLine, BenchInteractTimesStepsAndStops) {
    const Ended result = run("bench interact -s cornell --steps 2 --first-t 10 --stops 5 --json -");
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json rows = Json::parse(result.output)["rows"];
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0]["times"], 2);
    EXPECT_EQ(rows[1]["times"], 2);
    EXPECT_EQ(rows[2]["times"], 5);
    EXPECT_EQ(rows[3]["recipe"], "none");
    for (const Json& row : rows) EXPECT_LE(row["median_ms"].get<double>(), row["worst_ms"].get<double>());
}

constexpr const char* kQuickly = " -n 100 --rounds 2 --round-ms 0.2 --builds 1 --json -";

TEST_F(CommandLine, BenchLectureSetsNumbersBesideTheLecturesWords) {
    const Ended result = run(std::string("bench lecture -s cornell") + kQuickly);
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json json = Json::parse(result.output);
    EXPECT_EQ(json["command"], "bench lecture");
    EXPECT_TRUE(json["scenes"][0]["uniform"].is_boolean());
    ASSERT_GE(json["rows"].size(), 4u);
    ASSERT_EQ(json["words"].size(), json["rows"].size());
    EXPECT_EQ(json["rows"][0]["recipe"], "none");
    EXPECT_EQ(json["words"][0]["memory_lecture"], "none");
    for (const Json& row : json["rows"])
        for (const char* key :
             {"bytes", "bytes_per_triangle", "build_ms", "primary_mrays_per_s", "diffuse_mrays_per_s"})
            EXPECT_TRUE(row[key].is_number()) << row << key;
    const Ended table = run("bench lecture -s cornell -r none -n 100 --rounds 1 --round-ms 0.2");
    EXPECT_NE(table.output.find("by our rule"), std::string::npos) << table.output;
}

TEST_F(CommandLine, BenchAmortizeSaysWhoWinsForEachDecadeOfRays) {
    const Ended result = run(std::string("bench amortize -s cornell -r none -r bvh-sweep-sah") + kQuickly);
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json json = Json::parse(result.output);
    EXPECT_EQ(json["rows"].size(), 2u * 2u * 7u);
    ASSERT_EQ(json["winners"].size(), 14u);
    EXPECT_EQ(json["winners"][0]["rays"], 10000);
    EXPECT_EQ(json["winners"][6]["rays"], 10000000000);
}

TEST_F(CommandLine, BenchPeersPrintsRowsAndASummary) {
    const Ended result = run(
        "bench peers -s cornell -r bvh-sweep-sah --size 16 --rounds 2 --seconds 0 --sample 20 --threads 1 "
        "-k primary -k shadow -p embree:high --json -");
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json json = Json::parse(result.output);
    const bool has_peers = result.error.find("libembree-dev") == std::string::npos;
    ASSERT_EQ(json["rows"].size(), has_peers ? 6u : 4u);
    EXPECT_EQ(json["rows"][0]["contestant"], "boxwood:bvh-sweep-sah");
    EXPECT_EQ(json["rows"][0]["ratio"].is_number(), has_peers);
    EXPECT_EQ(json["summary"].size(), has_peers ? 2u : 0u);
    EXPECT_EQ(json["rows"].back()["rays_kind"], "shadow");
    expect_refusal("bench peers -k difuse", 2, "did you mean diffuse?");
    expect_refusal("bench peers --threads many", 2, "or \"all\"");
    if (has_peers) expect_refusal("bench peers -p embree:hgih", 2, "did you mean embree:high?");
}

TEST(PeerOptions, WithoutPeersOneSentenceSaysSo) {
    EXPECT_EQ(missing_peers_note(true), "");
    EXPECT_NE(missing_peers_note(false).find("libembree-dev"), std::string::npos);
}

TEST_F(CommandLine, BenchBuildsAndScaleRun) {
    const Ended builds = run("bench builds -s cornell -r bvh-sweep-sah --rounds 1 --threads 1 --json -");
    ASSERT_EQ(builds.exit_code, 0) << builds.error;
    EXPECT_EQ(Json::parse(builds.output)["rows"][0]["recipe"], "bvh-sweep-sah");
    const Ended scale =
        run("bench scale -n 1k -n 2k -n 1M --most 2k -r bvh-sweep-sah -p embree:high --threads 1 --size 16 "
            "--rounds 1 --seconds 0 --builds 1 --json -");
    ASSERT_EQ(scale.exit_code, 0) << scale.error;
    const Json json = Json::parse(scale.output);
    EXPECT_EQ(json["scene"], Json({"terrain@tris=1k", "terrain@tris=2k"}));
    EXPECT_EQ(json["summary"][0]["most_triangles"], json["rows"].back()["triangles"]);
    expect_refusal("bench scale --most all", 2, "a number of triangles");
}

TEST_F(CommandLine, BenchMeasuresSetsMeasuresBesideRates) {
    const Ended result =
        run(std::string("bench measures -s cornell -r bvh-sweep-sah -r bvh-object-median -r kd-sah "
                        "-r 'bvh-sweep-sah > spheres'") +
            kQuickly);
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json json = Json::parse(result.output);
    ASSERT_EQ(json["rows"].size(), 4u);
    for (const char* key : {"sah_cost", "epo", "lcv", "overlap", "empty_volume", "leaf_size_variation",
                            "primary_steps_per_ray", "diffuse_mrays_per_s"})
        EXPECT_TRUE(json["rows"][0][key].is_number()) << key;
    EXPECT_TRUE(json["rows"][3]["epo"].is_null());
    EXPECT_EQ(json["predictions"].size(), 3u * 2u * 8u);
}

TEST_F(CommandLine, BenchTreesEndsWith1WhereAPromiseDoesNotHold) {
    const std::string scene = "bench trees -s cornell --json - --promise ";
    const Ended kept = run(scene + "'sah_cost: bvh-sweep-sah <= bvh-object-median'");
    EXPECT_EQ(kept.exit_code, 0) << kept.error;
    EXPECT_EQ(Json::parse(kept.output)["rows"][0]["holds"], true);
    const Ended broken = run(scene + "'sah_cost: bvh-object-median <= 0.5 * bvh-sweep-sah'");
    EXPECT_EQ(broken.exit_code, 1) << broken.error;
    EXPECT_EQ(Json::parse(broken.output)["rows"][0]["holds"], false);
    EXPECT_EQ(run("bench trees -s cornell").exit_code, 0);
    expect_refusal(scene + "'sah: none <= none'", 2, "did you mean sah_cost?");
}

TEST_F(CommandLine, BenchCollapseSaysWhatLeastCostGainsOverGreedy) {
    const Ended result = run("bench collapse -s cornell -r bvh-spatial-median --builds 1 --json -");
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json rows = Json::parse(result.output)["rows"];
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[2]["recipe"], "bvh-spatial-median > wide16");
    for (const Json& row : rows) EXPECT_LE(row["optimal_cost"], row["greedy_cost"]);
    expect_refusal("bench collapse -s cornell -r kd-sah", 2, "wide4 needs a binary BVH");
}

TEST_F(CommandLine, BenchRefitNeedsAnAnimatedSceneAndWhatCanBeRefitted) {
    const Ended result =
        run(std::string("bench refit -r bvh-spatial-median --every 100 --from 20") + kQuickly);
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const Json rows = Json::parse(result.output)["rows"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1]["scene"], "kitchen@frame=100");
    EXPECT_EQ(rows[1]["from"], 20);
    expect_refusal("bench refit -s cornell", 2, "has no frames");
    expect_refusal("bench refit -r none", 2, "refit needs a binary BVH");
    expect_refusal("bench refit -r 'evh > bvh-binned-sah'", 2, "whole triangles");
    expect_refusal("stats cornell -r 'bvh-sweep-sah > refit(from=3)'", 2, "scene 'cornell' has no frames");
    expect_refusal("stats kitchen@frame=3 -r 'esc > bvh-sweep-sah > refit'", 2, "whole triangles are needed");
    expect_refusal("stats kitchen@frame=120", 2, "a whole number was expected, 0 to 119");
}

}  // namespace
}  // namespace boxwood
