#include "core/scene/generate/atrium_decor.h"

#include <algorithm>
#include <cmath>

namespace boxwood {

void use_marble(MeshBuilder& b) { b.use_object("marble", {0.80f, 0.76f, 0.68f}); }
void use_bronze(MeshBuilder& b) { b.use_object("bronze", {0.42f, 0.28f, 0.10f}); }

void add_curtain(MeshBuilder& b, double bay, double top, Rng& rng) {
    const double phase = static_cast<double>(rng.next(0.0f, 6.0f)),
                 folds = static_cast<double>(rng.next(5.0f, 7.0f));
    const double bottom = static_cast<double>(rng.next(0.7f, 1.0f));
    b.add_surface(28, 8, [&](double u, double v) {
        const double depth = (0.05 + 0.09 * v) * std::sin(2.0 * kPi * folds * u + phase + 0.6 * v);
        const double narrow = 1.0 - 0.10 * std::sin(kPi * v);
        return DVec3(0.5 * bay + (u - 0.5) * 2.1 * narrow,
                     top + v * (bottom - top) + 0.05 * std::sin(9.0 * u + phase) * v, depth);
    });
    use_bronze(b);
    b.add_tube({0.35, top + 0.03, 0}, {bay - 0.35, top + 0.03, 0}, 0.03, 0.03, 8, true);
}

void add_vase(MeshBuilder& b, const DVec3& foot, Rng& rng) {
    constexpr ProfilePoint kProfile[] = {{0.0, 0.0},   {0.2, 0.0},   {0.22, 0.05}, {0.13, 0.12}, {0.26, 0.32},
                                         {0.33, 0.52}, {0.31, 0.7},  {0.2, 0.84},  {0.17, 0.9},  {0.25, 0.98},
                                         {0.23, 0.99}, {0.14, 0.88}, {0.0, 0.86}};
    b.use_object("terracotta", {0.55f, 0.22f, 0.11f});
    b.add_turned(foot, {0, 1, 0}, kProfile, 18);
    b.use_object("leaves", {0.10f, 0.28f, 0.06f});
    for (int i = 0; i < 26; ++i) {
        const double angle = static_cast<double>(rng.next(0.0f, 6.2832f)),
                     reach = static_cast<double>(rng.next(0.3f, 0.75f));
        const double height = static_cast<double>(rng.next(0.25f, 1.0f));
        const DVec3 out(std::cos(angle), 0, std::sin(angle)), side(-0.055 * out.z, 0, 0.055 * out.x);
        b.add_surface(1, 3, [&](double u, double v) {
            const DVec3 spine = foot + DVec3(0, 0.86 + height * v * (1.6 - v * v), 0) + out * (reach * v * v);
            return spine + side * ((2.0 * u - 1.0) * std::sin(kPi * std::min(0.25 + 0.75 * v, 1.0)));
        });
    }
}

void add_lantern(MeshBuilder& b, const DVec3& hook, double drop) {
    constexpr ProfilePoint kCage[] = {{0.0, -0.42}, {0.06, -0.4}, {0.13, -0.3}, {0.15, -0.27}};
    constexpr ProfilePoint kHat[] = {{0.16, 0.0}, {0.19, 0.02}, {0.08, 0.14}, {0.03, 0.2}, {0.0, 0.24}};
    const DVec3 at = hook - DVec3(0, drop, 0);
    use_bronze(b);
    b.add_tube(hook, at + DVec3(0, 0.2, 0), 0.012, 0.012, 5);
    b.add_turned(at, {0, 1, 0}, kCage, 12);
    b.add_turned(at, {0, 1, 0}, kHat, 12);
    for (int i = 0; i < 6; ++i) {
        const double angle = kPi * i / 3.0;
        const DVec3 p = at + DVec3(0.145 * std::cos(angle), 0, 0.145 * std::sin(angle));
        b.add_tube(p - DVec3(0, 0.28, 0), p, 0.012, 0.012, 4);
    }
    b.use_object("lamp glass", {1.0f, 0.82f, 0.45f});
    b.add_sphere(at - DVec3(0, 0.14, 0), 0.105, 10, 6);
}

void add_fountain(MeshBuilder& b, const DVec3& foot) {
    constexpr ProfilePoint kBasin[] = {{1.75, 0.0}, {1.75, 0.14}, {1.5, 0.14},  {1.42, 0.5},
                                       {1.5, 0.62}, {1.3, 0.62},  {1.25, 0.42}, {0.0, 0.42}};
    constexpr ProfilePoint kStem[] = {{0.34, 0.42}, {0.2, 0.55},  {0.13, 0.9},  {0.19, 1.2},  {0.72, 1.42},
                                      {0.76, 1.5},  {0.66, 1.47}, {0.12, 1.34}, {0.08, 1.75}, {0.28, 1.9},
                                      {0.30, 1.95}, {0.08, 1.9},  {0.05, 2.1},  {0.0, 2.14}};
    use_marble(b);
    b.add_turned(foot, {0, 1, 0}, kBasin, 8);
    b.add_turned(foot, {0, 1, 0}, kStem, 24);
    b.use_object("water", {0.16f, 0.38f, 0.42f});
    b.add_tube(foot + DVec3(0, 0.52, 0), foot + DVec3(0, 0.521, 0), 1.28, 0.0, 8);
    b.add_tube(foot + DVec3(0, 1.46, 0), foot + DVec3(0, 1.461, 0), 0.64, 0.0, 24);
}

}  // namespace boxwood
