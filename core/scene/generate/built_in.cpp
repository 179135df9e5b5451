#include "core/scene/generate/built_in.h"

namespace boxwood {

const std::vector<BuiltInScene>& built_in_scenes() {
    static const std::vector<BuiltInScene> scenes = {
        {"atrium", "A court of two storeys with columns, arches, vaults and stairs among large walls.", "",
         make_atrium},
        {"spaceship", "A hull of really long thin triangles with small detail, turned by 45 degrees.", "",
         make_spaceship},
        {"kitchen",
         "A room of a few huge triangles with finely cut furniture, some of it moving: frames 0 to 119.",
         "frame=N", make_kitchen, kKitchenFrames},
        {"mirror-low", "A car's outside mirror, a smooth CAD surface cut coarsely.", "", make_mirror_low},
        {"mirror-high", "The same surface cut finely: four times the triangles.", "", make_mirror_high},
        {"power-plant", "A hall of pipes, girders and gratings; 1.7 million triangles.", "",
         make_power_plant},
        {"cornell", "The Cornell box: a room with a light and two blocks.", "", make_cornell},
        {"two-triangles", "Two long slanting triangles whose boxes overlap.", "", make_two_triangles},
        {"terrain", "A smooth, dense height field of any size.", "tris=N", make_terrain},
    };
    return scenes;
}

}  // namespace boxwood
