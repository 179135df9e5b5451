#include "core/catalog/pipeline.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/timer.h"
#include "core/scene/frame.h"

namespace boxwood {
namespace {

constexpr const char* kVersion = "1";  ///< goes up where a stage's result changes for the same text

using Counts = std::map<std::string, uint64_t>;

void add(Counts& sum, const Counts& counts) {
    for (const auto& [reason, count] : counts) sum[reason] += count;
}

/// What `after` counts beyond `before`.
Counts difference(const Counts& after, const Counts& before) {
    Counts result;
    for (const auto& [reason, count] : after) {
        const auto old = before.find(reason);
        const uint64_t added = count - (old == before.end() ? 0 : old->second);
        if (added > 0) result[reason] = added;
    }
    return result;
}

std::string hex(uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

/// Of every bit of every reference, in order; the same for any number of threads.
uint64_t hash_of(std::span<const PrimRef> refs) {
    constexpr size_t kGrain = 1 << 14;
    using Words = std::array<uint32_t, 7>;
    static_assert(sizeof(PrimRef) == sizeof(Words));
    std::vector<uint64_t> hashes((refs.size() + kGrain - 1) / kGrain);
    parallel_for(refs.size(), kGrain, [&](size_t begin, size_t end) {
        uint64_t hash = end - begin;
        for (const PrimRef& ref : refs.subspan(begin, end - begin)) {
            const Words w = std::bit_cast<Words>(ref);
            // Odd factors part the words; one round for all of them.
            hash = mix_bits(hash ^ ((uint64_t{w[0]} << 32 | w[1]) * 0x9e3779b97f4a7c15ull +
                                    (uint64_t{w[2]} << 32 | w[3]) * 0xc2b2ae3d27d4eb4full +
                                    (uint64_t{w[4]} << 32 | w[5]) * 0x165667b19e3779f9ull +
                                    w[6] * 0xd6e8feb86659fd93ull));
        }
        hashes[begin / kGrain] = hash;
    });
    uint64_t all = refs.size();
    for (const uint64_t hash : hashes) all = mix_bits(all + hash);
    return all;
}

/// The result under `key`, run if the cache does not have it. Null if the task was stopped.
std::shared_ptr<const StageResult> run_stage(const std::string& key, StageCache& cache, Task& task,
                                             const std::function<void(StageResult&)>& run) {
    if (std::shared_ptr<const StageResult> known = cache.find(key)) return known;
    if (task.stopped()) return nullptr;
    task.done = 0;
    task.total = 0;
    const Counts before = task.skipped.counts();
    auto result = std::make_shared<StageResult>();
    const Timer timer;
    run(*result);
    result->ms = timer.milliseconds();
    if (task.stopped()) return nullptr;
    result->skipped = difference(task.skipped.counts(), before);
    cache.put(key, result);
    return result;
}

/// Runs the stages of one recipe, each on the scene that it belongs to. Nothing where the task was stopped.
class Runner {
public:
    Runner(const Recipe& recipe, StageCache& cache, Task& task)
        : recipe_(recipe), cache_(cache), task_(task) {}

    using Result = std::shared_ptr<const StageResult>;
    using ScenePointer = std::shared_ptr<const Scene>;

    /// A structure with what it took from the builder on.
    struct Made {
        Result result{};
        std::string key{};
        double ms = 0.0;
        Counts skipped{};
    };

    Result references(const Scene& scene) {
        Result& made = references_[scene.content_hash];
        if (made) return made;
        return made =
                   run_stage(scene_key(scene) + prefix(recipe_, 1), cache_, task_, [&](StageResult& result) {
                       result.references =
                           std::make_shared<References>(recipe_.references.method().make(scene.mesh, task_));
                       result.byte_count = result.references->refs.capacity() * sizeof(PrimRef);
                       if (!task_.stopped()) result.content_hash = hash_of(result.references->refs);
                   });
    }

    /// After the builder and the first `count` transforms.
    std::optional<Made> structure(const ScenePointer& scene, size_t count) {
        const Result made = references(*scene);
        if (!made) return std::nullopt;
        const std::span<const PrimRef> refs = made->references->refs;
        const std::string own_key = scene_key(*scene) + hex(made->content_hash);
        if (count == 0) {
            return finish(Made{.key = own_key}, recipe_.builder,
                          [&] { return recipe_.builder.method().build(scene->mesh, refs, task_); });
        }
        const Stage& stage = recipe_.transforms[count - 1];
        const std::optional<int> frame = stage.method().input_frame();
        const ScenePointer input_scene = frame ? frame_for(stage, *frame, scene) : scene;
        std::optional<Made> input;
        if (input_scene) input = structure(input_scene, count - 1);
        if (!input) return std::nullopt;
        const Structure before = *input->result->structure;
        if (frame) input->key = own_key + " over {" + input->key + "}";
        return finish(*std::move(input), stage,
                      [&] { return stage.method().apply(scene->mesh, refs, before, task_); });
    }

private:
    static std::string scene_key(const Scene& scene) {
        return std::string(kVersion) + " " + hex(scene.content_hash) + " > ";
    }

    /// The stage's own result, added to what came before it.
    template <class Run>
    std::optional<Made> finish(Made made, const Stage& stage, const Run& run) {
        made.key += " > " + stage.text();
        made.result = run_stage(made.key, cache_, task_, [&](StageResult& result) {
            result.structure = run();
            result.byte_count = result.structure->byte_count();
        });
        if (!made.result) return std::nullopt;
        made.ms += made.result->ms;
        add(made.skipped, made.result->skipped);
        return made;
    }

    /// The scene on the frame that the stage's input is built on. Throws Error where there is none.
    ScenePointer frame_for(const Stage& stage, int frame, const ScenePointer& scene) {
        const auto refuse = [&](const std::string& why) {
            throw Error(ExitCode::WrongUsage, stage.text() + ": " + why);
        };
        if (recipe_.references.text() != kWholeReferences) {
            refuse("whole triangles are needed, " + std::string(recipe_.references.entry().id) +
                   " makes pieces, which are those of one frame");
        }
        const std::optional<SceneFrame> shown = scene_frame(scene->spec);
        if (shown && shown->frame == frame) return scene;
        std::string spec;
        try {
            spec = with_frame(scene->spec, frame);
        } catch (const Error& error) {
            refuse(error.what());
        }
        const Result opened = run_stage("scene " + spec, cache_, task_, [&](StageResult& result) {
            result.scene = open_scene(spec, task_);
            result.byte_count = result.scene->mesh.byte_count();
        });
        if (!opened) return nullptr;
        if (opened->scene->mesh.source_prim != scene->mesh.source_prim) {
            refuse("\"" + to_utf8(spec) + "\" has other triangles than \"" + to_utf8(scene->spec) +
                   "\": some were left out on one frame alone");
        }
        return opened->scene;
    }

    const Recipe& recipe_;
    StageCache& cache_;
    Task& task_;
    std::map<uint64_t, Result> references_;  ///< by scene: needed again by each stage, kept or not
};

}  // namespace

std::shared_ptr<const StageResult> StageCache::find(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = index_.find(key);
    if (found == index_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->result;
}

void StageCache::put(const std::string& key, std::shared_ptr<const StageResult> result) {
    const std::scoped_lock lock(mutex_);
    ++run_count_;
    if (const auto old = index_.find(key); old != index_.end()) remove(old->second);
    if (result->byte_count > byte_limit_) return;
    byte_count_ += result->byte_count;
    entries_.push_front({key, std::move(result)});
    index_[key] = entries_.begin();
    while (byte_count_ > byte_limit_) remove(std::prev(entries_.end()));
}

void StageCache::remove(std::list<Entry>::iterator entry) {
    byte_count_ -= entry->result->byte_count;
    index_.erase(entry->key);
    entries_.erase(entry);
}

void StageCache::clear() {
    const std::scoped_lock lock(mutex_);
    index_.clear();
    entries_.clear();
    byte_count_ = 0;
}

size_t StageCache::byte_count() const {
    const std::scoped_lock lock(mutex_);
    return byte_count_;
}

uint64_t StageCache::run_count() const {
    const std::scoped_lock lock(mutex_);
    return run_count_;
}

std::optional<Built> run_recipe(const Recipe& recipe, std::shared_ptr<const Scene> scene, StageCache& cache,
                                Task& task, bool with_levels) {
    Runner runner(recipe, cache, task);
    const auto made = runner.references(*scene);
    if (!made) return std::nullopt;
    const std::optional<Runner::Made> last = runner.structure(scene, recipe.transforms.size());
    if (!last) return std::nullopt;
    const Structure structure = *last->result->structure;
    Counts skipped = made->skipped;
    add(skipped, last->skipped);

    std::shared_ptr<const LevelTable> levels;
    if (with_levels) {
        const auto listed = run_stage(last->key + " > levels", cache, task, [&](StageResult& result) {
            result.levels = std::make_shared<LevelTable>(make_level_table(structure.list_nodes()));
            result.byte_count = result.levels->byte_count();
        });
        if (!listed) return std::nullopt;
        levels = listed->levels;
    }
    return Built{std::move(scene),  recipe,   made->references, structure,
                 std::move(levels), made->ms, last->ms,         std::move(skipped)};
}

std::optional<Built> find_recipe(const Recipe& recipe, std::shared_ptr<const Scene> scene, StageCache& cache,
                                 bool with_levels) {
    std::stop_source stop;
    stop.request_stop();
    Task task(stop.get_token());  // finds, and runs nothing
    return run_recipe(recipe, std::move(scene), cache, task, with_levels);
}

std::string long_build_warning(const Recipe& recipe, size_t triangle_count) {
    constexpr double kFewSeconds = 5.0;
    double seconds = recipe.builder.method().estimate_seconds(triangle_count);
    for (const Stage& transform : recipe.transforms)
        seconds += transform.method().estimate_seconds(triangle_count);
    if (seconds <= kFewSeconds) return {};
    return "takes about " + std::to_string(std::lround(seconds)) + " s for " +
           std::to_string(triangle_count) + " triangles";
}

}  // namespace boxwood
