#include <array>
#include <cmath>

#include "core/scene/generate/kitchen_parts.h"
#include "core/scene/generate/kitchen_pieces.h"

namespace boxwood::kitchen {
namespace {

/// A turned leg or spindle from foot to head, of a radius of about `r`.
void add_spindle(MeshBuilder& b, const DVec3& foot, const DVec3& head, double r, int steps, int segments) {
    const double l = glm::length(head - foot);
    const ProfilePoint profile[] = {{0.7 * r, 0.0},       {0.8 * r, 0.12 * l}, {1.2 * r, 0.2 * l},
                                    {0.75 * r, 0.25 * l}, {1.0 * r, 0.45 * l}, {1.1 * r, 0.6 * l},
                                    {0.7 * r, 0.74 * l},  {1.25 * r, 0.8 * l}, {0.9 * r, 0.86 * l},
                                    {1.0 * r, l}};
    b.add_turned(foot, head - foot, smooth(profile, steps), segments);
}

}  // namespace

void add_chair(MeshBuilder& b) {
    constexpr double kSeat = 0.45;
    add_rounded_box(b, {-0.21, kSeat - 0.035, -0.21}, {0.21, kSeat, 0.21}, 0.016, 3);
    for (const double x : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0})
            add_spindle(b, {0.2 * x, 0.0, 0.2 * z}, {0.16 * x, kSeat - 0.03, 0.16 * z}, 0.02, 1, 12);
        b.add_tube({0.187 * x, 0.15, -0.187}, {0.187 * x, 0.15, 0.187}, 0.011, 0.011, 10);
        add_spindle(b, {0.18 * x, kSeat - 0.01, 0.18}, {0.19 * x, 0.93, 0.27}, 0.018, 1, 12);
    }
    b.add_tube({-0.18, 0.15, 0.0}, {0.18, 0.15, 0.0}, 0.011, 0.011, 10);
    for (int i = 0; i < 5; ++i) {
        const double x = -0.12 + 0.06 * i;
        add_spindle(b, {x, kSeat - 0.01, 0.185}, {1.08 * x, 0.86, 0.262}, 0.009, 1, 8);
    }
    b.add_surface(24, 8, [&](double u, double v) {  // the rail that the spindles end in, bent backwards
        const double angle = v < 1.0 ? 2.0 * kPi * v : 0.0, across = 2.0 * u - 1.0;
        const double end = u == 0.0 || u == 1.0 ? 0.0 : std::pow(1.0 - std::pow(across, 8.0), 0.25);
        const double bend = std::cos(0.5 * kPi * across);
        return DVec3(0.225 * across, 0.9 + 0.05 * end * std::sin(angle) + 0.03 * bend,
                     0.255 + 0.02 * bend + 0.014 * end * std::cos(angle));
    });
}

void add_table(MeshBuilder& b, Rng& rng) {
    constexpr double kX = 3.0, kZ = 2.55, kHalfX = 0.85, kHalfZ = 0.46, kY = 0.76;
    use_oak(b);
    add_rounded_box(b, {kX - kHalfX, kY - 0.035, kZ - kHalfZ}, {kX + kHalfX, kY, kZ + kHalfZ}, 0.015, 5);
    b.add_box({kX - kHalfX + 0.1, kY - 0.13, kZ - kHalfZ + 0.08},
              {kX + kHalfX - 0.1, kY - 0.035, kZ + kHalfZ - 0.08});
    for (const double x : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0})
            add_spindle(b, {kX + x * (kHalfX - 0.1), 0.012, kZ + z * (kHalfZ - 0.08)},
                        {kX + x * (kHalfX - 0.1), kY - 0.04, kZ + z * (kHalfZ - 0.08)}, 0.038, 3, 20);
    const auto chair_at = [&](double x, double z, double angle) {
        b.place(turned({.origin = {x, 0.012, z}}, {0, 1, 0}, angle));
        use_oak(b);
        add_chair(b);
        b.place({});
    };
    chair_at(kX - 0.4, kZ + 0.62, 0.06);
    chair_at(kX - 0.42, kZ - 0.60, kPi - 0.05);
    chair_at(kX + 0.42, kZ - 0.62, kPi + 0.04);
    use_china(b);
    for (const double x : {-0.42, 0.40}) {
        for (const double z : {-1.0, 1.0}) {
            add_plate(b, {kX + x, kY, kZ + 0.25 * z}, {0, 1, 0}, 0.13);
            add_cup(b, {kX + x + 0.19, kY, kZ + 0.27 * z}, 1.1 * z);
        }
    }
    b.use_object("blue bowl", {0.12f, 0.24f, 0.42f});
    add_bowl(b, {kX, kY, kZ}, 0.17);
    for (int i = 0; i < 7; ++i) {
        if (i % 3 == 0)
            b.use_object("green apples", {0.38f, 0.52f, 0.10f});
        else
            b.use_object("apples", {0.62f, 0.10f, 0.06f});
        const double angle = i == 6 ? 0.0 : kPi * i / 3.0, r = i == 6 ? 0.0 : 0.085;
        const double x = kX + r * std::cos(angle), z = kZ + r * std::sin(angle);
        add_apple(b, {x, kY + (i == 6 ? 0.1 : 0.045), z}, static_cast<double>(rng.next(0.036f, 0.042f)));
    }
    b.use_object("green glass", {0.10f, 0.26f, 0.12f});
    add_bottle(b, {kX - 0.22, kY, kZ - 0.1});
}

void add_rug(MeshBuilder& b) {
    // Woven: its height goes up and down with warp and weft; four stripes in two colours.
    constexpr double kX0 = 1.9, kX1 = 4.1, kZ0 = 1.75, kZ1 = 3.35;
    for (int stripe = 0; stripe < 6; ++stripe) {
        if (stripe % 2 == 0)
            b.use_object("red wool", {0.46f, 0.14f, 0.10f});
        else
            b.use_object("pale wool", {0.66f, 0.56f, 0.40f});
        b.add_surface(12, 40, [&](double u, double v) {
            const double x = kX0 + (kX1 - kX0) * (stripe + u) / 6.0, z = kZ0 + (kZ1 - kZ0) * v;
            const long i = std::lround(12.0 * u), k = std::lround(40.0 * v);
            return DVec3(x, 0.006 + 0.004 * static_cast<double>((i + k) % 2), z);
        });
    }
}

void add_dresser(MeshBuilder& b, Rng& rng) {
    // Along the left wall: local x towards the window, local z into the room.
    b.place({.origin = {0.01, 0.0, 3.5}, .x_axis = {0, 0, -1}, .y_axis = {0, 1, 0}, .z_axis = {1, 0, 0}});
    constexpr double kW = 1.7, kD = 0.42;
    b.use_object("dresser", {0.36f, 0.19f, 0.09f});
    b.add_box({0.03, 0.0, 0.0}, {kW - 0.03, 0.09, kD - 0.04});
    add_rounded_box(b, {0, 0.08, 0}, {kW, 0.86, kD}, 0.012, 3);
    add_rounded_box(b, {-0.03, 0.86, 0}, {kW + 0.03, 0.89, kD + 0.03}, 0.01, 3);
    b.add_box({0, 0.89, 0}, {kW, 1.95, 0.02});
    for (const double x : {0.0, kW - 0.025}) b.add_box({x, 0.89, 0.02}, {x + 0.025, 1.95, 0.2});
    for (const double y : {1.2, 1.55, 1.93}) b.add_box({0.025, y, 0.02}, {kW - 0.025, y + 0.02, 0.2});
    const Placement placement = b.placement();
    for (int i = 0; i < 3; ++i) {
        b.place(placement.moved({0.03 + 0.55 * i, 0.11, kD}));
        b.use_object("dresser", {});
        add_front(b, 0.54, 0.5);
        use_steel(b);
        add_knob(b, {0.47, 0.4, 0.022});
        b.place(placement.moved({0.03 + 0.55 * i, 0.63, kD}));
        b.use_object("dresser", {});
        add_front(b, 0.54, 0.21);
        use_steel(b);
        add_knob(b, {0.27, 0.105, 0.022});
    }
    b.place(placement);
    for (int row = 0; row < 3; ++row) {
        const double y = row == 0 ? 0.89 : row == 1 ? 1.22 : 1.57;
        for (int i = 0; i < 6; ++i) {
            if ((i + row) % 3 == 0)
                b.use_object("blue china", {0.20f, 0.32f, 0.50f});
            else
                use_china(b);
            const double r = static_cast<double>(rng.next(0.11f, 0.125f)), x = 0.18 + 0.268 * i;
            if (row == 0 && i % 2 == 1)
                add_jar(b, {x, y, 0.15}, 0.2);
            else
                add_plate(b, {x, y + 0.97 * r, 0.06}, glm::normalize(DVec3(0, 0.22, 1.0)), r);
            if (row > 0) add_cup(b, {x, y, 0.15}, static_cast<double>(rng.next(0.0f, 6.28f)));
        }
    }
    b.place({});
    // A door in the right wall.
    use_oak(b);
    b.place({.origin = {kWidth - 0.03, 0.0, 2.4},
             .x_axis = {0, 0, 1},
             .y_axis = {0, 1, 0},
             .z_axis = {-1, 0, 0}});
    add_front(b, 0.9, 2.05);
    use_steel(b);
    add_knob(b, {0.82, 1.02, 0.022});
    b.place({});
}

}  // namespace boxwood::kitchen
