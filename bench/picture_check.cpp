#include "bench/picture_check.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "bench/screened_oracle.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/timer.h"

namespace boxwood::bench {
namespace {

constexpr size_t kRayBatch = 256;     // rays between two looks at the task
constexpr uint64_t kRayBlock = 2048;  // rays timed at once

std::vector<Ray> rays_through(std::span<const uint32_t> pixels, const PictureCheckSettings& settings) {
    const CameraFrame frame =
        camera_frame(settings.camera, static_cast<double>(settings.width) / settings.height);
    const auto width = static_cast<uint32_t>(settings.width);
    std::vector<Ray> rays;
    rays.reserve(pixels.size());
    for (const uint32_t pixel : pixels) {
        rays.push_back(
            camera_ray(frame, pixel % width + 0.5, pixel / width + 0.5, settings.width, settings.height));
    }
    return rays;
}

void cast(const Mesh& mesh, const Structure& structure, std::span<const Ray> rays, std::span<Hit> hits,
          Mode mode, const Task& task, std::atomic<uint64_t>* done = nullptr) {
    parallel_for(rays.size(), kRayBatch, [&](size_t begin, size_t end) {
        structure.closest_hits(mesh, rays.subspan(begin, end - begin), hits.subspan(begin, end - begin), mode,
                               task);
        if (done != nullptr) *done += end - begin;
    });
}

enum class Verdict : uint8_t { Right, WrongHit, WrongPrim, WrongT };

Verdict judge(const std::optional<oracle::ExactHit>& expected, const Hit& found, Mode mode) {
    if (found.is_hit() != expected.has_value()) return Verdict::WrongHit;
    if (!expected) return Verdict::Right;
    if (found.prim != expected->prim) return Verdict::WrongPrim;
    if (mode == Mode::Fast) return Verdict::Right;
    const float t = oracle::round_to_float(expected->t);
    return std::bit_cast<uint32_t>(found.t) == std::bit_cast<uint32_t>(t) ? Verdict::Right : Verdict::WrongT;
}

}  // namespace

std::vector<uint32_t> even_sample(uint64_t total, uint64_t count) {
    if (count >= total) {
        std::vector<uint32_t> all(total);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    // One at random of each of `count` parts of about equal length: no pattern of the picture's rows.
    Rng rng(1);
    std::vector<uint32_t> sample;
    for (uint64_t i = 0; i < count; ++i) {
        const uint64_t begin = i * total / count, end = (i + 1) * total / count;
        sample.push_back(static_cast<uint32_t>(begin + rng.next_index(end - begin)));
    }
    return sample;
}

std::vector<uint32_t> spread_order(uint64_t total) {
    // Steps of about the golden ratio, which leaves no large gap; coprime, so that each number comes once.
    constexpr double kGolden = 1.6180339887498949;
    auto step = std::max<uint64_t>(static_cast<uint64_t>(static_cast<double>(total) / kGolden), 1);
    while (std::gcd(step, total) > 1) ++step;
    std::vector<uint32_t> order;
    uint64_t at = 0;
    for (uint64_t i = 0; i < total; ++i, at = (at + step) % total) order.push_back(static_cast<uint32_t>(at));
    return order;
}

std::array<RayTiming, 2> time_in_turns(const Mesh& mesh, const std::array<Contender, 2>& contenders,
                                       const PictureCheckSettings& settings, Task& task) {
    const uint64_t ray_count = static_cast<uint64_t>(settings.width) * static_cast<uint64_t>(settings.height);
    const std::vector<uint32_t> blocks = spread_order((ray_count + kRayBlock - 1) / kRayBlock);
    std::vector<Hit> hits(kRayBlock);
    std::array<double, 2> ms{};
    std::array<RayTiming, 2> timings;
    const Timer timer;
    for (size_t i = 0; timer.milliseconds() < 1000.0 * settings.seconds && !task.stopped(); ++i) {
        const uint64_t first = blocks[i % blocks.size()] * kRayBlock;
        std::vector<uint32_t> pixels(std::min(kRayBlock, ray_count - first));
        std::iota(pixels.begin(), pixels.end(), static_cast<uint32_t>(first));
        const std::vector<Ray> rays = rays_through(pixels, settings);
        // The second one finds what it needs in the caches: each is the first in every other block.
        for (const size_t c : {i % 2, 1 - i % 2}) {
            const Timer block_timer;
            cast(mesh, *contenders[c].structure, rays, std::span(hits).first(rays.size()), contenders[c].mode,
                 task);
            ms[c] += block_timer.milliseconds();
            timings[c].rays += rays.size();
        }
    }
    for (size_t c = 0; c < ms.size(); ++c) {
        if (ms[c] > 0.0) timings[c].rays_per_second = 1000.0 * static_cast<double>(timings[c].rays) / ms[c];
    }
    return timings;
}

PictureCheck check_picture(const Mesh& mesh, const Structure& structure, const PictureCheckSettings& settings,
                           Task& task) {
    const Timer timer;
    PictureCheck check;
    check.width = settings.width;
    check.height = settings.height;
    check.rays = static_cast<uint64_t>(settings.width) * static_cast<uint64_t>(settings.height);
    const std::vector<uint32_t> pixels = even_sample(check.rays, settings.sample_count);
    check.checked = pixels.size();
    task.done = 0;
    task.total = 3 * pixels.size();  // cast in both modes, judged
    const std::vector<Ray> rays = rays_through(pixels, settings);
    std::array<std::vector<Hit>, 2> hits{std::vector<Hit>(rays.size()), std::vector<Hit>(rays.size())};
    for (const Mode mode : {Mode::Exact, Mode::Fast})
        cast(mesh, structure, rays, hits[static_cast<size_t>(mode)], mode, task, &task.done);
    if (settings.seconds > 0.0) {
        const std::array<RayTiming, 2> timings =
            time_in_turns(mesh, {{{&structure, Mode::Exact}, {&structure, Mode::Fast}}}, settings, task);
        for (size_t m = 0; m < timings.size(); ++m) {
            check.modes[m].timed_rays = timings[m].rays;
            check.modes[m].rays_per_second = timings[m].rays_per_second;
        }
    }

    const ScreenedOracle oracle(mesh);
    std::array<std::vector<Verdict>, 2> verdicts{std::vector<Verdict>(rays.size()),
                                                 std::vector<Verdict>(rays.size())};
    parallel_for(rays.size(), 8, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !task.stopped(); ++i) {
            const std::optional<oracle::ExactHit> expected = oracle.closest_hit(rays[i]);
            for (const Mode mode : {Mode::Exact, Mode::Fast}) {
                const auto m = static_cast<size_t>(mode);
                verdicts[m][i] = judge(expected, hits[m][i], mode);
            }
            ++task.done;
        }
    });
    for (size_t m = 0; m < verdicts.size(); ++m) {
        ModeCheck& mode = check.modes[m];
        for (size_t i = 0; i < rays.size(); ++i) {
            const Verdict verdict = verdicts[m][i];
            if (verdict == Verdict::Right) continue;
            mode.wrong_hits += verdict == Verdict::WrongHit ? 1 : 0;
            mode.wrong_prims += verdict == Verdict::WrongPrim ? 1 : 0;
            mode.wrong_t += verdict == Verdict::WrongT ? 1 : 0;
            mode.wrong_pixels.push_back(pixels[i]);
        }
    }
    check.ms = timer.milliseconds();
    return check;
}

}  // namespace boxwood::bench
