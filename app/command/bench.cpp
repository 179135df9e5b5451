#include <cstdio>
#include <string>
#include <vector>

#include "app/command/commands.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

/// One suite of measurements, with options of its own.
constexpr Command kSuites[] = {
    {"amortize", "from how many rays on a better structure pays for its build", run_bench_amortize},
    {"builds", "what builds take, in turns with those of Embree", run_bench_builds},
    {"collapse", "binary hierarchies into wide ones: least cost against greedy", run_bench_collapse},
    {"error", "run time against error: both modes and plain double precision", run_bench_error},
    {"interact", "how quickly the program answers", run_bench_interact},
    {"lecture", "the lecture's comparison of structures: memory, build, rays", run_bench_lecture},
    {"measures", "which measure of a tree tells its rays per second", run_bench_measures},
    {"peers", "recipes side by side with Embree: rays per second, build, bytes, wrong answers",
     run_bench_peers},
    {"refit", "refit against rebuild, by frame of an animated scene", run_bench_refit},
    {"scale", "build, bytes and rays per second of one terrain in growing sizes", run_bench_scale},
    {"trees", "what builders and transforms promise about their trees", run_bench_trees},
};

void print_help() {
    std::string text =
        "Measures. Each suite has options of its own.\n\n"
        "Usage: boxwood bench SUITE [OPTIONS]\n\n"
        "Suites:\n";
    for (const Command& suite : kSuites) {
        std::string name = suite.name;
        name.resize(10, ' ');
        text += "  " + name + suite.summary + "\n";
    }
    text += "\n  boxwood bench SUITE --help   what the suite takes\n";
    std::fputs(text.c_str(), stdout);
}

}  // namespace

ExitCode run_bench(Arguments arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first == "--help" || first == "-h") {
        print_help();
        return ExitCode::Done;
    }
    std::vector<std::string> names;
    for (const Command& suite : kSuites) {
        if (first == suite.name) return suite.run(arguments.subspan(1));
        names.emplace_back(suite.name);
    }
    if (first.empty() || first.starts_with("-"))
        throw Error(ExitCode::WrongUsage, "SUITE is required (see boxwood bench --help)");
    throw Error(ExitCode::WrongUsage, "there is no suite \"" + to_utf8(first) + "\"; did you mean " +
                                          nearest_word(first, names) + "?");
}

}  // namespace boxwood
