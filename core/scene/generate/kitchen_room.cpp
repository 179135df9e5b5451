#include <array>
#include <cmath>

#include "core/scene/generate/kitchen_parts.h"
#include "core/scene/generate/kitchen_pieces.h"

namespace boxwood::kitchen {
namespace {

// The window in the back wall.
constexpr double kLeft = 3.55, kRight = 4.95, kSill = 1.16, kHead = 2.2, kReveal = 0.16;

/// One unit under the worktop, from x to x + width: carcass, plinth, and where it has fronts, one or two.
void add_unit(MeshBuilder& b, double x, double width, int fronts) {
    use_enamel(b);
    b.add_box({x, 0.0, 0.02}, {x + width, 0.1, kCupDepth - 0.06});
    b.add_box({x, 0.1, 0.02}, {x + width, kTop - 0.04, kCupDepth});
    for (int i = 0; i < fronts; ++i) {
        const double w = width / fronts;
        b.place({.origin = {x + w * i + 0.004, 0.12, kCupDepth}});
        use_enamel(b);
        add_front(b, w - 0.008, kTop - 0.18);
        use_steel(b);
        add_knob(b, {i == 0 ? w - 0.05 : 0.04, kTop - 0.26, 0.022});
        b.place({});
    }
}

/// A cupboard on the wall without its doors: back, sides, shelves.
void add_shell(MeshBuilder& b, double x0, double x1, double y0, double y1, double depth) {
    constexpr double kBoard = 0.018;
    use_enamel(b);
    b.add_box({x0, y0, 0.0}, {x1, y1, kBoard});
    b.add_box({x0, y0, kBoard}, {x0 + kBoard, y1, depth});
    b.add_box({x1 - kBoard, y0, kBoard}, {x1, y1, depth});
    for (const double u : {0.0, 0.36, 0.68, 1.0}) {
        const double y = y0 + u * (y1 - y0 - kBoard);
        b.add_box({x0 + kBoard, y, kBoard}, {x1 - kBoard, y + kBoard, depth - 0.004});
    }
}

}  // namespace

void add_room(MeshBuilder& b) {
    b.use_object("floor", {0.36f, 0.27f, 0.20f});
    b.add_quad({0, 0, 0}, {0, 0, kDepth}, {kWidth, 0, kDepth}, {kWidth, 0, 0});
    b.use_object("ceiling", {0.80f, 0.79f, 0.75f});
    b.add_quad({0, kHeight, 0}, {kWidth, kHeight, 0}, {kWidth, kHeight, kDepth}, {0, kHeight, kDepth});
    b.use_object("walls", {0.78f, 0.72f, 0.58f});
    b.add_quad({0, 0, 0}, {0, kHeight, 0}, {0, kHeight, kDepth}, {0, 0, kDepth});
    b.add_quad({kWidth, 0, 0}, {kWidth, 0, kDepth}, {kWidth, kHeight, kDepth}, {kWidth, kHeight, 0});
    b.add_quad({0, 0, kDepth}, {0, kHeight, kDepth}, {kWidth, kHeight, kDepth}, {kWidth, 0, kDepth});
    // The back wall about the window.
    b.add_quad({0, 0, 0}, {kLeft, 0, 0}, {kLeft, kHeight, 0}, {0, kHeight, 0});
    b.add_quad({kRight, 0, 0}, {kWidth, 0, 0}, {kWidth, kHeight, 0}, {kRight, kHeight, 0});
    b.add_quad({kLeft, 0, 0}, {kRight, 0, 0}, {kRight, kSill, 0}, {kLeft, kSill, 0});
    b.add_quad({kLeft, kHead, 0}, {kRight, kHead, 0}, {kRight, kHeight, 0}, {kLeft, kHeight, 0});
    b.use_object("skirting", {0.82f, 0.80f, 0.74f});
    constexpr glm::dvec2 kSkirting[] = {
        {0.0, 0.016}, {0.08, 0.016}, {0.09, 0.012}, {0.1, 0.012}, {0.11, 0.0}};
    b.place({.origin = {0, 0, kDepth}, .x_axis = {0, 0, -1}, .z_axis = {1, 0, 0}});
    b.add_moulding(kSkirting, 0.0, kDepth - 0.7);
    b.place({.origin = {kWidth, 0, 0.62}, .x_axis = {0, 0, 1}, .z_axis = {-1, 0, 0}});
    b.add_moulding(kSkirting, 0.0, kDepth - 0.62);
    b.place({});
    // Tiles over the worktop, with bevelled edges.
    constexpr double kTile = 0.1, kJoint = 0.003, kThick = 0.006;
    for (int row = 0; row < 2; ++row) {
        for (int i = 0; i < 48; ++i) {
            if ((i + row) % 4 == 0)
                b.use_object("blue tiles", {0.22f, 0.36f, 0.46f});
            else
                b.use_object("white tiles", {0.80f, 0.80f, 0.76f});
            const double x0 = 0.98 + kTile * i, y0 = kTop + kTile * row;
            b.add_prism(std::array<glm::dvec2, 4>{{{x0, y0},
                                                   {x0 + kTile - kJoint, y0},
                                                   {x0 + kTile - kJoint, y0 + kTile - kJoint},
                                                   {x0, y0 + kTile - kJoint}}},
                        0.0, kThick);
        }
    }
}

void add_window(MeshBuilder& b, Rng& rng) {
    b.use_object("window frame", {0.84f, 0.83f, 0.80f});
    b.add_box({kLeft - 0.08, kSill - 0.03, -kReveal}, {kRight + 0.08, kSill, 0.1});
    for (const double x : {kLeft, 0.5 * (kLeft + kRight), kRight})
        b.add_box({x - 0.03, kSill, -kReveal}, {x + 0.03, kHead, -0.1});
    for (const double y : {kSill + 0.03, 0.64 * kHead + 0.36 * kSill, kHead - 0.03})
        b.add_box({kLeft, y - 0.025, -kReveal + 0.01}, {kRight, y + 0.025, -0.11});
    b.use_object("sky", {0.50f, 0.68f, 0.86f});
    b.add_quad({kLeft, kSill, -kReveal}, {kRight, kSill, -kReveal}, {kRight, kHead, -kReveal},
               {kLeft, kHead, -kReveal});
    b.use_object("walls", {});
    b.add_quad({kLeft, kSill, 0}, {kLeft, kHead, 0}, {kLeft, kHead, -kReveal}, {kLeft, kSill, -kReveal});
    b.add_quad({kRight, kSill, 0}, {kRight, kHead, 0}, {kRight, kHead, -kReveal}, {kRight, kSill, -kReveal});
    b.add_quad({kLeft, kHead, 0}, {kRight, kHead, 0}, {kRight, kHead, -kReveal}, {kLeft, kHead, -kReveal});
    use_steel(b);
    b.add_tube({kLeft - 0.25, kHead + 0.12, 0.09}, {kRight + 0.25, kHead + 0.12, 0.09}, 0.012, 0.012, 12,
               true);
    b.use_object("curtains", {0.62f, 0.22f, 0.16f});
    for (const double side : {-1.0, 1.0}) {
        const double phase = static_cast<double>(rng.next(0.0f, 6.0f));
        const double hem = side < 0.0 ? kLeft - 0.2 : kRight + 0.2;
        b.add_surface(64, 16, [&](double u, double v) {
            const double gather = 1.0 - 0.45 * std::exp(-40.0 * (v - 0.62) * (v - 0.62));
            const double fold = 0.030 * std::sin(2.0 * kPi * 6.5 * u + phase + 0.5 * std::sin(4.0 * v));
            return DVec3(hem - side * 0.46 * u * gather, kHead + 0.12 - v * 1.02,
                         0.09 + fold * (0.35 + 0.65 * v) * (0.5 + 0.5 * gather));
        });
    }
}

void add_cupboards(MeshBuilder& b) {
    add_unit(b, 0.98, 0.78, 2);
    add_unit(b, 3.36, 0.80, 2);
    add_unit(b, 4.16, 0.80, 2);
    add_unit(b, 4.96, 0.82, 2);
    // The unit of the drawers: its front is open, the drawers move.
    use_enamel(b);
    b.add_box({1.76, 0.0, 0.02}, {2.56, 0.1, kCupDepth - 0.06});
    b.add_box({1.76, 0.1, 0.02}, {1.78, kTop - 0.04, kCupDepth});
    b.add_box({2.54, 0.1, 0.02}, {2.56, kTop - 0.04, kCupDepth});
    b.add_box({1.78, 0.1, 0.02}, {2.54, kTop - 0.04, 0.04});
    b.use_object("worktop", {0.30f, 0.17f, 0.09f});
    add_rounded_box(b, {0.96, kTop - 0.04, 0.0}, {2.56, kTop, kCupDepth + 0.06}, 0.01, 2);
    add_rounded_box(b, {3.36, kTop - 0.04, 0.0}, {3.62, kTop, kCupDepth + 0.06}, 0.01, 2);
    add_rounded_box(b, {4.40, kTop - 0.04, 0.0}, {5.80, kTop, kCupDepth + 0.06}, 0.01, 2);
    add_rounded_box(b, {3.62, kTop - 0.04, 0.0}, {4.40, kTop, 0.1}, 0.01, 2);
    add_rounded_box(b, {3.62, kTop - 0.04, 0.52}, {4.40, kTop, kCupDepth + 0.06}, 0.01, 2);
    // On the wall, left of the hood: the left half has shut doors, the right half one that moves.
    add_shell(b, 0.98, 1.76, 1.48, 2.3, 0.32);
    add_shell(b, 1.76, 2.40, 1.48, 2.3, 0.32);
    for (int i = 0; i < 2; ++i) {
        b.place({.origin = {0.984 + 0.39 * i, 1.484, 0.32}});
        use_enamel(b);
        add_front(b, 0.382, 0.812);
        use_steel(b);
        add_knob(b, {i == 0 ? 0.34 : 0.04, 0.06, 0.022});
        b.place({});
    }
    for (int shelf = 0; shelf < 3; ++shelf) {
        const double y = 1.48 + (shelf == 0 ? 0.0 : shelf == 1 ? 0.36 : 0.68) * (0.82 - 0.018) + 0.018;
        for (int i = 0; i < 4; ++i) {
            use_china(b);
            const DVec3 at(1.86 + 0.145 * i, y, 0.16);
            if (shelf < 2) add_cup(b, at, 0.7 + 0.5 * i);
            if (shelf == 2 && i % 2 == 0) add_bowl(b, at + DVec3(0.06, 0, 0), 0.1);
        }
    }
    b.use_object("cornice", {0.40f, 0.50f, 0.45f});
    constexpr glm::dvec2 kCornice[] = {{2.3, 0.32},  {2.31, 0.335}, {2.33, 0.34},
                                       {2.35, 0.37}, {2.37, 0.38},  {2.37, 0.0}};
    b.add_moulding(kCornice, 0.96, 2.42);
    b.add_quad({2.42, 2.3, 0.0}, {2.42, 2.37, 0.0}, {2.42, 2.37, 0.38}, {2.42, 2.3, 0.32});
}

void add_fridge(MeshBuilder& b) {
    b.use_object("fridge", {0.74f, 0.77f, 0.74f});
    add_rounded_box(b, {0.1, 0.06, 0.03}, {0.86, 1.86, 0.62}, 0.05, 4);
    for (const auto& [y0, y1] : {std::pair(0.1, 1.18), std::pair(1.21, 1.84)}) {
        b.use_object("fridge", {});
        add_rounded_box(b, {0.11, y0, 0.6}, {0.85, y1, 0.68}, 0.035, 4);
        use_steel(b);
        const double middle = y0 < 1.0 ? y1 - 0.25 : y0 + 0.2;
        add_pipe(
            b,
            [&](double u) {
                const double a = 2.0 * u - 1.0;
                return DVec3(0.78, middle + 0.13 * a, 0.675 + 0.045 * (1.0 - std::pow(a, 6.0)));
            },
            {1, 0, 0}, 0.011, 28, 10);
    }
    b.use_object("apples", {0.62f, 0.10f, 0.06f});
    for (int i = 0; i < 5; ++i) {
        const double x = 0.24 + 0.09 * i, y = 1.42 + 0.05 * ((7 * i) % 4);
        b.add_turned({x, y, 0.68}, {0, 0, 1},
                     std::array<ProfilePoint, 4>{{{0.02, 0.0}, {0.02, 0.006}, {0.014, 0.012}, {0.0, 0.013}}},
                     14);
    }
}

}  // namespace boxwood::kitchen
