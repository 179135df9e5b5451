#include "bench/build_time.h"

#include "bench/timing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace boxwood::bench {

std::optional<TimedBuild> build_timed(const Recipe& recipe, const Mesh& mesh, int threads, Task& task) {
    for (const Stage& transform : recipe.transforms) {
        if (transform.method().input_frame())
            throw Error(ExitCode::WrongUsage,
                        transform.text() + " needs another frame: it has no build time");
    }
    const ThreadLimit limit(threads);
    const double begin = clock_ms(threads);
    const References references = recipe.references.method().make(mesh, task);
    const double middle = clock_ms(threads);
    if (task.stopped()) return std::nullopt;
    Structure structure = recipe.builder.method().build(mesh, references.refs, task);
    for (const Stage& transform : recipe.transforms) {
        if (task.stopped()) return std::nullopt;
        structure = transform.method().apply(mesh, references.refs, Structure(structure), task);
    }
    const double end = clock_ms(threads);
    if (task.stopped()) return std::nullopt;
    return TimedBuild{std::move(structure), references.refs.size(), middle - begin, end - middle};
}

}  // namespace boxwood::bench
