#include "app/command/commands.h"
#include "app/command/shared.h"

namespace boxwood {

ExitCode run_scenes(Arguments arguments) {
    std::string json;
    Options options("scenes", "Lists the built-in scenes.");
    options.text("--json", "FILE", json, "write the table as JSON (- for standard output)");
    options.footer(
        "Every scene, also a file, takes the suffixes @rot=DEGREES,X,Y,Z, @scale=S, @move=X,Y,Z and\n"
        "@subdivide=N (each triangle into 4^N), applied in the order given.\n");
    if (!options.parse(arguments)) return ExitCode::Done;
    Report report{"scenes", {}, {}, {}};
    for (const BuiltInScene& scene : built_in_scenes())
        report.rows.push_back(ReportRow()
                                  .set("scene", std::string(scene.name))
                                  .set("options", std::string(scene.options))
                                  .set("description", std::string(scene.description)));
    print_report(report, json);
    return ExitCode::Done;
}

}  // namespace boxwood
