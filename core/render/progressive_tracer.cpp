#include "core/render/progressive_tracer.h"

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/assert.h"
#include "core/base/timer.h"
#include "core/render/film.h"
#include "core/render/trace_schedule.h"

namespace boxwood {

namespace {

/// A coarse picture is shown if the work has taken so long already, in milliseconds.
constexpr double kPatience = 30.0;

/// One picture to be traced: const for the workers, but for its task.
struct Job {
    Job(std::shared_ptr<const Scene> job_scene, const Box& bounds, Structure structure,
        const TraceSettings& settings)
        : scene(std::move(job_scene)),
          tracer(scene->mesh, bounds, std::move(structure), settings),
          passes(make_trace_passes(settings)),
          task(stop.get_token()) {
        for (const TracePass& pass : passes)
            if (!tiles.contains(pass.tile_size))
                tiles[pass.tile_size] = tiles_from_middle(settings.width, settings.height, pass.tile_size);
    }

    const TraceSettings& settings() const { return tracer.settings(); }
    const std::vector<TraceTile>& tiles_of(const TracePass& pass) const { return tiles.at(pass.tile_size); }

    std::shared_ptr<const Scene> scene;
    PixelTracer tracer;
    std::vector<TracePass> passes;
    std::map<int, std::vector<TraceTile>> tiles;  ///< by tile size
    std::stop_source stop;
    Task task;
};

/// What one worker keeps from tile to tile for its memory.
struct Workspace {
    PixelBatch batch;
    std::vector<uint8_t> rgba;  ///< of each pixel of the batch
};

}  // namespace

/// The tiles of a pass are handed out under the mutex and traced outside of it; the film is written by the
/// one worker that holds the pixel's tile, the picture under the mutex. A pass begins when the one before it
/// is whole, so samples are added in their order, and a coarse square never covers a finer one.
struct ProgressiveTracer::Impl {
    explicit Impl(int thread_count) {
        for (int i = 0; i < thread_count; ++i)
            workers.emplace_back([this](const std::stop_token& quit) { work(quit); });
    }

    void work(const std::stop_token& quit);
    bool has_tile() const;
    void trace_tile(const Job& traced, size_t traced_pass, size_t tile, Workspace& space);
    bool resolve_tile(const Job& traced, const TracePass& traced_pass, Workspace& space) const;
    void finish_pass(const Job& finished, std::unique_lock<std::mutex>& lock);
    bool has_patience_or_good(int shown_step) const;

    mutable std::mutex mutex;
    std::condition_variable_any work_waits;      ///< workers: for a tile
    mutable std::condition_variable idle_waits;  ///< callers: for busy == 0 or the picture's end
    std::shared_ptr<Job> job;                    ///< null before the first start
    size_t pass = 0;                             ///< index into job->passes
    size_t next_tile = 0, finished_tiles = 0;    ///< of the pass
    int busy = 0;                                ///< workers inside a tile
    bool published = false;                      ///< `picture` is of this job
    Image picture;
    Image scratch;  ///< the picture before the last one, to be drawn anew
    uint64_t version = 0;
    Film film;
    uint64_t traced_samples = 0;
    TraceState state;                             ///< running, converged, step, samples, counters, heat
    Timer timer;                                  ///< since the start
    std::shared_ptr<const Scene> measured_scene;  ///< whose box this is:
    Box bounds;
    std::vector<std::jthread> workers;  ///< last: they end before the rest goes
};

bool ProgressiveTracer::Impl::has_tile() const {
    return job != nullptr && state.running && pass < job->passes.size() &&
           next_tile < job->tiles_of(job->passes[pass]).size();
}

void ProgressiveTracer::Impl::work(const std::stop_token& quit) {
    Workspace space;
    std::unique_lock lock(mutex);
    while (work_waits.wait(lock, quit, [this] { return has_tile(); })) {
        if (quit.stop_requested()) return;
        const std::shared_ptr<Job> held = job;
        const size_t held_pass = pass, tile = next_tile++;
        ++busy;
        lock.unlock();
        trace_tile(*held, held_pass, tile, space);
        lock.lock();
        const bool last = ++finished_tiles == held->tiles_of(held->passes[held_pass]).size();
        if (last && !held->task.stopped()) finish_pass(*held, lock);
        --busy;
        idle_waits.notify_all();
    }
}

void ProgressiveTracer::Impl::trace_tile(const Job& traced, size_t traced_pass, size_t tile,
                                         Workspace& space) {
    const TracePass& now = traced.passes[traced_pass];
    const TraceSettings& settings = traced.settings();
    const bool counted = now.counting || is_heat(settings.shading);
    PixelBatch& batch = space.batch;
    list_pixels(now, traced.tiles_of(now)[tile], settings.width, settings.height, batch.pixels);
    if (!traced.tracer.cast(now.sample, batch, counted, traced.task)) return;
    if (!now.counting && !traced.tracer.shade(now.sample, batch, traced.task)) return;
    if (!now.counting) film.add(batch, now.sample);
    const bool drawn = resolve_tile(traced, now, space);
    Count sum;
    for (const Count& count : batch.counts) sum += count;

    const std::scoped_lock lock(mutex);
    state.counters += sum;
    state.counted_rays += counted ? batch.rays.size() : 0;
    if (now.counting) return;
    traced_samples += batch.pixels.size();
    state.ray_count += batch.ray_count();
    if (!drawn) return;
    for (size_t i = 0; i < batch.pixels.size(); ++i) {
        const int x = static_cast<int>(batch.pixels[i]) % settings.width;
        const int y = static_cast<int>(batch.pixels[i]) / settings.width;
        fill_square(picture, x, y, now.step, &space.rgba[4 * i]);
    }
    ++version;
}

/// The batch's colours, if the picture is already of this job. `published` and the scale change only between
/// passes, so they can be read here without the mutex.
bool ProgressiveTracer::Impl::resolve_tile(const Job& traced, const TracePass& traced_pass,
                                           Workspace& space) const {
    if (traced_pass.counting || !published) return false;
    space.rgba.resize(4 * space.batch.pixels.size());
    for (size_t i = 0; i < space.batch.pixels.size(); ++i)
        resolve_pixel(film, traced.settings(), state.heat.scale, space.batch.pixels[i],
                      traced_pass.sample + 1, &space.rgba[4 * i]);
    return true;
}

bool ProgressiveTracer::Impl::has_patience_or_good(int shown_step) const {
    return shown_step <= kGoodStep || timer.milliseconds() > kPatience;
}

/// Called with the lock, by the worker of the pass's last tile; nobody else has a tile. Draws the whole
/// picture where the first one is due or the heat scale has changed, without the lock, and goes on to the
/// next pass.
void ProgressiveTracer::Impl::finish_pass(const Job& finished, std::unique_lock<std::mutex>& lock) {
    const TracePass& done = finished.passes[pass];
    const TraceSettings& settings = finished.settings();
    if (!done.counting) {
        const uint32_t samples = done.sample + 1;
        HeatScale heat;
        lock.unlock();
        if (is_heat(settings.shading)) heat = make_heat_scale(film, settings, done.step, samples);
        const bool due = published ? heat.scale != state.heat.scale : has_patience_or_good(done.step);
        const bool drawn =
            due && resolve_image(film, settings, heat.scale, done.step, samples, scratch, finished.task);
        lock.lock();
        if (finished.task.stopped()) return;
        state.heat = heat;
        state.step = done.step;
        state.samples = done.step == 1 ? static_cast<int>(samples) : 0;
        if (drawn) {
            std::swap(picture, scratch);
            published = true;
            ++version;
        }
    }
    ++pass;
    next_tile = 0;
    finished_tiles = 0;
    if (pass == finished.passes.size()) {
        state.running = false;
        state.converged = true;
        state.ms = timer.milliseconds();
    }
    work_waits.notify_all();
}

ProgressiveTracer::ProgressiveTracer(int thread_count)
    : impl_(std::make_unique<Impl>(
          thread_count > 0 ? thread_count
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency())))) {}

ProgressiveTracer::~ProgressiveTracer() { stop(); }

void ProgressiveTracer::start(std::shared_ptr<const Scene> scene, Structure structure,
                              const TraceSettings& settings) {
    BOXWOOD_ASSERT(settings.width > 0 && settings.height > 0 && settings.ao_rays > 0);
    stop();
    Impl& impl = *impl_;
    if (impl.measured_scene != scene) {
        impl.bounds = scene->mesh.bounds();
        impl.measured_scene = scene;
    }
    const auto job = std::make_shared<Job>(std::move(scene), impl.bounds, std::move(structure), settings);
    const std::scoped_lock lock(impl.mutex);
    impl.job = job;
    impl.film.resize(settings);
    impl.pass = impl.next_tile = impl.finished_tiles = 0;
    impl.published = false;
    impl.traced_samples = 0;
    impl.state = TraceState{};
    impl.state.running = true;
    impl.state.sample_count = sample_count(settings);
    impl.timer = Timer();
    impl.work_waits.notify_all();
}

void ProgressiveTracer::stop() {
    Impl& impl = *impl_;
    std::unique_lock lock(impl.mutex);
    if (!impl.state.running) return;
    impl.job->stop.request_stop();
    impl.state.running = false;
    impl.state.ms = impl.timer.milliseconds();
    impl.idle_waits.wait(lock, [&] { return impl.busy == 0; });
}

bool ProgressiveTracer::wait(double milliseconds) const {
    std::unique_lock lock(impl_->mutex);
    // A clock counts in integers: a longer wait than a day, such as an infinite one, is made of days.
    constexpr double kDay = 24.0 * 3600.0 * 1000.0;
    const auto is_idle = [&] { return !impl_->state.running && impl_->busy == 0; };
    for (; milliseconds > kDay; milliseconds -= kDay) {
        if (impl_->idle_waits.wait_for(lock, std::chrono::hours(24), is_idle)) return true;
    }
    return impl_->idle_waits.wait_for(lock, std::chrono::duration<double, std::milli>(milliseconds), is_idle);
}

bool ProgressiveTracer::snapshot(Image& image, uint64_t& version) const {
    const std::scoped_lock lock(impl_->mutex);
    if (impl_->version == version) return false;
    version = impl_->version;
    image = impl_->picture;
    return true;
}

int ProgressiveTracer::snapshot_counts(std::vector<Count>& counts) const {
    const std::scoped_lock lock(impl_->mutex);
    const int step = impl_->state.step;
    const Film& film = impl_->film;
    if (step == 0 || film.first_counts.empty()) return 0;
    counts.resize(film.first_counts.size());
    // Other pixels may be written by the workers at this moment.
    const size_t width = static_cast<size_t>(film.width), height = static_cast<size_t>(film.height);
    const size_t stride = static_cast<size_t>(step);
    for (size_t y = 0; y < height; y += stride)
        for (size_t x = 0; x < width; x += stride) counts[y * width + x] = film.first_counts[y * width + x];
    return step;
}

TraceState ProgressiveTracer::state() const {
    const std::scoped_lock lock(impl_->mutex);
    TraceState state = impl_->state;
    if (impl_->job == nullptr) return state;
    if (state.running) state.ms = impl_->timer.milliseconds();
    const double all = static_cast<double>(impl_->film.first_hits.size()) * state.sample_count;
    state.progress = static_cast<double>(impl_->traced_samples) / all;
    if (state.ms > 0.0) state.rays_per_second = static_cast<double>(state.ray_count) / state.ms * 1000.0;
    return state;
}

std::optional<PixelValue> ProgressiveTracer::picked(int x, int y) const {
    const std::scoped_lock lock(impl_->mutex);
    const int step = impl_->state.step;
    const Film& film = impl_->film;
    if (step == 0 || x < 0 || y < 0 || x >= film.width || y >= film.height) return std::nullopt;
    const size_t pixel = static_cast<size_t>(y - y % step) * static_cast<size_t>(film.width) +
                         static_cast<size_t>(x - x % step);
    PixelValue value;
    value.hit = film.first_hits[pixel];
    if (!film.first_counts.empty()) value.count = film.first_counts[pixel];
    return value;
}

}  // namespace boxwood
