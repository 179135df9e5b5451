#include <array>
#include <cmath>

#include "core/scene/generate/kitchen_parts.h"
#include "core/scene/generate/kitchen_pieces.h"

namespace boxwood::kitchen {
namespace {

/// 0 at the beginning of the loop, 1 in its middle, smooth.
double there_and_back(double phase) { return 0.5 - 0.5 * std::cos(2.0 * kPi * phase); }

void add_door(MeshBuilder& b, double phase) {
    const double angle = 1.9 * there_and_back(phase);
    b.place(turned({.origin = {2.398, 1.484, 0.32}}, {0, 1, 0}, angle).moved({-0.634, 0.0, 0.0}));
    b.use_object("moving door", {0.46f, 0.58f, 0.52f});
    add_front(b, 0.632, 0.812);
    b.use_object("moving brass", {0.62f, 0.46f, 0.18f});
    add_knob(b, {0.05, 0.06, 0.022});
}

/// Three drawers that open one after the other, with knives and forks in them.
void add_drawers(MeshBuilder& b, double phase) {
    constexpr double kWide = 0.75, kHigh = 0.24;
    for (int i = 0; i < 3; ++i) {
        const double shifted = phase + 0.12 * i;
        const double out = 0.36 * there_and_back(shifted - std::floor(shifted));
        b.place({.origin = {1.785, 0.115 + 0.255 * i, kCupDepth + out}});
        b.use_object("moving drawers", {0.46f, 0.58f, 0.52f});
        add_front(b, kWide, kHigh);
        b.add_box({0.02, 0.02, -0.46}, {0.035, 0.18, 0.0});
        b.add_box({kWide - 0.035, 0.02, -0.46}, {kWide - 0.02, 0.18, 0.0});
        b.add_box({0.035, 0.02, -0.46}, {kWide - 0.035, 0.035, 0.0});
        b.add_box({0.035, 0.035, -0.46}, {kWide - 0.035, 0.18, -0.445});
        b.use_object("moving brass", {});
        add_knob(b, {0.2, 0.5 * kHigh, 0.022});
        add_knob(b, {kWide - 0.2, 0.5 * kHigh, 0.022});
        b.use_object("moving cutlery", {0.60f, 0.61f, 0.63f});
        for (int k = 0; k < 12; ++k) {
            const double x = 0.07 + 0.054 * k;
            const ProfilePoint knife[] = {
                {0.0, 0.0}, {0.009, 0.02}, {0.007, 0.1}, {0.011, 0.16}, {0.0, 0.22}};
            b.add_turned({x, 0.048, -0.05 - 0.1 * (k % 2)}, {0, 0, -1}, smooth(knife, 2), 7);
        }
    }
}

void add_moving_chair(MeshBuilder& b, double phase) {
    const double out = there_and_back(phase);
    b.place(turned({.origin = {3.42 + 0.45 * out, 0.012, 3.16 + 0.36 * out}}, {0, 1, 0}, 0.9 * out));
    b.use_object("moving chair", {0.52f, 0.31f, 0.14f});
    add_chair(b);
}

/// Under the ceiling: three turns in a loop.
void add_fan(MeshBuilder& b, double phase) {
    constexpr int kBlades = 4;
    b.use_object("fan rod", {0.30f, 0.22f, 0.12f});
    b.place({});
    b.add_tube({4.35, kHeight, 1.75}, {4.35, kHeight - 0.24, 1.75}, 0.016, 0.016, 16);
    const Placement hub = turned({.origin = {4.35, kHeight - 0.3, 1.75}}, {0, 1, 0}, 6.0 * kPi * phase);
    b.place(hub);
    b.use_object("moving fan", {0.40f, 0.24f, 0.11f});
    const ProfilePoint body[] = {{0.0, -0.06}, {0.05, -0.055}, {0.085, -0.02}, {0.09, 0.02},
                                 {0.06, 0.05}, {0.02, 0.06},   {0.0, 0.062}};
    b.add_turned({0, 0, 0}, {0, 1, 0}, smooth(body, 3), 32);
    for (int i = 0; i < kBlades; ++i) {
        b.place(turned(hub, {0, 1, 0}, 2.0 * kPi * i / kBlades));
        b.add_surface(24, 8, [&](double u, double v) {
            const double chord = 0.055 + 0.035 * std::sin(kPi * (0.1 + 0.8 * u));
            const double across = (v - 0.5) * 2.0 * chord, twist = 0.32 - 0.16 * u;
            return DVec3(0.08 + 0.5 * u, across * std::sin(twist) - 0.012 * (2.0 * v - 1.0) * (2.0 * v - 1.0),
                         across * std::cos(twist));
        });
    }
}

/// A stand mixer: its whisk goes round ten times in a loop.
void add_mixer(MeshBuilder& b, double phase) {
    const DVec3 foot(1.36, kTop, 0.3);
    b.place({});
    b.use_object("mixer", {0.72f, 0.68f, 0.52f});
    add_rounded_box(b, foot + DVec3(-0.11, 0.0, -0.16), foot + DVec3(0.11, 0.035, 0.2), 0.016, 3);
    add_rounded_box(b, foot + DVec3(-0.055, 0.02, -0.15), foot + DVec3(0.055, 0.27, -0.05), 0.03, 4);
    add_rounded_box(b, foot + DVec3(-0.07, 0.24, -0.16), foot + DVec3(0.07, 0.37, 0.17), 0.055, 6);
    use_steel(b);
    add_bowl(b, foot + DVec3(0.0, 0.035, 0.08), 0.12);
    b.place(turned({.origin = foot + DVec3(0.0, 0.06, 0.08)}, {0, 1, 0}, 20.0 * kPi * phase));
    b.use_object("moving whisk", {0.66f, 0.67f, 0.70f});
    b.add_tube({0, 0.19, 0}, {0, 0.1, 0}, 0.009, 0.009, 14, true);
    for (int i = 0; i < 6; ++i) {
        const double angle = kPi * i / 6.0;
        const DVec3 out(std::cos(angle), 0, std::sin(angle));
        add_pipe(
            b,
            [&](double u) {
                const double a = 2.0 * kPi * (u - 0.25);
                return DVec3(0, 0.07 + 0.07 * std::sin(a), 0) + 0.045 * std::cos(a) * out;
            },
            {-out.z, 0.0, out.x}, 0.0022, 24, 5);
    }
}

/// A striped ball that rolls to and fro without slipping.
void add_ball(MeshBuilder& b, double phase) {
    constexpr double kRadius = 0.15, kWay = 1.9;
    constexpr int kSlices = 12, kRings = 20;
    const double way = kWay * there_and_back(phase);
    b.place(turned({.origin = {1.35 + way, kRadius, 3.72}}, {0, 0, 1}, -way / kRadius));
    for (int slice = 0; slice < kSlices; ++slice) {
        if (slice % 2 == 0)
            b.use_object("moving ball", {0.80f, 0.62f, 0.08f});
        else
            b.use_object("moving ball stripes", {0.10f, 0.28f, 0.56f});
        b.add_surface(4, kRings, [&](double u, double v) {
            const bool is_pole = v == 0.0 || v == 1.0;
            const double angle = 2.0 * kPi * (slice + u) / kSlices, r = is_pole ? 0.0 : std::sin(kPi * v);
            return kRadius * DVec3(r * std::cos(angle), r * std::sin(angle), std::cos(kPi * v));
        });
    }
}

/// A wooden spoon, thrown across the kitchen and back.
void add_spoon(MeshBuilder& b, double phase) {
    const bool is_back = phase >= 0.5;
    const double u = 2.0 * (is_back ? phase - 0.5 : phase), way = is_back ? 1.0 - u : u;
    const DVec3 from(1.45, 1.25, 1.5), to(4.75, 1.25, 1.15);
    const DVec3 at = from + way * (to - from) + DVec3(0.0, 3.2 * u * (1.0 - u), 0.0);
    b.place(turned(turned({.origin = at}, {0, 1, 0}, 0.3), {0, 0, 1}, 4.0 * kPi * (phase < 0.5 ? -u : u)));
    b.use_object("moving spoon", {0.70f, 0.48f, 0.24f});
    const ProfilePoint handle[] = {{0.0, -0.2}, {0.008, -0.195}, {0.009, 0.0}, {0.007, 0.1}, {0.008, 0.13}};
    b.add_turned({0, 0, 0}, {1, 0, 0}, smooth(handle, 4), 16);
    b.add_surface(24, 14, [&](double s, double v) {
        const bool is_pole = v == 0.0 || v == 1.0;
        const double angle = s < 1.0 ? 2.0 * kPi * s : 0.0, r = is_pole ? 0.0 : std::sin(kPi * v);
        return DVec3(0.17 - 0.05 * std::cos(kPi * v), 0.013 * r * std::sin(angle),
                     0.034 * r * std::cos(angle));
    });
}

/// The lamp over the table, which swings.
void add_lamp(MeshBuilder& b, double phase) {
    b.place(turned({.origin = {3.0, kHeight, 2.55}}, {0, 0, 1}, 0.09 * std::sin(4.0 * kPi * phase)));
    b.use_object("moving lamp cord", {0.08f, 0.08f, 0.08f});
    b.add_tube({0, -0.002, 0}, {0, -0.75, 0}, 0.005, 0.005, 10);
    b.use_object("moving lamp", {0.70f, 0.30f, 0.10f});
    const ProfilePoint shade[] = {{0.02, -0.72}, {0.035, -0.76}, {0.08, -0.80},
                                  {0.19, -0.90}, {0.235, -0.98}, {0.24, -1.0},
                                  {0.23, -0.98}, {0.18, -0.905}, {0.06, -0.81}};
    b.add_turned({0, 0, 0}, {0, 1, 0}, smooth(shade, 2), 36);
    b.use_object("moving bulb", {1.0f, 0.92f, 0.68f});
    b.add_sphere({0, -0.9, 0}, 0.045, 20, 12);
}

/// A clock on the right wall, with a pendulum.
void add_clock(MeshBuilder& b, double phase) {
    const Placement face{.origin = {kWidth - 0.01, 1.86, 2.05}, .x_axis = {0, 0, 1}, .z_axis = {-1, 0, 0}};
    b.place(face);
    use_oak(b);
    const ProfilePoint rim[] = {{0.15, 0.0}, {0.15, 0.03}, {0.135, 0.045}, {0.12, 0.035}, {0.118, 0.02}};
    b.add_turned({0, 0, 0}, {0, 0, 1}, smooth(rim, 2), 32);
    b.add_box({-0.06, -0.5, 0.0}, {0.06, -0.14, 0.02});
    use_china(b);
    b.add_tube({0, 0, 0.015}, {0, 0, 0.02}, 0.12, 0.12, 48, true);
    b.use_object("clock hands", {0.05f, 0.05f, 0.06f});
    b.add_beam({0, 0, 0.025}, {0.05, 0.035, 0.025}, 0.004, 0.01, {0, 0, 1});
    b.add_beam({0, 0, 0.028}, {-0.02, 0.1, 0.028}, 0.003, 0.007, {0, 0, 1});
    b.place(turned(face.moved({0, -0.1, 0.03}), {0, 0, 1}, 0.14 * std::sin(8.0 * kPi * phase)));
    b.use_object("moving pendulum", {0.72f, 0.56f, 0.22f});
    b.add_tube({0, 0, 0}, {0, -0.3, 0}, 0.004, 0.004, 10, true);
    const ProfilePoint bob[] = {{0.0, -0.008}, {0.035, -0.004}, {0.04, 0.0}, {0.035, 0.004}, {0.0, 0.008}};
    b.add_turned({0, -0.31, 0}, {0, 0, 1}, smooth(bob, 3), 28);
}

}  // namespace

void add_moving_things(MeshBuilder& b, double phase) {
    add_door(b, phase);
    add_drawers(b, phase);
    add_moving_chair(b, phase);
    add_fan(b, phase);
    add_mixer(b, phase);
    add_ball(b, phase);
    add_spoon(b, phase);
    add_lamp(b, phase);
    add_clock(b, phase);
    b.place({});
}

}  // namespace boxwood::kitchen
