#include <array>
#include <cmath>

#include "core/scene/generate/kitchen_parts.h"
#include "core/scene/generate/kitchen_pieces.h"

namespace boxwood::kitchen {
namespace {

/// Four rings of a gas burner.
void add_burner(MeshBuilder& b, const DVec3& at) {
    b.use_object("cast iron", {0.05f, 0.05f, 0.055f});
    for (const double r : {0.035, 0.06, 0.085}) {
        add_pipe(
            b,
            [&](double u) {
                const double angle = 2.0 * kPi * u;
                return at + DVec3(r * std::cos(angle), 0.012, r * std::sin(angle));
            },
            {0, 1, 0}, 0.006, 24, 6);
    }
    for (int i = 0; i < 4; ++i) {
        const double angle = 0.5 * kPi * (i + 0.5);
        const DVec3 out(std::cos(angle), 0, std::sin(angle));
        b.add_beam(at + 0.03 * out + DVec3(0, 0.02, 0), at + 0.115 * out + DVec3(0, 0.02, 0), 0.008, 0.014);
    }
}

}  // namespace

void add_stove(MeshBuilder& b) {
    constexpr double kLeft = 2.57, kRight = 3.35, kFront = 0.62;
    b.use_object("stove", {0.20f, 0.21f, 0.23f});
    add_rounded_box(b, {kLeft, 0.02, 0.02}, {kRight, kTop, kFront}, 0.012, 3);
    b.use_object("oven glass", {0.03f, 0.035f, 0.04f});
    add_rounded_box(b, {kLeft + 0.08, 0.22, kFront - 0.01}, {kRight - 0.08, 0.62, kFront + 0.015}, 0.012, 3);
    use_steel(b);
    b.add_box({kLeft, kTop, 0.02}, {kRight, kTop + 0.006, kFront});
    add_pipe(
        b,
        [&](double u) {
            const double a = 2.0 * u - 1.0;
            return DVec3(0.5 * (kLeft + kRight) + 0.3 * a, 0.69, kFront + 0.05 * (1.0 - std::pow(a, 8.0)));
        },
        {0, 1, 0}, 0.011, 20, 8);
    for (int i = 0; i < 5; ++i) {
        const ProfilePoint knob[] = {
            {0.024, 0.0}, {0.024, 0.012}, {0.018, 0.03}, {0.014, 0.034}, {0.0, 0.035}};
        b.add_turned({kLeft + 0.13 + 0.13 * i, 0.81, kFront}, {0, 0, 1}, smooth(knob, 2), 16);
    }
    for (const double x : {kLeft + 0.2, kRight - 0.2})
        for (const double z : {0.18, 0.44}) add_burner(b, {x, kTop + 0.006, z});
    b.use_object("copper", {0.66f, 0.32f, 0.16f});
    add_pot(b, {kLeft + 0.2, kTop + 0.033, 0.44}, 0.12, 0.13);
    add_pot(b, {kRight - 0.2, kTop + 0.033, 0.18}, 0.1, 0.17);
    b.use_object("kettle", {0.60f, 0.10f, 0.08f});
    add_kettle(b, {kRight - 0.2, kTop + 0.033, 0.44});
    // Hood: a curved skirt that ends in a shaft.
    use_steel(b);
    constexpr double kMiddle = 0.5 * (kLeft + kRight);
    constexpr double kCorner[4][2] = {{-1, 0}, {1, 0}, {1, 1}, {-1, 1}};
    b.add_surface(4, 14, [&](double u, double v) {
        const auto& c = kCorner[std::lround(4.0 * u) % 4];
        const double w = v < 0.15 ? 1.0 : std::pow((1.0 - v) / 0.85, 2.2);
        return DVec3(kMiddle + c[0] * (0.13 + 0.25 * w), 1.56 + 0.55 * v, 0.01 + c[1] * (0.22 + 0.26 * w));
    });
    b.add_box({kMiddle - 0.13, 2.11, 0.01}, {kMiddle + 0.13, kHeight, 0.23});
}

void add_sink(MeshBuilder& b) {
    constexpr double kX0 = 3.62, kX1 = 4.40, kZ0 = 0.1, kZ1 = 0.52, kFloor = 0.74;
    constexpr double kMiddle = 0.5 * (kX0 + kX1);
    b.use_object("sink", {0.72f, 0.74f, 0.74f});
    b.add_surface(64, 12, [&](double u, double v) {  // a rounded tub, rim to drain
        const double angle = u < 1.0 ? 2.0 * kPi * u : 0.0;
        const double power = 0.28 + 0.3 * v * v;
        const double c = std::cos(angle), s = std::sin(angle);
        const double x = std::copysign(std::pow(std::abs(c), power), c);
        const double z = std::copysign(std::pow(std::abs(s), power), s);
        const double size = v < 0.5 ? 1.0 - 0.16 * v : 0.92 * (1.0 - std::pow(2.0 * v - 1.0, 1.5)) + 0.04;
        const double y = v < 0.5 ? kTop - 2.0 * v * (kTop - kFloor - 0.02) : kFloor + 0.02 * (2.0 - 2.0 * v);
        return DVec3(kMiddle + 0.5 * (kX1 - kX0) * x * size, y,
                     0.5 * (kZ0 + kZ1) + 0.5 * (kZ1 - kZ0) * z * size);
    });
    use_steel(b);
    const ProfilePoint foot[] = {{0.03, 0.0}, {0.03, 0.012}, {0.02, 0.022}, {0.017, 0.05}, {0.014, 0.06}};
    b.add_turned({kMiddle, kTop, 0.06}, {0, 1, 0}, smooth(foot, 2), 16);
    add_pipe(
        b,
        [&](double u) {  // up, then a half circle forwards
            if (u < 0.5) return DVec3(kMiddle, kTop + 0.05 + 0.34 * u, 0.06);
            const double angle = 2.0 * kPi * (u - 0.5) * 0.95;
            return DVec3(kMiddle, kTop + 0.22 + 0.09 * std::sin(angle), 0.15 - 0.09 * std::cos(angle));
        },
        {1, 0, 0}, 0.012, 32, 10);
    for (const double side : {-1.0, 1.0}) {
        const DVec3 at(kMiddle + 0.12 * side, kTop, 0.06);
        b.add_turned(at, {0, 1, 0}, smooth(foot, 2), 14);
        for (int i = 0; i < 2; ++i) {
            const double angle = 0.5 * kPi * i + 0.4;
            const DVec3 out(0.045 * std::cos(angle), 0, 0.045 * std::sin(angle));
            b.add_tube(at + DVec3(0, 0.07, 0) - out, at + DVec3(0, 0.07, 0) + out, 0.007, 0.007, 10, true);
        }
        b.add_tube(at + DVec3(0, 0.06, 0), at + DVec3(0, 0.08, 0), 0.012, 0.012, 14, true);
    }
    // Plates in a rack beside it.
    for (int i = 0; i < 8; ++i) {
        use_china(b);
        const double x = 4.5 + 0.04 * i;
        add_plate(b, {x, kTop + 0.125, 0.3}, glm::normalize(DVec3(1.0, 0.25, 0.0)), 0.12);
        use_steel(b);
        for (const double z : {0.24, 0.36})
            b.add_tube({x - 0.02, kTop, z}, {x - 0.02, kTop + 0.09, z}, 0.003, 0.003, 8, true);
    }
    for (const double z : {0.24, 0.36})
        b.add_tube({4.46, kTop + 0.01, z}, {4.84, kTop + 0.01, z}, 0.004, 0.004, 8, true);
}

void add_small_things(MeshBuilder& b, Rng& rng) {
    // A board with jars on the right wall, and bottles and jars on the worktop.
    use_oak(b);
    for (const double y : {1.45, 1.8}) {
        add_rounded_box(b, {5.78, y, 0.5}, {5.995, y + 0.025, 1.7}, 0.008, 2);
        for (int i = 0; i < 9; ++i) {
            b.use_object(i % 3 == 0   ? "spice"
                         : i % 3 == 1 ? "preserves"
                                      : "flour",
                         i % 3 == 0   ? Vec3(0.62f, 0.36f, 0.10f)
                         : i % 3 == 1 ? Vec3(0.45f, 0.08f, 0.12f)
                                      : Vec3(0.80f, 0.76f, 0.66f));
            add_jar(b, {5.89, y + 0.025, 0.6 + 0.125 * i}, static_cast<double>(rng.next(0.12f, 0.22f)));
        }
        use_oak(b);
    }
    b.use_object("green glass", {0.10f, 0.26f, 0.12f});
    for (int i = 0; i < 4; ++i) add_bottle(b, {5.2 + 0.11 * i, kTop, 0.14 + 0.05 * (i % 2)});
    b.use_object("flour", {});
    add_bowl(b, {5.35, kTop, 0.38}, 0.14);
    // Utensils on a rail between cupboard and hood tiles.
    use_steel(b);
    b.add_tube({0.99, 1.34, 0.05}, {2.5, 1.34, 0.05}, 0.007, 0.007, 12, true);
    for (int i = 0; i < 7; ++i) {
        const double x = 1.9 + 0.085 * i, length = static_cast<double>(rng.next(0.16f, 0.2f));
        b.add_tube({x, 1.335, 0.06}, {x, 1.335 - length, 0.06}, 0.005, 0.004, 10, true);
        const ProfilePoint ladle[] = {{0.0, 0.0}, {0.018, 0.004}, {0.03, 0.02}, {0.028, 0.021}, {0.0, 0.006}};
        b.add_turned({x, 1.335 - length, 0.06}, {0, 0, 1}, smooth(ladle, 2), 12);
    }
    // A plant on the window sill.
    b.use_object("terracotta", {0.58f, 0.25f, 0.13f});
    const ProfilePoint pot[] = {{0.0, 0.0},    {0.05, 0.0},   {0.066, 0.1}, {0.076, 0.1},
                                {0.078, 0.13}, {0.066, 0.13}, {0.06, 0.11}, {0.0, 0.11}};
    for (const double x : {3.75, 4.72}) b.add_turned({x, 1.16, 0.02}, {0, 1, 0}, smooth(pot, 2), 24);
    b.use_object("leaves", {0.14f, 0.36f, 0.10f});
    for (int i = 0; i < 60; ++i) {
        const double angle = static_cast<double>(rng.next(0.0f, 6.2832f));
        const double reach = static_cast<double>(rng.next(0.05f, 0.13f));
        const double height = static_cast<double>(rng.next(0.08f, 0.26f));
        const DVec3 out(std::cos(angle), 0, 0.6 * std::sin(angle)), side(-0.016 * out.z, 0, 0.016 * out.x);
        const DVec3 foot(i % 2 == 0 ? 3.75 : 4.72, 1.27, 0.02);
        b.add_surface(2, 6, [&](double u, double v) {
            const double w = std::sin(kPi * (0.08 + 0.88 * v));
            const DVec3 spine = foot + DVec3(0, height * v * (1.5 - 0.5 * v), 0) + out * (reach * v * v);
            return spine + side * (2.0 * u - 1.0) * w + DVec3(0, 0.006 * std::abs(2.0 * u - 1.0) * w, 0);
        });
    }
}

}  // namespace boxwood::kitchen
