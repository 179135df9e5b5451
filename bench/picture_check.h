#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/task.h"
#include "core/scene/camera.h"
#include "core/scene/mesh.h"
#include "core/structure/structure.h"

namespace boxwood::bench {

/// Which rays are checked: those through the pixel centres, as a traced picture casts them.
struct PictureCheckSettings {
    Camera camera;
    int width = 0, height = 0;
    uint64_t sample_count =
        0;                 ///< of them judged by rational arithmetic, evenly spread; more than there are: all
    double seconds = 1.0;  ///< for timing both modes; 0: not timed
};

/// What one mode answered. A wrong answer: a hit for a miss or a miss for a hit; another primitive than the
/// nearest; in exact mode also another t than the exact one rounded once.
struct ModeCheck {
    uint64_t wrong_hits = 0, wrong_prims = 0, wrong_t = 0;
    std::vector<uint32_t> wrong_pixels;  ///< y * width + x, ascending
    uint64_t timed_rays = 0;             ///< as many of the picture as time allowed
    double rays_per_second = 0.0;        ///< on all threads; 0: not timed

    uint64_t wrong() const { return wrong_hits + wrong_prims + wrong_t; }
};

/// A picture's rays against rational arithmetic.
struct PictureCheck {
    int width = 0, height = 0;
    uint64_t rays = 0;               ///< of the picture
    uint64_t checked = 0;            ///< of them judged
    std::array<ModeCheck, 2> modes;  ///< by Mode
    double ms = 0.0;
};

/// On all threads; task.done counts rays cast and judged. After a stop not to be used. The counts and pixels
/// are the same for any number of threads.
PictureCheck check_picture(const Mesh& mesh, const Structure& structure, const PictureCheckSettings& settings,
                           Task& task);

/// Who casts the rays that are timed.
struct Contender {
    const Structure* structure;
    Mode mode = Mode::Exact;
};

struct RayTiming {
    uint64_t rays = 0;             ///< as many of the picture as time allowed
    double rays_per_second = 0.0;  ///< on all threads; 0: not timed
};

/// Both in turns over the same rays of the picture until settings.seconds are used, so that a change of the
/// machine's speed meets both. Blocks of neighbouring pixels, as a picture is traced; the blocks are spread
/// over the picture. After a stop not to be used.
std::array<RayTiming, 2> time_in_turns(const Mesh& mesh, const std::array<Contender, 2>& contenders,
                                       const PictureCheckSettings& settings, Task& task);

/// `count` different numbers below `total`, ascending and evenly spread; all where there are no more.
std::vector<uint32_t> even_sample(uint64_t total, uint64_t count);

/// The numbers below `total` in an order in which every first part is spread over all.
std::vector<uint32_t> spread_order(uint64_t total);

}  // namespace boxwood::bench
