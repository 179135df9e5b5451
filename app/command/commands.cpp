#include "app/command/commands.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "core/measure/machine.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

constexpr Command kCommands[] = {
    {"view", "opens the window (also without a command: boxwood SCENE)", run_view},
    {"shot", "draws the window's frame without a window, as a picture", run_shot},
    {"trace", "renders a picture with the CPU ray tracer", run_trace},
    {"stats", "builds structures and prints what they are made of", run_stats},
    {"verify", "compares the hits of structures with brute force, ray by ray", run_verify},
    {"stress", "casts rays that are hard for floating point, judged by exact arithmetic", run_stress},
    {"cast", "casts the rays of a file", run_cast},
    {"check", "renders the sessions of a folder and compares them with their pictures", run_check},
    {"bench", "measures: how quickly the program answers, run time against error", run_bench},
    {"scenes", "lists the built-in scenes", run_scenes},
    {"list", "lists the stages of recipes with their parameters", run_list},
};

void print_help() {
    std::string text =
        "Boxwood shows what a ray tracing acceleration structure really looks like, level by level, and "
        "what\n"
        "each choice in building it costs.\n\n"
        "Usage: boxwood COMMAND ...\n\n"
        "Commands:\n";
    for (const Command& command : commands()) {
        std::string name = command.name;
        name.resize(8, ' ');
        text += "  " + name + command.summary + "\n";
    }
    text +=
        "\nA SCENE is a file (glTF/GLB, OBJ, PLY, STL, and what else Assimp reads) or a built-in name, with\n"
        "suffixes where wanted: boxwood stats spaceship@rot=45,1,1,1 --recipe bvh-sweep-sah\n\n"
        "  boxwood COMMAND --help   what the command takes\n"
        "  boxwood --version        version and commit\n\n"
        "Exit codes: 0 done and holds, 1 a check did not hold, 2 wrong usage, 3 input that cannot be read,\n"
        "4 no usable display or OpenGL.\n";
    std::fputs(text.c_str(), stdout);
}

const Command* find_command(const std::string& name) {
    for (const Command& command : commands())
        if (name == command.name) return &command;
    return nullptr;
}

/// Whether the word can be a scene or a session: a file that is there, a built-in, or written like a file.
bool looks_like_scene(const std::string& word) {
    const std::string name = word.substr(0, word.find('@'));
    for (const BuiltInScene& scene : built_in_scenes())
        if (name == scene.name) return true;
    std::error_code error;
    return word.find_first_of("./\\@") != std::string::npos || std::filesystem::exists(word, error);
}

[[noreturn]] void refuse_word(const std::string& word) {
    std::vector<std::string> words;
    for (const Command& command : commands()) words.emplace_back(command.name);
    for (const BuiltInScene& scene : built_in_scenes()) words.emplace_back(scene.name);
    throw Error(ExitCode::WrongUsage, "there is no command, file or scene \"" + to_utf8(word) +
                                          "\"; did you mean " + nearest_word(word, words) +
                                          "? (see boxwood --help)");
}

}  // namespace

std::span<const Command> commands() { return kCommands; }

ExitCode run_program(Arguments arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first == "--help" || first == "-h" || first == "help") {
        print_help();
        return ExitCode::Done;
    }
    if (first == "--version") {
        std::printf("boxwood %s, commit %s\n", build_version().c_str(), build_commit().c_str());
        return ExitCode::Done;
    }
    if (const Command* command = find_command(first)) return command->run(arguments.subspan(1));
    if (!arguments.empty() && !first.starts_with("-") && !looks_like_scene(first)) refuse_word(first);
    const Command* view = find_command("view");
    if (!view) throw Error(ExitCode::WrongUsage, "a command is missing (see boxwood --help)");
    return view->run(arguments);
}

}  // namespace boxwood
