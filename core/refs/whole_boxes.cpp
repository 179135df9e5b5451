#include "core/refs/whole_boxes.h"

#include "core/base/parallel.h"

namespace boxwood {

References WholeBoxes::make(const Mesh& mesh, Task& task) const {
    References result;
    result.refs.resize(mesh.triangle_count());
    task.total = mesh.triangle_count();
    parallel_for(mesh.triangle_count(), 4096, [&](size_t begin, size_t end) {
        if (task.stopped()) return;
        for (size_t i = begin; i < end; ++i) {
            const uint32_t prim = static_cast<uint32_t>(i);
            result.refs[i] = {mesh.triangle(prim).bounds(), prim};
        }
        task.done += end - begin;
    });
    return result;
}

}  // namespace boxwood
