#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/rng.h"
#include "core/scene/generate/built_in.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood {
namespace {

// The hall, in metres: three storeys of gratings and girders, tanks on the ground, pipes everywhere.
constexpr double kLength = 72.0, kHeight = 27.0, kDepth = 36.0;
constexpr double kStorey = 8.0, kSpan = 6.0;
constexpr size_t kTriangles = 1'667'578;  ///< Ernst and Greiner 2007, figure 3: "Power plant (part)"

struct Service {
    const char* name;
    Vec3 color;
};
constexpr Service kServices[] = {{"steam", {0.62f, 0.63f, 0.64f}},      {"water", {0.12f, 0.32f, 0.52f}},
                                 {"gas", {0.72f, 0.58f, 0.10f}},        {"oil", {0.36f, 0.20f, 0.10f}},
                                 {"fire water", {0.58f, 0.09f, 0.07f}}, {"air", {0.36f, 0.52f, 0.56f}}};

double draw(Rng& rng, double lower, double upper) {
    return static_cast<double>(rng.next(static_cast<float>(lower), static_cast<float>(upper)));
}

DVec3 unit(int axis, double sign) {
    DVec3 v(0.0);
    v[axis] = sign;
    return v;
}

/// A quarter of a torus from `from`, which it leaves along `before`, turning into `after`.
void add_bend(MeshBuilder& b, const DVec3& from, const DVec3& before, const DVec3& after, double bend,
              double radius, int around) {
    const DVec3 center = from + bend * after, normal = glm::cross(before, after);
    b.add_surface(8, around, [&](double u, double v) {
        const double turn = 0.5 * kPi * u, angle = v < 1.0 ? 2.0 * kPi * v : 0.0;
        const DVec3 out = -std::cos(turn) * after + std::sin(turn) * before;
        return center + (bend + radius * std::cos(angle)) * out + radius * std::sin(angle) * normal;
    });
}

/// Two discs with bolts' width between them, about the pipe.
void add_flange(MeshBuilder& b, const DVec3& at, const DVec3& axis, double radius, int around) {
    const double r = 1.55 * radius, w = 0.3 * radius;
    const ProfilePoint profile[] = {{radius, -w},         {r, -w},      {r, -0.1 * w}, {0.96 * r, -0.05 * w},
                                    {0.96 * r, 0.05 * w}, {r, 0.1 * w}, {r, w},        {radius, w}};
    b.add_turned(at, axis, profile, around);
}

/// A handwheel valve on top of a pipe.
void add_valve(MeshBuilder& b, const DVec3& at, const DVec3& axis, double radius) {
    const DVec3 up = std::abs(axis.y) > 0.5 ? DVec3(0, 0, 1) : DVec3(0, 1, 0);
    constexpr int kAround = 14;
    const double r = radius;
    const ProfilePoint body[] = {
        {r, -2.0 * r}, {1.5 * r, -1.2 * r}, {1.8 * r, 0.0}, {1.5 * r, 1.2 * r}, {r, 2.0 * r}};
    b.add_turned(at, axis, body, kAround);
    const ProfilePoint stem[] = {{1.1 * r, r}, {0.5 * r, 2.2 * r}, {0.2 * r, 2.4 * r}, {0.2 * r, 4.0 * r}};
    b.add_turned(at, up, stem, kAround);
    const DVec3 x = axis, y = glm::cross(up, axis), wheel = at + 3.8 * r * up;
    b.add_surface(20, 6, [&](double u, double v) {
        const double a = u < 1.0 ? 2.0 * kPi * u : 0.0, c = v < 1.0 ? 2.0 * kPi * v : 0.0;
        const DVec3 out = std::cos(a) * x + std::sin(a) * y;
        return wheel + (1.4 * r + 0.16 * r * std::cos(c)) * out + 0.16 * r * std::sin(c) * up;
    });
    for (const DVec3& spoke : {x, y})
        b.add_tube(wheel - 1.4 * r * spoke, wheel + 1.4 * r * spoke, 0.1 * r, 0.1 * r, 6);
}

/// A straight run with a flange every few metres, perhaps a valve.
void add_run(MeshBuilder& b, Rng& rng, const DVec3& from, const DVec3& to, double radius, int around) {
    const double length = glm::length(to - from);
    if (!(length > 0.0)) return;
    const DVec3 axis = (to - from) / length;
    b.add_tube(from, to, radius, radius, around);
    const int flanges = static_cast<int>(length / 4.0);
    for (int i = 0; i < flanges; ++i)
        add_flange(b, from + axis * (length * (i + 0.5) / flanges), axis, radius, around);
    const double chance = draw(rng, 0.0, 1.0), place = draw(rng, 0.2, 0.8);
    if (chance < 0.3 && length > 8.0 * radius) add_valve(b, from + axis * (length * place), axis, radius);
}

/// A pipe that goes its way through the hall, along the axes.
void add_pipe(MeshBuilder& b, Rng& rng) {
    const Service& service = kServices[rng.next_index(std::size(kServices))];
    b.use_object(service.name, service.color);
    const double size = draw(rng, 0.0, 1.0);
    const double radius = 0.025 + 0.3 * size * size * size, bend = 3.0 * radius;
    const int around = 10 + static_cast<int>(std::lround(10.0 * size));
    const double x = draw(rng, 1.0, kLength - 1.0), y = draw(rng, 0.5, kHeight - 3.0),
                 z = draw(rng, 1.0, kDepth - 1.0);
    DVec3 at(x, y, z);
    int axis = static_cast<int>(rng.next_index(3));
    const auto runs = static_cast<int>(4 + rng.next_index(7));
    DVec3 direction = unit(axis, 1.0);
    for (int i = 0; i < runs; ++i) {
        const DVec3 size_of_hall(kLength, kHeight - 1.5, kDepth);
        const double way = draw(rng, 2.0 * bend, axis == 0 ? 16.0 : 7.0);
        double end = at[axis] + direction[axis] * way;
        end = std::clamp(end, 0.6 + bend, size_of_hall[axis] - 0.6 - bend);
        const bool is_forward = (end - at[axis]) * direction[axis] > bend;
        DVec3 to = at;
        if (is_forward) to[axis] = end;
        add_run(b, rng, at, to, radius, around);
        const int next_axis = static_cast<int>((axis + 1 + static_cast<int>(rng.next_index(2))) % 3);
        const double middle = 0.5 * size_of_hall[next_axis];
        const double chance = draw(rng, 0.0, 1.0);
        double sign = (to[next_axis] < middle) == (chance < 0.75) ? 1.0 : -1.0;
        const double turned = to[next_axis] + 3.0 * bend * sign;
        if (turned < 0.6 || turned > size_of_hall[next_axis] - 0.6) sign = -sign;  // it would leave the hall
        const DVec3 next = unit(next_axis, sign);
        if (i + 1 < runs) add_bend(b, to, direction, next, bend, radius, around);
        at = to + bend * (direction + next);
        axis = next_axis;
        direction = next;
    }
}

/// Columns and girders of rolled steel: a web and two flanges each.
void add_girder(MeshBuilder& b, const DVec3& from, const DVec3& to, const DVec3& up) {
    const DVec3 top = 0.18 * up;
    b.add_beam(from, to, 0.02, 0.36, up);
    b.add_beam(from + top, to + top, 0.3, 0.03, up);
    b.add_beam(from - top, to - top, 0.3, 0.03, up);
}

void add_rail(MeshBuilder& b, const DVec3& from, const DVec3& to) {
    b.use_object("railing", {0.70f, 0.60f, 0.12f});
    for (const double y : {0.55, 1.1})
        b.add_tube(from + DVec3(0, y, 0), to + DVec3(0, y, 0), 0.022, 0.022, 8);
    const int posts = static_cast<int>(glm::length(to - from) / 1.2);
    for (int i = 0; i <= posts; ++i) {
        const DVec3 foot = from + (to - from) * (static_cast<double>(i) / posts);
        b.add_tube(foot, foot + DVec3(0, 1.1, 0), 0.022, 0.022, 8);
    }
}

void add_hall(MeshBuilder& b) {
    b.use_object("concrete", {0.42f, 0.41f, 0.39f});
    b.add_quad({0, 0, 0}, {0, 0, kDepth}, {kLength, 0, kDepth}, {kLength, 0, 0});
    b.use_object("cladding", {0.46f, 0.52f, 0.56f});
    b.add_quad({0, 0, 0}, {kLength, 0, 0}, {kLength, kHeight, 0}, {0, kHeight, 0});
    b.add_quad({0, 0, 0}, {0, kHeight, 0}, {0, kHeight, kDepth}, {0, 0, kDepth});
    const DVec3 up(0, 1, 0);
    const int bays_x = static_cast<int>(kLength / kSpan), bays_z = static_cast<int>(kDepth / kSpan);
    b.use_object("girders", {0.24f, 0.28f, 0.26f});
    for (int i = 0; i <= bays_x; ++i)
        for (int k = 0; k <= bays_z; ++k)
            add_girder(b, {kSpan * i, 0, kSpan * k}, {kSpan * i, kHeight, kSpan * k}, {1, 0, 0});
    for (double y = kStorey; y < kHeight; y += kStorey) {
        b.use_object("girders", {});
        for (int i = 0; i <= bays_x; ++i) add_girder(b, {kSpan * i, y, 0}, {kSpan * i, y, kDepth}, up);
        for (int k = 0; k <= bays_z; ++k) add_girder(b, {0, y, kSpan * k}, {kLength, y, kSpan * k}, up);
        // Walkways of gratings: thin bars between two girders, every second bay.
        for (int k = 1; k < bays_z; k += 2) {
            const double z = kSpan * k;
            b.use_object("grating", {0.30f, 0.31f, 0.32f});
            for (double x = 0.05; x < kLength; x += 0.12)
                b.add_beam({x, y + 0.22, z}, {x, y + 0.22, z + 1.4}, 0.01, 0.03);
            for (const double rail : {z, z + 1.4})
                add_rail(b, {0, y + 0.22, rail}, {kLength, y + 0.22, rail});
        }
    }
}

void add_tanks(MeshBuilder& b, Rng& rng) {
    b.use_object("tanks", {0.66f, 0.66f, 0.62f});
    for (int i = 0; i < 10; ++i) {
        const double x = 4.5 + 7.0 * i, z = draw(rng, 5.0, kDepth - 5.0), r = draw(rng, 1.2, 2.6),
                     h = draw(rng, 3.5, 6.5);
        std::vector<ProfilePoint> profile{{0.9 * r, 0.0}, {0.9 * r, 0.4}, {r, 0.4}, {r, h}};
        for (int k = 1; k <= 10; ++k) {
            const double angle = 0.05 * kPi * k;
            profile.push_back({k == 10 ? 0.0 : r * std::cos(angle), h + 0.4 * r * std::sin(angle)});
        }
        b.add_turned({x, 0, z}, {0, 1, 0}, profile, 64);
        for (const double y : {0.3 * h, 0.6 * h, 0.9 * h}) add_flange(b, {x, y, z}, {0, 1, 0}, r / 1.5, 64);
    }
}

}  // namespace

void make_power_plant(const SceneOptions&, Scene& scene, Task& task) {
    Rng rng(1997);
    MeshBuilder b(scene.mesh);
    add_hall(b);
    add_tanks(b, rng);
    task.done = 0;
    task.total = kTriangles;
    while (scene.mesh.triangle_count() < kTriangles && !task.stopped()) {
        add_pipe(b, rng);
        task.done = std::min(scene.mesh.triangle_count(), kTriangles);
    }
    scene.camera = Camera{.eye = {84.0f, 19.0f, 52.0f}, .target = {40.0f, 10.5f, 16.0f}, .fov = 46.0f};
}

}  // namespace boxwood
