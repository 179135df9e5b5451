#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/cli/options.h"
#include "core/scene/scene.h"

namespace boxwood {

/// Options that choose a camera: --view NAME of a --views file, or --eye, --target, --up, --fov.
class CameraOptions {
public:
    void add_to(Options& options);

    /// The scene's own view or all of the scene, changed by what was given. Throws Error (BadInput) where the
    /// file of views cannot be read or does not have the view.
    Camera camera(const Scene& scene) const;

private:
    std::string views_file_, view_;
    std::optional<Vec3> eye_, target_, up_;
    double fov_ = 0.0;  ///< 0: as it is
};

/// Reads a view of a tab-separated file whose first line names the columns: file, view, eye_x, eye_y, eye_z,
/// target_x, ..., up_z, fov_vertical_degrees. `scene_file`: the file's name without folders. An empty view
/// name means the first of that file.
Camera read_view(const std::string& views_file, const std::string& scene_file, const std::string& view);

}  // namespace boxwood
