#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/catalog/recipe.h"
#include "core/scene/scene.h"

namespace boxwood {

/// Result of one stage, with what it cost and left out. Exactly one of the first four is set.
struct StageResult {
    std::shared_ptr<const References> references;  ///< of the references stage
    std::optional<Structure> structure;            ///< of the builder or a transform
    std::shared_ptr<const LevelTable> levels;      ///< of the structure; made when it is first asked for
    std::shared_ptr<const Scene> scene;            ///< another frame of the scene, for TakesInputOfFrame
    uint64_t content_hash = 0;                     ///< of the references
    double ms = 0.0;
    size_t byte_count = 0;
    std::map<std::string, uint64_t> skipped;
};

/// Stage results under scene hash and what they are made from; bounded in bytes, least recently used goes
/// first. A result that is larger than the bound is not kept. Thread-safe.
class StageCache {
public:
    explicit StageCache(size_t byte_limit = size_t{2} << 30) : byte_limit_(byte_limit) {}
    std::shared_ptr<const StageResult> find(const std::string& key);
    void put(const std::string& key, std::shared_ptr<const StageResult> result);
    void clear();
    size_t byte_count() const;
    size_t byte_limit() const { return byte_limit_; }
    uint64_t run_count() const;  ///< stages that were run because they were not here: put() calls

private:
    struct Entry {
        std::string key;
        std::shared_ptr<const StageResult> result;
    };
    void remove(std::list<Entry>::iterator entry);

    size_t byte_limit_;
    mutable std::mutex mutex_;
    std::list<Entry> entries_;  ///< most recently used first
    std::map<std::string, std::list<Entry>::iterator> index_;
    size_t byte_count_ = 0;
    uint64_t run_count_ = 0;
};

/// A recipe run over a scene.
struct Built {
    std::shared_ptr<const Scene> scene;
    Recipe recipe;
    std::shared_ptr<const References> references;
    Structure structure;
    std::shared_ptr<const LevelTable> levels;  ///< null unless asked for
    double references_ms = 0.0;  ///< as it took when it was run, also where the result came from the cache
    double build_ms = 0.0;       ///< builder and transforms
    std::map<std::string, uint64_t> skipped;  ///< by all stages, the scene's own not included
};

/// Runs the stages that `cache` does not hold. References are kept under the scene's hash and their stage's
/// text, structures under the hash of the references and the texts from the builder on: where another
/// threshold gives the same references, nothing is built again. The input of a TakesInputOfFrame is run on
/// its own frame of the scene, which is opened and kept like a stage; its structure is kept under both
/// frames' references. Throws Error (WrongUsage) where the scene has no such frame or the references are not
/// whole. Nothing if task.stop was requested before it was done. With `with_levels` the node list is made
/// too, as a stage of its own. task.done and task.total are those of the stage that runs.
std::optional<Built> run_recipe(const Recipe& recipe, std::shared_ptr<const Scene> scene, StageCache& cache,
                                Task& task, bool with_levels = false);

/// What run_recipe would give, if the cache holds all of it; otherwise nothing.
std::optional<Built> find_recipe(const Recipe& recipe, std::shared_ptr<const Scene> scene, StageCache& cache,
                                 bool with_levels = false);

/// "takes about 50 s for 871306 triangles" where a stage of the recipe says that it takes more than a few
/// seconds (see EstimatesTime); otherwise empty.
std::string long_build_warning(const Recipe& recipe, size_t triangle_count);

}  // namespace boxwood
