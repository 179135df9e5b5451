#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/viewer/box_values.h"
#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/catalog/pipeline.h"
#include "core/measure/tree_stats.h"

namespace boxwood {

/// What the window wants to show.
struct BuildRequest {
    std::string scene;
    std::array<std::string, 2> recipes{};  ///< by Side; B's empty: there is none
    bool structure = true;  ///< false: nothing shows references or structure, so only the scene is opened
    bool reload = false;    ///< open the scene again even if it is the one that is open
    bool stand_in = false;  ///< answer with a builder's stand-in first

    /// Whether the same is wanted in the end.
    bool operator==(const BuildRequest& other) const {
        return scene == other.scene && recipes == other.recipes && structure == other.structure &&
               reload == other.reload;
    }
};

/// What a recipe made.
struct SideResult {
    std::shared_ptr<const Built> built;       ///< with levels; null: not asked for, or see error
    std::shared_ptr<const BoxValues> values;  ///< of built->levels
    std::shared_ptr<const TreeStats> tree;    ///< of built->levels
    uint64_t shared_count = 0;  ///< triangles in several leaves though the references stage made one
    std::string error;          ///< a sentence; empty: all is well
    ExitCode exit_code = ExitCode::Done;  ///< of the error
};

/// A whole answer, or why there is none.
struct BuildResult {
    BuildRequest request;
    std::shared_ptr<const Scene> scene;  ///< null: it could not be opened, see error
    std::array<SideResult, 2> sides;     ///< by Side; the same recipe twice: the same structure
    bool is_stand_in = false;            ///< a side shows a stand-in; the whole answer follows
    std::string error;                   ///< of the scene
    ExitCode exit_code = ExitCode::Done;
    double ms = 0.0;  ///< from the request to here
};

/// What the job does now.
struct BuildProgress {
    bool running = false;  ///< also while an answer waits to be taken
    std::string sentence;  ///< "building evh(t=14) > bvh-sweep-sah"
    double share = -1.0;   ///< of the stage that runs, 0 to 1; below 0: not known
    double ms = 0.0;       ///< since the request
};

/// Opens scenes and runs recipes, A's before B's, in a thread of its own. Of several requests only the newest
/// is answered: one that runs is stopped, one that waits is dropped. Called from one thread.
class BuildJob {
public:
    explicit BuildJob(std::shared_ptr<StageCache> cache);
    ~BuildJob();
    BuildJob(const BuildJob&) = delete;
    BuildJob& operator=(const BuildJob&) = delete;

    void request(BuildRequest request);
    /// Stops what runs and drops what waits; there is no result.
    void cancel();
    /// The answer to the newest request, once; before it, where one was wanted, that with a stand-in.
    std::optional<BuildResult> take();
    BuildProgress progress() const;
    /// Returns when nothing runs or waits.
    void wait() const;

    const StageCache& cache() const { return *cache_; }

private:
    using ShowMeanwhile = std::function<void(const SideResult&)>;

    void work(const std::stop_token& quit);
    BuildResult run(const BuildRequest& request, Task& task);
    void open(const BuildRequest& request, Task& task);
    SideResult build(const std::string& recipe, Task& task, const ShowMeanwhile& show);
    SideResult make(const std::string& text, Task& task, const ShowMeanwhile& show);
    void show_meanwhile(BuildResult result, const Task& task);
    void say(const std::string& sentence);

    std::shared_ptr<StageCache> cache_;
    std::shared_ptr<const Scene> scene_;      ///< the last one that was opened; only the thread touches it
    std::string scene_spec_;                  ///< as it was asked for
    std::map<std::string, SideResult> kept_;  ///< of the last answers over that scene, by recipe as asked for

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    mutable std::condition_variable_any idle_;
    std::optional<BuildRequest> waiting_;
    std::stop_source stop_;       ///< of what runs
    std::shared_ptr<Task> task_;  ///< null: nothing runs
    std::string sentence_;
    Timer since_;
    std::optional<BuildResult> finished_;
    std::jthread thread_;  ///< last: it is joined first
};

}  // namespace boxwood
