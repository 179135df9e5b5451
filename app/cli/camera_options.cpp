#include "app/cli/camera_options.h"

#include <charconv>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/base/error.h"
#include "core/scene/camera.h"

namespace boxwood {
namespace {

constexpr size_t kColumns = 12;

std::vector<std::string> columns_of(const std::string& line) {
    std::vector<std::string> columns;
    std::istringstream stream(line);
    for (std::string column; std::getline(stream, column, '\t');) columns.push_back(column);
    return columns;
}

Camera camera_from(const std::vector<std::string>& columns, const std::string& place) {
    float numbers[kColumns - 2] = {};
    for (size_t i = 2; i < kColumns; ++i) {
        const std::string& text = columns[i];
        const char* end = text.data() + text.size();
        const std::from_chars_result result = std::from_chars(text.data(), end, numbers[i - 2]);
        if (result.ec != std::errc() || result.ptr != end)
            throw Error(ExitCode::BadInput, place + ": \"" + to_utf8(text) + "\" in column " +
                                                std::to_string(i + 1) + ", expected a number");
    }
    Camera camera;
    camera.eye = {numbers[0], numbers[1], numbers[2]};
    camera.target = {numbers[3], numbers[4], numbers[5]};
    camera.up = {numbers[6], numbers[7], numbers[8]};
    camera.fov = numbers[9];
    return camera;
}

}  // namespace

Camera read_view(const std::string& views_file, const std::string& scene_file, const std::string& view) {
    std::ifstream file(views_file);
    std::string line;
    if (!std::getline(file, line))
        throw Error(ExitCode::BadInput, views_file + ": cannot be read, or is empty");
    std::vector<std::string> names;
    for (size_t number = 2; std::getline(file, line); ++number) {
        const std::vector<std::string> columns = columns_of(line);
        if (columns.size() < 2 || columns[0] != scene_file) continue;
        names.push_back(columns[1]);
        if (!view.empty() && columns[1] != view) continue;
        const std::string place = views_file + ", line " + std::to_string(number);
        if (columns.size() != kColumns)
            throw Error(ExitCode::BadInput, place + ": has " + std::to_string(columns.size()) +
                                                " columns, expected " + std::to_string(kColumns));
        return camera_from(columns, place);
    }
    if (names.empty())
        throw Error(ExitCode::BadInput, views_file + ": has no view of " + to_utf8(scene_file));
    throw Error(ExitCode::BadInput, views_file + ": has no view \"" + to_utf8(view) + "\" of " +
                                        to_utf8(scene_file) + "; did you mean " + nearest_word(view, names) +
                                        "?");
}

void CameraOptions::add_to(Options& options) {
    options.text("--views", "FILE", views_file_,
                 "table of views: file, view, eye, target, up, field of view, tab-separated");
    options.text("--view", "NAME", view_, "view of the scene's file in that table (default: the first)");
    options.vec3("--eye", eye_, "where the camera is (default: the scene's view, or one of all of it)");
    options.vec3("--target", target_, "what it looks at");
    options.vec3("--up", up_, "which way is up");
    options.real("--fov", fov_, 1.0, 170.0, "vertical field of view in degrees");
}

Camera CameraOptions::camera(const Scene& scene) const {
    if (views_file_.empty() && !view_.empty())
        throw Error(ExitCode::WrongUsage, "--view needs the table of views: --views FILE");
    Camera camera = scene.camera.value_or(fit_camera(scene.mesh.bounds()));
    if (!views_file_.empty()) {
        const std::string file = scene.title.substr(0, scene.title.find('@'));
        camera = read_view(views_file_, file, view_);
    }
    if (eye_) camera.eye = *eye_;
    if (target_) camera.target = *target_;
    if (up_) camera.up = *up_;
    if (fov_ > 0.0) camera.fov = static_cast<float>(fov_);
    return camera;
}

}  // namespace boxwood
