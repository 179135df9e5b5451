#include "app/viewer/compare_work.h"

namespace boxwood {
namespace {

constexpr double kRaceSeconds = 1.0;

}  // namespace

void CompareWork::update_heat(const std::array<std::shared_ptr<const HeatCounts>, 2>& counts,
                              const HeatCompareSettings& settings) {
    if (std::optional<HeatComparison> heat = heat_work_.take()) {
        heat_ = std::make_shared<const HeatComparison>(*std::move(heat));
        ++heat_version_;
    }
    if (!counts[0] || !counts[1]) return;
    if (counts[0]->width != counts[1]->width || counts[0]->height != counts[1]->height) return;
    if (counts_ == counts && settings_ == settings) return;
    counts_ = counts;
    settings_ = settings;
    heat_work_.start([counts, settings](Task&) { return compare_heat(*counts[0], *counts[1], settings); });
}

void CompareWork::clear_heat() {
    if (counts_[0]) heat_work_.cancel();
    heat_.reset();
    counts_ = {};
}

void CompareWork::update_race(const std::optional<RaceKey>& wanted, bool may_start) {
    if (const std::optional<Timings> timings = race_.take()) timings_ = timings;
    if (race_of_ != wanted) {
        race_.cancel();
        race_of_ = wanted;
        timings_.reset();
        is_race_due_ = wanted.has_value();
    }
    if (!is_race_due_ || !may_start) return;
    is_race_due_ = false;
    race_.start([key = *race_of_](Task& task) {
        const bench::PictureCheckSettings settings{
            .camera = key.camera, .width = key.width, .height = key.height, .seconds = kRaceSeconds};
        return bench::time_in_turns(
            key.built[0]->scene->mesh,
            {{{&key.built[0]->structure, key.mode}, {&key.built[1]->structure, key.mode}}}, settings, task);
    });
}

std::array<double, 2> CompareWork::rays_per_second() const {
    if (!timings_) return {};
    const double a = (*timings_)[0].rays_per_second, b = (*timings_)[1].rays_per_second;
    // One structure twice: both have timed the same.
    const bool is_one = print(race_of_->built[0]->recipe) == print(race_of_->built[1]->recipe);
    if (is_one) return {0.5 * (a + b), 0.5 * (a + b)};
    return {a, b};
}

}  // namespace boxwood
