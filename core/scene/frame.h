#pragma once

#include <optional>
#include <string>

#include "core/scene/scene.h"

namespace boxwood {

/// Frames that an animated scene may have at most: how far sliders and parameters reach.
inline constexpr int kMostFrames = 120;

/// Where a spec stands in an animated scene: frame 0 to count - 1, after which frame 0 comes again.
struct SceneFrame {
    int frame;
    int count;
};

/// Nothing where the scene has no frames, or where the spec cannot be understood.
std::optional<SceneFrame> scene_frame(const std::string& spec);

/// The spec of another frame of the same scene: all other suffixes as they are, frame 0 left out. Throws
/// Error (WrongUsage) for a scene without frames or a frame that it does not have.
std::string with_frame(const std::string& spec, int frame);

/// For generators: what "frame" says, 0 where it is not given. Throws Error (WrongUsage) for anything else
/// than a whole number from 0 to count - 1.
int frame_option(const SceneOptions& options, const std::string& scene, int count);

}  // namespace boxwood
