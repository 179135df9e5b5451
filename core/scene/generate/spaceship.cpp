#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/rng.h"
#include "core/scene/generate/built_in.h"
#include "core/scene/generate/mesh_builder.h"
#include "core/scene/mesh_transform.h"

namespace boxwood {
namespace {

// The ship before it is turned, in metres: the nose at +x, y up, starboard +z.

/// Half width, height above and depth below the water line, as it were, at one station of the hull. Between
/// stations the hull is straight, so that its plates may be as long as a section.
struct Station {
    double x, half_width, top, bottom;
};
constexpr std::array<Station, 6> kStations = {{{210, 0.6, 0.3, 0.5},
                                               {165, 7.0, 3.2, 4.0},
                                               {50, 21.0, 8.5, 9.0},
                                               {-90, 36.0, 13.0, 13.0},
                                               {-170, 40.0, 14.0, 13.0},
                                               {-190, 33.0, 11.0, 10.0}}};

/// Section of the hull, (z, y) in units of the station: the sharp edges, the shoulders, the deck, the keel.
constexpr std::array<glm::dvec2, 8> kSection = {{{1.0, 0.0},
                                                 {0.58, 0.72},
                                                 {0.22, 1.0},
                                                 {-0.22, 1.0},
                                                 {-0.58, 0.72},
                                                 {-1.0, 0.0},
                                                 {-0.42, -1.0},
                                                 {0.42, -1.0}}};

Station station_at(double x) {
    size_t i = 0;
    while (i + 2 < kStations.size() && x < kStations[i + 1].x) ++i;
    const Station &a = kStations[i], &b = kStations[i + 1];
    const double u = (x - a.x) / (b.x - a.x);
    const auto mix = [u](double p, double q) { return p + u * (q - p); };
    return {x, mix(a.half_width, b.half_width), mix(a.top, b.top), mix(a.bottom, b.bottom)};
}

/// Point of the hull at x, `around` in [0, 8) along the section, raised by `height` away from the ship's
/// axis.
DVec3 hull_point(double x, double around, double height = 0.0) {
    const Station s = station_at(x);
    const double turn = around < 0.0 ? around + 8.0 : around;
    const auto side = static_cast<size_t>(turn) % 8;
    const glm::dvec2 a = kSection[side], b = kSection[(side + 1) % 8];
    const auto scaled = [&](const glm::dvec2& p) {
        return glm::dvec2(p.x * s.half_width, p.y * (p.y > 0.0 ? s.top : s.bottom));
    };
    const glm::dvec2 from = scaled(a), to = scaled(b);
    const glm::dvec2 p = from + (turn - std::floor(turn)) * (to - from);
    const glm::dvec2 normal = glm::normalize(glm::dvec2(to.y - from.y, from.x - to.x));
    return {x, p.y + height * normal.y, p.x + height * normal.x};
}

void use_hull(MeshBuilder& b) { b.use_object("hull", {0.40f, 0.42f, 0.45f}); }
void use_steel(MeshBuilder& b) { b.use_object("steel", {0.30f, 0.31f, 0.34f}); }
void use_lattice(MeshBuilder& b) { b.use_object("lattice", {0.62f, 0.56f, 0.42f}); }

/// The hull itself: strips from station to station, closed at both ends.
void add_hull(MeshBuilder& b) {
    constexpr int kStrips = 8;  // on each of the eight sides
    use_hull(b);
    for (int side = 0; side < 8; ++side) {
        b.add_surface(kStrips, static_cast<int>(kStations.size()) - 1, [&](double u, double v) {
            const size_t station = static_cast<size_t>(std::lround(v * (kStations.size() - 1.0)));
            return hull_point(kStations[station].x, side + std::min(u, 1.0 - 1e-12));
        });
        for (const double x : {kStations.front().x, kStations.back().x})
            b.add_triangle({x, 0, 0}, hull_point(x, side), hull_point(x, side + 1.0 - 1e-12));
    }
}

/// A raised plate on the hull between x0 and x1 and between two places around the section.
void add_plate(MeshBuilder& b, double x0, double x1, double around0, double around1, double height) {
    const DVec3 foot[] = {hull_point(x0, around0), hull_point(x1, around0), hull_point(x1, around1),
                          hull_point(x0, around1)};
    const DVec3 top[] = {hull_point(x0 + height, around0, height), hull_point(x1 - height, around0, height),
                         hull_point(x1 - height, around1, height), hull_point(x0 + height, around1, height)};
    b.add_quad(top[0], top[1], top[2], top[3]);
    for (size_t i = 0; i < 4; ++i) b.add_quad(foot[i], foot[(i + 1) % 4], top[(i + 1) % 4], top[i]);
}

/// A slat: a sharp ridge along the hull.
void add_slat(MeshBuilder& b, double x0, double x1, double around, double width, double height) {
    const DVec3 front[] = {hull_point(x0, around), hull_point(x0, around + 0.5 * width, height),
                           hull_point(x0, around + width)};
    const DVec3 back[] = {hull_point(x1, around), hull_point(x1, around + 0.5 * width, height),
                          hull_point(x1, around + width)};
    for (size_t i = 0; i < 2; ++i) b.add_quad(front[i], back[i], back[i + 1], front[i + 1]);
    b.add_triangle(front[0], front[1], front[2]);
    b.add_triangle(back[0], back[1], back[2]);
}

struct Paint {
    const char* name;
    Vec3 color;
};
constexpr size_t kPaintCount = 4;
const Paint* paints() {
    static const Paint table[kPaintCount] = {{"light armour", {0.62f, 0.63f, 0.64f}},
                                             {"grey armour", {0.42f, 0.45f, 0.49f}},
                                             {"dark armour", {0.20f, 0.22f, 0.27f}},
                                             {"red armour", {0.52f, 0.07f, 0.04f}}};
    return table;
}
void use_paint(MeshBuilder& b, size_t i) { b.use_object(paints()[i].name, paints()[i].color); }

/// Belts of armour that run from station to station on every side of the section.
void add_belts(MeshBuilder& b) {
    constexpr double kBelts[][2] = {{0.02, 0.10}, {0.47, 0.53}, {0.90, 0.98}};
    for (size_t section = 0; section + 1 < kStations.size(); ++section) {
        for (int side = 0; side < 8; ++side) {
            use_paint(b, side == 0 || side == 4 ? 3 : 0);
            for (const auto& belt : kBelts)
                add_plate(b, kStations[section].x - 0.5, kStations[section + 1].x + 0.5, side + belt[0],
                          side + belt[1], 0.7);
        }
    }
}

/// Between the belts: fields of slats, some plates, some bare hull.
void add_fields(MeshBuilder& b, Rng& rng) {
    constexpr int kAcross = 5, kSlats = 9;
    constexpr double kCellLength = 13.0, kField = 0.8 / kAcross;
    for (size_t section = 0; section + 1 < kStations.size(); ++section) {
        const double front = kStations[section].x, back = kStations[section + 1].x;
        const int along = std::max(1, static_cast<int>(std::lround((front - back) / kCellLength)));
        for (int cell = 0; cell < 8 * kAcross * along; ++cell) {
            const int side = cell % 8, across = cell / 8 % kAcross, place = cell / (8 * kAcross);
            const double x0 = front + (back - front) * (place + 0.04) / along;
            const double x1 = front + (back - front) * (place + 0.96) / along;
            const double around = side + 0.1 + across * kField;
            const float kind = rng.next(), shade = rng.next();
            use_paint(b, shade < 0.45f ? 0 : shade < 0.75f ? 1 : 2);
            if (kind < 0.62f) {
                const double across_metres =
                    glm::length(hull_point(x1, around + kField) - hull_point(x1, around));
                const double width = std::min(0.35, 0.2 / across_metres) * kField;
                for (int i = 0; i < kSlats; ++i)
                    add_slat(b, x0, x1, around + kField * (i + 0.3) / kSlats, width, 0.15);
            } else if (kind < 0.80f) {
                add_plate(b, x0, x1, around + 0.1 * kField, around + 0.9 * kField, 0.45);
            }
        }
    }
}

/// Pipes along the hull, each inside one section, where it is straight: a few long ones, many short thin
/// ones.
void add_pipes(MeshBuilder& b, Rng& rng) {
    use_steel(b);
    for (int i = 0; i < 860; ++i) {
        const size_t section = 1 + rng.next_index(kStations.size() - 2);
        const double front = kStations[section].x, back = kStations[section + 1].x;
        const bool is_long = i < 30;
        const double length = is_long ? 0.85 * (front - back) : static_cast<double>(rng.next(8.0f, 12.0f));
        const double radius = is_long ? 0.35 : 0.09;
        const double start =
            front - 1.0 - static_cast<double>(rng.next()) * std::max(0.0, front - back - length - 2.0);
        const double around = static_cast<double>(rng.next(0.0f, 8.0f)),
                     height = (is_long ? 0.8 : 0.5) + radius;
        b.add_tube(hull_point(start, around, height), hull_point(start - length, around, height), radius,
                   radius, is_long ? 8 : 5);
    }
}

/// A girder of four longerons with crossed braces from `from` to `to`, tapering from half width h0 to h1.
void add_lattice(MeshBuilder& b, const DVec3& from, const DVec3& to, double h0, double h1, int bays) {
    const DVec3 along = glm::normalize(to - from);
    const DVec3 x =
        glm::normalize(glm::cross(along, std::abs(along.y) < 0.9 ? DVec3(0, 1, 0) : DVec3(1, 0, 0)));
    const DVec3 y = glm::cross(x, along);
    const auto corner = [&](int bay, int i) {
        const double u = static_cast<double>(bay) / bays, h = h0 + u * (h1 - h0);
        const double sx = i % 4 == 0 || i % 4 == 3 ? h : -h, sy = i % 4 < 2 ? h : -h;
        return from + u * (to - from) + sx * x + sy * y;
    };
    use_lattice(b);
    for (int i = 0; i < 4; ++i) b.add_tube(corner(0, i), corner(bays, i), 0.09, 0.06, 6);
    for (int bay = 0; bay < bays; ++bay) {
        for (int i = 0; i < 4; ++i) {
            b.add_tube(corner(bay, i), corner(bay + 1, i + 1), 0.035, 0.035, 4);
            b.add_tube(corner(bay, i + 1), corner(bay + 1, i), 0.035, 0.035, 4);
            b.add_tube(corner(bay + 1, i), corner(bay + 1, i + 1), 0.045, 0.045, 4);
        }
    }
}

void add_nozzle(MeshBuilder& b, const DVec3& at, double radius) {
    const ProfilePoint bell[] = {{0.62 * radius, 0.0},           {0.66 * radius, 0.3 * radius},
                                 {0.55 * radius, 0.5 * radius},  {0.60 * radius, 0.8 * radius},
                                 {0.75 * radius, 1.2 * radius},  {0.93 * radius, 1.7 * radius},
                                 {1.0 * radius, 2.0 * radius},   {0.95 * radius, 2.0 * radius},
                                 {0.70 * radius, 1.25 * radius}, {0.50 * radius, 0.7 * radius}};
    b.use_object("nozzles", {0.20f, 0.16f, 0.14f});
    b.add_turned(at, {-1, 0, 0}, bell, 28);
    const ProfilePoint glow[] = {{0.55 * radius, 0.8 * radius}, {0.0, 0.95 * radius}};
    b.use_object("engine glow", {0.35f, 0.75f, 1.0f});
    b.add_turned(at, {-1, 0, 0}, glow, 28);
}

/// Engine pods beside the hull: long tubes on struts, a lattice boom before each.
void add_pods(MeshBuilder& b) {
    for (const double s : {-1.0, 1.0}) {
        const double z = 58.0 * s;
        const ProfilePoint skin[] = {{0.0, -16.0}, {3.2, -9.0},  {5.6, 0.0},   {6.6, 14.0}, {6.6, 110.0},
                                     {7.4, 112.0}, {7.4, 150.0}, {6.0, 156.0}, {0.0, 156.0}};
        use_hull(b);
        b.add_turned({-45, -2, z}, {-1, 0, 0}, skin, 64);
        use_paint(b, 3);
        for (int i = 0; i < 14; ++i) {  // fins along the pod
            const double angle = 2.0 * kPi * i / 14.0;
            const DVec3 out(0, std::cos(angle), std::sin(angle));
            const DVec3 foot = DVec3(-62, -2, z) + 6.6 * out;
            b.add_beam(foot, foot - DVec3(90, 0, 0), 0.3, 0.9, out);
        }
        use_steel(b);
        for (const double x : {-80.0, -110.0, -140.0, -172.0}) {
            b.add_beam({x, 1.0, 30.0 * s}, {x - 8.0, -1.5, z - 5.0 * s}, 6.0, 1.6);
            b.add_tube({x + 4, 3.0, 28.0 * s}, {x + 14, 0.0, z - 4.0 * s}, 0.4, 0.4, 8);
        }
        add_lattice(b, {-32, -2, z}, {126, -1, 44.0 * s}, 1.5, 0.3, 46);
        add_nozzle(b, {-198, -2, z}, 6.4);
    }
    for (const double z : {-19.0, 0.0, 19.0}) add_nozzle(b, {-189, 0.5, z}, z == 0.0 ? 9.0 : 7.5);
}

/// Rows of lit windows on the flank of a block, z constant.
void add_windows(MeshBuilder& b, double x0, double x1, double y0, double y1, double z, Rng& rng) {
    b.use_object("windows", {1.0f, 0.86f, 0.50f});
    for (double y = y0 + 0.8; y + 0.8 < y1; y += 1.5) {
        for (double x = x0 + 0.8; x + 1.0 < x1; x += 1.3) {
            if (rng.next() < 0.35f) continue;
            b.add_quad({x, y, z}, {x + 0.7, y, z}, {x + 0.7, y + 0.45, z}, {x, y + 0.45, z});
        }
    }
}

/// The stepped tower aft with its bridge, windows, masts and a dish.
void add_tower(MeshBuilder& b, Rng& rng) {
    struct Block {
        double x0, x1, y0, y1, half;
    };
    constexpr Block kBlocks[] = {{-176, -62, 10, 17, 13},   {-172, -84, 17, 22, 10},
                                 {-168, -104, 22, 28, 7.5}, {-160, -122, 28, 35, 4.5},
                                 {-158, -128, 35, 38, 3},   {-154, -136, 38, 42, 11}};
    for (const Block& k : kBlocks) {
        const double slope = 0.35 * (k.y1 - k.y0);
        use_hull(b);
        const glm::dvec2 flank[] = {
            {k.x0, k.y0}, {k.x1, k.y0}, {k.x1 - 2.5 * slope, k.y1}, {k.x0 + slope, k.y1}};
        b.add_prism(flank, -k.half, k.half);
        for (const double s : {-1.0, 1.0})
            add_windows(b, k.x0 + slope, k.x1 - 2.5 * slope, k.y0, k.y1, s * (k.half + 0.03), rng);
        use_steel(b);
        for (int i = 0; i < 5; ++i) {  // ribs along the roof
            const double z = k.half * (i - 2.0) / 2.4;
            b.add_beam({k.x0 + slope, k.y1 + 0.12, z}, {k.x1 - 2.5 * slope, k.y1 + 0.12, z}, 0.25, 0.3);
        }
    }
    add_lattice(b, {-140, 42, 6}, {-146, 86, 6}, 1.3, 0.15, 15);
    add_lattice(b, {-140, 42, -6}, {-146, 78, -6}, 1.3, 0.15, 13);
    add_lattice(b, {-150, 42, 0}, {-156, 64, 0}, 1.0, 0.15, 9);
    add_lattice(b, {-70, 17, 0}, {-66, 44, 0}, 1.1, 0.15, 10);
    constexpr ProfilePoint kDish[] = {{0.0, 0.0}, {2.0, 0.25}, {3.6, 0.9},
                                      {4.8, 1.9}, {4.7, 2.0},  {0.0, 0.3}};
    use_paint(b, 0);
    b.add_turned({-66, 44, 0}, {1.0, 0.55, 0.2}, kDish, 28);
}

/// Guns in domes along the shoulders of the hull and on the deck, and a long barrel along its middle.
void add_guns(MeshBuilder& b, Rng& rng) {
    for (int i = 0; i < 16; ++i) {
        for (const double around : {0.82, 4.18, 6.75, 7.25}) {
            const double x = 110.0 - 15.5 * i, radius = 1.0 + 0.07 * i,
                         aim = static_cast<double>(rng.next(-0.5f, 0.5f));
            const DVec3 foot = hull_point(x, around, 0.5),
                        up = glm::normalize(hull_point(x, around, 1.5) - foot);
            const ProfilePoint dome[] = {{1.25 * radius, -0.4},
                                         {1.25 * radius, 0.3 * radius},
                                         {radius, 0.4 * radius},
                                         {0.8 * radius, 0.95 * radius},
                                         {0.0, 1.2 * radius}};
            use_steel(b);
            b.add_turned(foot, up, dome, 10);
            const DVec3 ahead = glm::normalize(DVec3(1.0, 0.25, aim) + 0.3 * up);
            const DVec3 side = glm::normalize(glm::cross(ahead, up));
            for (const double s : {-0.35, 0.35}) {
                const DVec3 breech = foot + 0.7 * radius * up + s * radius * side;
                b.add_tube(breech, breech + 5.0 * radius * ahead, 0.13 * radius, 0.09 * radius, 6);
            }
        }
    }
    use_steel(b);
    b.add_tube({-60, 15.2, 0}, {172, 7.2, 0}, 1.5, 0.9, 28, true);
    for (int i = 0; i < 12; ++i) {
        const double x = -45.0 + 18.0 * i;
        b.add_tube({x, 15.2 - (x + 60) * 8 / 232, 0}, {x + 3.0, 15.2 - (x + 63) * 8 / 232, 0}, 1.9, 1.9, 28,
                   true);
    }
}

void add_antennas(MeshBuilder& b, Rng& rng) {
    use_lattice(b);
    for (int i = 0; i < 220; ++i) {
        const double x = static_cast<double>(rng.next(-180.0f, 160.0f)),
                     around = static_cast<double>(rng.next(0.0f, 8.0f));
        const double length = static_cast<double>(rng.next(3.0f, 11.0f)),
                     rake = static_cast<double>(rng.next(0.2f, 0.7f));
        const DVec3 foot = hull_point(x, around), up = hull_point(x, around, 1.0) - foot;
        b.add_tube(foot, foot + length * glm::normalize(up - DVec3(rake, 0, 0)), 0.06, 0.02, 4);
    }
}

}  // namespace

/// After the description of the space ship in Dammertz, Keller, "The Edge Volume Heuristic", RT 2008, section
/// 3: long thin triangles for the outer hull, many small ones for details, turned by 45 degrees in space.
void make_spaceship(const SceneOptions&, Scene& scene, Task& task) {
    Rng rng(2008);
    MeshBuilder b(scene.mesh);
    add_hull(b);
    add_belts(b);
    add_fields(b, rng);
    add_pipes(b, rng);
    if (task.stopped()) return;
    add_pods(b);
    add_tower(b, rng);
    add_guns(b, rng);
    add_antennas(b, rng);
    scene.camera = Camera{.eye = {310.0f, 180.0f, -160.0f}, .target = {26.0f, -4.0f, 0.0f}, .fov = 42.0f};
    const AffineMap turn = rotation(45.0, {1.0, 1.0, 1.0}, DVec3(0.0));
    transform(scene.mesh, turn);
    transform(*scene.camera, turn);
    scene.camera->up = {0.0f, 1.0f, 0.0f};
}

}  // namespace boxwood
