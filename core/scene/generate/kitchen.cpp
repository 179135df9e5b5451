#include "core/scene/frame.h"
#include "core/scene/generate/built_in.h"
#include "core/scene/generate/kitchen_pieces.h"

namespace boxwood {

static_assert(kKitchenFrames <= kMostFrames);

void make_kitchen(const SceneOptions& options, Scene& scene, Task& task) {
    const int frame = frame_option(options, "kitchen", kKitchenFrames);
    Rng rng(2001);
    MeshBuilder b(scene.mesh);
    kitchen::add_room(b);
    kitchen::add_window(b, rng);
    kitchen::add_cupboards(b);
    kitchen::add_stove(b);
    kitchen::add_sink(b);
    kitchen::add_fridge(b);
    if (task.stopped()) return;
    kitchen::add_dresser(b, rng);
    kitchen::add_rug(b);
    kitchen::add_table(b, rng);
    kitchen::add_small_things(b, rng);
    kitchen::add_moving_things(b, static_cast<double>(frame) / kKitchenFrames);
    scene.camera = Camera{.eye = {5.35f, 1.78f, 4.55f}, .target = {2.55f, 0.98f, 1.4f}, .fov = 56.0f};
}

}  // namespace boxwood
