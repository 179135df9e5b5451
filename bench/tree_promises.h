#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/catalog/pipeline.h"
#include "core/measure/report.h"

namespace boxwood::bench {

/// What a promise about trees is about; none depends on the machine.
enum class TreeValue : uint8_t {
    SahCost,
    WideCost,  ///< of wide BVHs, see wide_cost; costs of nodes and packs as wide4, wide8 and wide16 have them
    References,
    Nodes,
    Bytes,
};

/// "The value of one recipe's tree is at most `factor` times that of another's."
struct TreePromise {
    TreeValue value;
    Recipe recipe;
    double factor;
    Recipe reference;
};

/// "sah_cost: bvh-sweep-sah <= 1.5 * bvh-binned-sah": value, recipe, factor (1 where left out), recipe. The
/// values are sah_cost, wide_cost, references, nodes and bytes. Throws Error (WrongUsage) that says what was
/// expected.
TreePromise parse_promise(const std::string& text);

/// parse_promise(print(promise)) is the promise again.
std::string print(const TreePromise& promise);

/// What the catalog's methods promise on every scene.
std::span<const char* const> catalog_promises();

/// A promise on one scene.
struct KeptPromise {
    double value = 0.0, reference = 0.0;
    bool holds = false;  ///< value <= factor * reference, but for rounding in the sums
};

/// Builds both trees, or takes them from the cache. After a stop not to be used.
KeptPromise check_promise(const TreePromise& promise, std::shared_ptr<const Scene> scene, StageCache& cache,
                          Task& task);

ReportRow promise_row(const TreePromise& promise, const KeptPromise& kept, const Scene& scene);

}  // namespace boxwood::bench
