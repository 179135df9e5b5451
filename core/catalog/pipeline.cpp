#include "core/catalog/pipeline.h"

#include <array>
#include <bit>
#include <cstdio>
#include <functional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/timer.h"

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
            hash = mix_bits(hash ^ (uint64_t{w[0]} << 32 | w[1]));
            hash = mix_bits(hash ^ (uint64_t{w[2]} << 32 | w[3]));
            hash = mix_bits(hash ^ (uint64_t{w[4]} << 32 | w[5]));
            hash = mix_bits(hash ^ w[6]);
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
    if (task.stopped()) return nullptr;
    if (std::shared_ptr<const StageResult> known = cache.find(key)) return known;
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
    const Mesh& mesh = scene->mesh;
    std::string key = std::string(kVersion) + " " + hex(scene->content_hash) + " > ";
    const auto made = run_stage(key + prefix(recipe, 1), cache, task, [&](StageResult& result) {
        result.references = std::make_shared<References>(recipe.references.method().make(mesh, task));
        result.byte_count = result.references->refs.capacity() * sizeof(PrimRef);
        result.content_hash = hash_of(result.references->refs);
    });
    if (!made) return std::nullopt;
    const std::span<const PrimRef> refs = made->references->refs;
    Counts skipped = made->skipped;

    key += hex(made->content_hash);
    double build_ms = 0.0;
    std::shared_ptr<const StageResult> last;
    for (size_t i = 0; i <= recipe.transforms.size(); ++i) {
        key += " > " + (i == 0 ? recipe.builder : recipe.transforms[i - 1]).text();
        last = run_stage(key, cache, task, [&](StageResult& result) {
            result.structure =
                i == 0 ? recipe.builder.method().build(mesh, refs, task)
                       : recipe.transforms[i - 1].method().apply(mesh, refs, *last->structure, task);
            result.byte_count = result.structure->byte_count();
        });
        if (!last) return std::nullopt;
        build_ms += last->ms;
        add(skipped, last->skipped);
    }

    std::shared_ptr<const LevelTable> levels;
    if (with_levels) {
        const auto listed = run_stage(key + " > levels", cache, task, [&](StageResult& result) {
            result.levels = std::make_shared<LevelTable>(make_level_table(last->structure->list_nodes()));
            result.byte_count = result.levels->byte_count();
        });
        if (!listed) return std::nullopt;
        levels = listed->levels;
    }
    return Built{std::move(scene),  recipe,   made->references, *last->structure,
                 std::move(levels), made->ms, build_ms,         std::move(skipped)};
}

}  // namespace boxwood
