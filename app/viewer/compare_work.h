#pragma once

#include <array>
#include <memory>
#include <optional>

#include "app/viewer/background.h"
#include "bench/picture_check.h"
#include "core/catalog/pipeline.h"
#include "core/render/heat_compare.h"

namespace boxwood {

/// What two sides are compared by beyond what each has for itself: their heat pictures on one scale with the
/// signed difference, and their rays per second, taken in turns. One thread.
class CompareWork {
public:
    /// Makes the pictures anew in the background where counts or settings differ from the last ones; what was
    /// there stays until they are whole. Counts that are not known or not of one size change nothing.
    void update_heat(const std::array<std::shared_ptr<const HeatCounts>, 2>& counts,
                     const HeatCompareSettings& settings);
    /// Null: there is none.
    const std::shared_ptr<const HeatComparison>& heat() const { return heat_; }
    uint64_t heat_version() const { return heat_version_; }  ///< of heat(), from 1 on
    void clear_heat();

    /// Times the primary rays of a picture through both structures in the background, once for each request.
    struct RaceKey {
        std::array<std::shared_ptr<const Built>, 2> built;
        Mode mode = Mode::Exact;
        Camera camera;
        int width = 0, height = 0;
        bool operator==(const RaceKey&) const = default;
    };
    /// Nothing: what runs is stopped, and the last result is forgotten. A race begins when `may_start`.
    void update_race(const std::optional<RaceKey>& wanted, bool may_start);
    /// By side; 0: not timed (yet).
    std::array<double, 2> rays_per_second() const;
    bool busy() const { return is_race_due_ || race_.progress().running || heat_work_.progress().running; }
    void wait() const {
        heat_work_.wait();
        race_.wait();
    }

private:
    std::array<std::shared_ptr<const HeatCounts>, 2> counts_;  ///< that heat_ or what comes next is of
    HeatCompareSettings settings_;
    Background<HeatComparison> heat_work_;
    std::shared_ptr<const HeatComparison> heat_;
    uint64_t heat_version_ = 0;

    using Timings = std::array<bench::RayTiming, 2>;
    std::optional<RaceKey> race_of_;
    bool is_race_due_ = false;
    std::optional<Timings> timings_;  ///< of race_of_
    Background<Timings> race_;
};

}  // namespace boxwood
