#include "app/viewer/build_job.h"

#include <algorithm>
#include <new>
#include <utility>

namespace boxwood {
namespace {

/// Triangles of one reference that are in several leaves.
uint64_t count_shared(std::span<const PrimRef> refs, const BoxValues& values) {
    uint64_t count = 0;
    for (size_t i = 0; i < refs.size(); ++i) {
        const uint32_t prim = refs[i].prim;
        const bool has_others =
            (i > 0 && refs[i - 1].prim == prim) || (i + 1 < refs.size() && refs[i + 1].prim == prim);
        count += !has_others && prim < values.prim_leaves.size() && values.prim_leaves[prim] > 1 ? 1 : 0;
    }
    return count;
}

SideResult finished(Built built) {
    SideResult result;
    result.values = std::make_shared<BoxValues>(make_box_values(built.levels->list));
    result.shared_count = count_shared(built.references->refs, *result.values);
    result.tree = std::make_shared<TreeStats>(tree_stats(*built.levels));
    result.built = std::make_shared<Built>(std::move(built));
    return result;
}

}  // namespace

BuildJob::BuildJob(std::shared_ptr<StageCache> cache) : cache_(std::move(cache)) {
    thread_ = std::jthread([this](const std::stop_token& quit) { work(quit); });
}

BuildJob::~BuildJob() {
    cancel();
    thread_.request_stop();
    wake_.notify_all();
}

void BuildJob::request(BuildRequest request) {
    {
        const std::scoped_lock lock(mutex_);
        stop_.request_stop();
        waiting_ = std::move(request);
        finished_.reset();
        since_ = Timer();
    }
    wake_.notify_all();
}

void BuildJob::cancel() {
    const std::scoped_lock lock(mutex_);
    stop_.request_stop();
    waiting_.reset();
    finished_.reset();
}

std::optional<BuildResult> BuildJob::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(finished_, std::nullopt);
}

BuildProgress BuildJob::progress() const {
    const std::scoped_lock lock(mutex_);
    BuildProgress progress;
    progress.running = task_ || waiting_ || finished_;
    if (!progress.running) return progress;
    progress.sentence = task_ && !task_->stopped() ? sentence_ : "starting";
    progress.ms = since_.milliseconds();
    const uint64_t done = task_ ? task_->done.load() : 0, total = task_ ? task_->total.load() : 0;
    if (total > 0) progress.share = static_cast<double>(std::min(done, total)) / static_cast<double>(total);
    return progress;
}

void BuildJob::wait() const {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return !task_ && !waiting_; });
}

void BuildJob::say(const std::string& sentence) {
    const std::scoped_lock lock(mutex_);
    sentence_ = sentence;
}

void BuildJob::work(const std::stop_token& quit) {
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, quit, [this] { return waiting_.has_value(); })) {
        const BuildRequest request = *std::exchange(waiting_, std::nullopt);
        stop_ = std::stop_source();
        const auto task = std::make_shared<Task>(stop_.get_token());
        task_ = task;
        lock.unlock();
        BuildResult result = run(request, *task);
        lock.lock();
        task_.reset();
        if (!task->stopped()) {
            result.ms = since_.milliseconds();
            finished_ = std::move(result);
        }
        idle_.notify_all();
    }
}

void BuildJob::open(const BuildRequest& request, Task& task) {
    if (scene_ && scene_spec_ == request.scene && !request.reload) return;
    say("opening " + request.scene);
    std::shared_ptr<const Scene> scene = open_scene(request.scene, task);
    if (task.stopped()) return;
    scene_ = std::move(scene);
    scene_spec_ = request.scene;
    kept_.clear();
}

BuildResult BuildJob::run(const BuildRequest& request, Task& task) {
    BuildResult result;
    result.request = request;
    try {
        open(request, task);
    } catch (const Error& error) {
        result.error = error.what();
        result.exit_code = error.exit_code();
        return result;
    } catch (const std::bad_alloc&) {
        result.error = "not enough memory for " + request.scene;
        result.exit_code = ExitCode::BadInput;
        return result;
    }
    result.scene = scene_;
    if (!request.structure) return result;
    std::erase_if(kept_, [&](const auto& entry) {
        return std::ranges::find(request.recipes, entry.first) == request.recipes.end();
    });
    for (size_t side = 0; side < result.sides.size() && !task.stopped(); ++side) {
        if (side != 0 && request.recipes[side].empty()) continue;
        ShowMeanwhile show;
        if (request.stand_in) {
            show = [&](const SideResult& stand_in) {
                BuildResult meanwhile = result;
                meanwhile.sides[side] = stand_in;
                meanwhile.is_stand_in = true;
                show_meanwhile(std::move(meanwhile), task);
            };
        }
        result.sides[side] = build(request.recipes[side], task, show);
    }
    return result;
}

void BuildJob::show_meanwhile(BuildResult result, const Task& task) {
    const std::scoped_lock lock(mutex_);
    if (task.stopped()) return;
    result.ms = since_.milliseconds();
    finished_ = std::move(result);
}

SideResult BuildJob::build(const std::string& recipe, Task& task, const ShowMeanwhile& show) {
    if (const auto found = kept_.find(recipe); found != kept_.end()) return found->second;
    SideResult result = make(recipe, task, show);
    if (result.built) kept_[recipe] = result;
    return result;
}

SideResult BuildJob::make(const std::string& text, Task& task, const ShowMeanwhile& show) {
    SideResult result;
    try {
        const Recipe recipe = parse_recipe(text);
        const std::string warning = long_build_warning(recipe, scene_->mesh.triangle_count());
        const std::string sentence =
            "building " + print(recipe) + (warning.empty() ? "" : ", which " + warning);
        say(sentence);
        const std::optional<Recipe> other = show ? stand_in(recipe) : std::nullopt;
        if (other && !find_recipe(recipe, scene_, *cache_, /*with_levels=*/true)) {
            std::optional<Built> built = run_recipe(*other, scene_, *cache_, task, /*with_levels=*/true);
            if (!built) return result;
            show(finished(std::move(*built)));
            say(sentence + "; until then " + other->builder.text() + " is shown");
        }
        std::optional<Built> built = run_recipe(recipe, scene_, *cache_, task, /*with_levels=*/true);
        if (!built) return result;
        result = finished(std::move(*built));
    } catch (const Error& error) {
        result.error = error.what();
        result.exit_code = error.exit_code();
    } catch (const std::bad_alloc&) {
        result.error = "not enough memory for " + text + " on " + scene_spec_;
        result.exit_code = ExitCode::BadInput;
    }
    return result;
}

}  // namespace boxwood
