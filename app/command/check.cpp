#include <algorithm>
#include <filesystem>
#include <iostream>

#include "app/cli/options.h"
#include "app/command/check_report.h"
#include "app/command/commands.h"
#include "app/viewer/headless.h"
#include "core/base/file.h"
#include "core/render/png.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

/// The sessions of a folder, by name.
std::vector<fs::path> session_files(const std::string& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".json" && entry.is_regular_file()) files.push_back(entry.path());
    }
    if (error)
        throw Error(ExitCode::BadInput, folder + ": expected a folder of sessions: " + error.message());
    if (files.empty())
        throw Error(ExitCode::BadInput, folder + ": expected sessions, *.json; there are none");
    std::ranges::sort(files);
    return files;
}

bool within(const Comparison& comparison, const CheckLimits& limits) {
    return comparison.same_size && comparison.different_pixels <= static_cast<uint64_t>(limits.pixels) &&
           comparison.largest_tile_mean <= limits.tile_mean;
}

CheckRow check_session(Headless& headless, const fs::path& file, bool update) {
    CheckRow row;
    row.name = file.stem().string();
    const std::string picture = fs::path(file).replace_extension(".png").string();
    try {
        const std::optional<Session> session = load_session(file.string());
        if (!session) throw Error(ExitCode::BadInput, file.string() + ": expected a session");
        row.limits = session->limits;
        row.result = headless.capture(*session);
        if (fs::exists(picture)) {
            row.reference = read_png(picture).image;
            row.comparison = compare_images(row.reference, row.result, row.limits.difference);
            row.passed = within(row.comparison, row.limits);
        } else {
            row.problem = picture + " is missing";
        }
        if (!row.passed && update) {
            write_png(picture, row.result, print_session(*session, session_folder(picture)));
            row.updated = row.passed = true;
        }
    } catch (const Error& error) {
        row.problem = error.what();
    }
    return row;
}

}  // namespace

ExitCode run_check(Arguments arguments) {
    std::string folder;
    std::string report = (fs::temp_directory_path() / "boxwood-check.html").string();
    bool update = false;
    Options options("check", "Renders every session of a folder and compares it with the picture beside it.");
    options.argument("DIR", folder, /*required=*/true, "sessions NAME.json and their pictures NAME.png");
    options.flag("--update", update, "renew the pictures that differ");
    options.text("--report", "FILE", report, "page with reference, result and difference side by side");
    if (!options.parse(arguments)) return ExitCode::Done;

    check_writable(report);
    Headless headless;
    std::vector<CheckRow> rows;
    size_t failed = 0;
    for (const fs::path& file : session_files(folder)) {
        rows.push_back(check_session(headless, file, update));
        const CheckRow& row = rows.back();
        if (!row.passed) ++failed;
        std::cout << (row.updated  ? "renewed "
                      : row.passed ? "same    "
                                   : "DIFFERS ")
                  << row.name << ": " << verdict(row) << std::endl;
    }
    write_file_atomically(report, check_page(folder, rows));
    std::cout << rows.size() << " sessions, " << failed << " differ; see " << report << '\n';
    return failed == 0 ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace boxwood
