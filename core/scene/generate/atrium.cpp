#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/rng.h"
#include "core/scene/generate/atrium_decor.h"
#include "core/scene/generate/built_in.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood {
namespace {

// The plan, in metres. Columns stand round the court on the lines x = +-12 and z = +-4.5; the galleries
// behind them are kGallery deep. The court lies two steps below the galleries.
constexpr double kBay = 3.0;
constexpr int kLongBays = 8, kShortBays = 3;
constexpr double kHalfLength = 0.5 * kBay * kLongBays, kHalfWidth = 0.5 * kBay * kShortBays;
constexpr double kGallery = 3.6;
constexpr double kCourt = -0.36;
constexpr double kUpperFloor = 5.7;
constexpr double kEaves = 10.8;
constexpr double kWallTop = 12.4;
constexpr double kWall = 0.25;  // half the thickness of the arcades

/// Heights of one storey's arcade.
struct Storey {
    double floor, spring, top;
    double column_radius;
};
constexpr Storey kLower{0.0, 3.6, 5.3, 0.32};
constexpr Storey kUpper{kUpperFloor, 8.5, 10.3, 0.26};

/// One side of the court: local x runs along it from column 0, local z points out of the court.
struct Side {
    Placement placement;
    int bays;
    double length() const { return kBay * bays; }
};

std::array<Side, 4> court_sides() {
    const DVec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    return {{{{{-kHalfLength, 0, kHalfWidth}, x, y, z}, kLongBays},
             {{{kHalfLength, 0, kHalfWidth}, -z, y, x}, kShortBays},
             {{{kHalfLength, 0, -kHalfWidth}, -x, y, -z}, kLongBays},
             {{{-kHalfLength, 0, -kHalfWidth}, z, y, -x}, kShortBays}}};
}

void use_stone(MeshBuilder& b) { b.use_object("sandstone", {0.62f, 0.52f, 0.38f}); }
void use_wood(MeshBuilder& b) { b.use_object("timber", {0.22f, 0.11f, 0.05f}); }

/// A column at the local origin: plinth, Attic base, shaft that swells, capital and abacus.
void add_column(MeshBuilder& b, const Storey& storey) {
    const double r = storey.column_radius;
    const double foot = 0.55 * r, head = storey.spring - storey.floor - 0.45 * r;
    const double shaft = foot + 0.75 * r, neck = head - 1.3 * r;
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= 4; ++i) {  // torus
        const double angle = kPi * (i / 4.0 - 0.5);
        profile.push_back({1.15 * r + 0.22 * r * std::cos(angle), foot + 0.22 * r * (1.0 + std::sin(angle))});
    }
    profile.push_back({1.08 * r, shaft});
    for (int i = 0; i <= 5; ++i) {  // entasis: a fifth of the taper is a bulge
        const double u = i / 5.0;
        profile.push_back(
            {r * (1.0 - 0.16 * u + 0.10 * u * (1.0 - u)), shaft + 0.05 * r + u * (neck - shaft)});
    }
    profile.push_back({0.98 * r, neck + 0.12 * r});
    profile.push_back({0.88 * r, neck + 0.28 * r});
    for (int i = 1; i <= 4; ++i) {  // bell of the capital
        const double u = i / 4.0;
        profile.push_back({r * (0.88 + 0.47 * u * u), neck + 0.28 * r + u * (head - neck - 0.28 * r)});
    }
    use_marble(b);
    b.add_turned({0, storey.floor, 0}, {0, 1, 0}, profile, 16);
    b.add_box({-1.45 * r, storey.floor, -1.45 * r}, {1.45 * r, storey.floor + foot, 1.45 * r});
    b.add_box({-1.4 * r, storey.floor + head, -1.4 * r}, {1.4 * r, storey.spring, 1.4 * r});
}

/// The arcade's wall over one bay, local x in [0, kBay], with a round arch and its archivolt.
void add_arch(MeshBuilder& b, const Storey& storey) {
    constexpr int kSegments = 16;
    const double middle = 0.5 * kBay, radius = middle - 1.15 * storey.column_radius;
    const auto on_arch = [&](double u, double r, double z) {
        const double angle = kPi * (1.0 - u);
        return DVec3(middle + r * std::cos(angle), storey.spring + r * std::sin(angle), z);
    };
    use_stone(b);
    b.add_surface(kSegments, 1,
                  [&](double u, double v) { return on_arch(u, radius, kWall * (2.0 * v - 1.0)); });
    for (const double z : {-kWall, kWall}) {
        b.add_surface(kSegments, 1, [&](double u, double v) {
            const DVec3 p = on_arch(u, radius, z);
            return DVec3(p.x, p.y + v * (storey.top - p.y), z);
        });
        b.add_quad({0, storey.spring, z}, {middle - radius, storey.spring, z},
                   {middle - radius, storey.top, z}, {0, storey.top, z});
        b.add_quad({middle + radius, storey.spring, z}, {kBay, storey.spring, z}, {kBay, storey.top, z},
                   {middle + radius, storey.top, z});
    }
    use_marble(b);
    const double edge[][2] = {{0.0, 0.05}, {0.10, 0.08}, {0.12, 0.04}, {0.24, 0.06}, {0.26, 0.0}};
    b.add_surface(kSegments, 4, [&](double u, double v) {
        const auto& p = edge[std::lround(4.0 * v)];
        return on_arch(u, radius + p[0], -kWall - p[1]);
    });
    b.add_surface(kSegments, 1, [&](double u, double v) { return on_arch(u, radius, -kWall - 0.05 * v); });
    b.add_prism(std::array<glm::dvec2, 4>{{{middle - 0.10, storey.spring + radius - 0.02},
                                           {middle + 0.10, storey.spring + radius - 0.02},
                                           {middle + 0.17, storey.spring + radius + 0.36},
                                           {middle - 0.17, storey.spring + radius + 0.36}}},
                -kWall - 0.12, -kWall);
}

/// Groin vault over local x in [x0, x1] and z in [0, kGallery]: the higher of two barrels. Four quarters,
/// each with its crease along the diagonals of its squares.
void add_vault(MeshBuilder& b, double x0, double x1) {
    constexpr int kSteps = 5;
    constexpr double kRise = 1.6;
    b.use_object("vault plaster", {0.74f, 0.66f, 0.53f});
    for (const double sx : {-1.0, 1.0}) {
        for (const double sz : {-1.0, 1.0}) {
            b.add_surface(kSteps, kSteps, [&](double u, double v) {
                const double a = std::sin(0.5 * kPi * u), c = std::sin(0.5 * kPi * v);  // finer at the walls
                const double least = std::min(a, c);
                const double rise = kRise * std::sqrt(std::max(0.0, 1.0 - least * least));
                return DVec3(0.5 * (x0 + x1) + 0.5 * sx * a * (x1 - x0), kLower.spring + rise,
                             0.5 * kGallery * (1.0 + sz * c));
            });
        }
    }
}

/// Rails and turned balusters over local x in [x0, x1] at z = 0.
void add_balustrade(MeshBuilder& b, double x0, double x1, double floor) {
    use_marble(b);
    b.add_box({x0, floor + 0.06, -0.11}, {x1, floor + 0.16, 0.11});
    b.add_box({x0, floor + 0.88, -0.13}, {x1, floor + 1.0, 0.13});
    constexpr ProfilePoint kProfile[] = {{0.04, 0.16}, {0.09, 0.34}, {0.035, 0.62}, {0.07, 0.88}};
    const int count = static_cast<int>(std::lround((x1 - x0) / 0.36));
    for (int i = 0; i < count; ++i)
        b.add_turned({x0 + (x1 - x0) * (i + 0.5) / count, floor, 0}, {0, 1, 0}, kProfile, 6);
}

/// A framed panel on the outer wall (local z = kGallery): doors below, shutters above.
void add_panel(MeshBuilder& b, double x, double half_width, double bottom, double top) {
    const double z = kGallery, face = kGallery - 0.04;
    use_marble(b);
    b.add_box({x - half_width - 0.16, bottom, z - 0.1}, {x - half_width, top, z + 0.01});
    b.add_box({x + half_width, bottom, z - 0.1}, {x + half_width + 0.16, top, z + 0.01});
    b.add_box({x - half_width - 0.26, top, z - 0.14}, {x + half_width + 0.26, top + 0.2, z + 0.01});
    use_wood(b);
    b.add_quad({x - half_width, bottom, face}, {x + half_width, bottom, face}, {x + half_width, top, face},
               {x - half_width, top, face});
    for (const double s : {-0.5, 0.5}) {
        for (int row = 0; row < 2; ++row) {
            const double y = bottom + (top - bottom) * (row + 0.5) / 2.0;
            const double w = 0.36 * half_width, h = 0.2 * (top - bottom);
            b.add_box({x + s * half_width - w, y - h, face - 0.03}, {x + s * half_width + w, y + h, face});
        }
    }
}

/// Outer wall, gallery floors, roof and the long mouldings of one side.
void add_shell(MeshBuilder& b, const Side& side) {
    const double l = side.length(), g = kGallery, outside = kGallery + 0.5;
    use_stone(b);
    b.add_quad({-g, 0, g}, {l + g, 0, g}, {l + g, kWallTop, g}, {-g, kWallTop, g});
    b.add_quad({-outside, kCourt, outside}, {l + outside, kCourt, outside}, {l + outside, kWallTop, outside},
               {-outside, kWallTop, outside});
    b.add_quad({-g, kWallTop, g}, {l + g, kWallTop, g}, {l + outside, kWallTop, outside},
               {-outside, kWallTop, outside});
    b.use_object("gallery floor", {0.45f, 0.30f, 0.20f});
    b.add_quad({-g, kUpperFloor, 0}, {l, kUpperFloor, 0}, {l, kUpperFloor, g}, {-g, kUpperFloor, g});
    b.use_object("roof tiles", {0.48f, 0.16f, 0.08f});
    b.add_quad({0.7, kEaves, -0.7}, {l - 0.7, kEaves, -0.7}, {l + g, kWallTop, g}, {-g, kWallTop, g});
    use_marble(b);
    constexpr glm::dvec2 kCourse[] = {{5.25, -0.25}, {5.3, -0.33}, {5.42, -0.33},
                                      {5.5, -0.46},  {5.7, -0.5},  {5.7, 0.1}};
    b.add_moulding(kCourse, 0.0, l);
    constexpr glm::dvec2 kCornice[] = {{10.2, -0.25},  {10.25, -0.32}, {10.5, -0.32}, {10.52, -0.6},
                                       {10.66, -0.64}, {10.78, -0.78}, {10.8, 0.3}};
    b.add_moulding(kCornice, 0.0, l);
    constexpr glm::dvec2 kBackOfWall[] = {{5.3, 0.25}, {5.7, 0.25}, {5.7, 0.0}};
    b.add_moulding(kBackOfWall, 0.0, l);
    for (int i = 0; i < 8 * side.bays; ++i) {  // dentils
        const double x = l * (i + 0.5) / (8.0 * side.bays);
        b.add_box({x - 0.09, 10.34, -0.46}, {x + 0.09, 10.52, -0.3});
    }
}

/// The two steps from the gallery down to the court; short sides give way to the long ones at the corners.
void add_steps(MeshBuilder& b, const Side& side) {
    use_stone(b);
    for (int i = 0; i < 2; ++i) {
        const double depth = 0.55 + 0.4 * i, inset = side.bays == kShortBays ? depth : 0.0;
        b.add_box({inset, kCourt, -depth}, {side.length() - inset, -0.18 * i, i == 0 ? 0.0 : -0.55});
    }
}

void add_floor(MeshBuilder& b, const Side& side) {
    const auto tile = [&](int index, double x0, double x1, double z0, double z1) {
        if (index % 2 == 0)
            b.use_object("dark tiles", {0.16f, 0.07f, 0.05f});
        else
            b.use_object("light tiles", {0.60f, 0.50f, 0.36f});
        b.add_quad({x0, 0, z0}, {x1, 0, z0}, {x1, 0, z1}, {x0, 0, z1});
    };
    for (int i = -2; i < 2 * side.bays; ++i) {
        const double x0 = i < 0 ? 0.5 * i * kGallery : 0.5 * i * kBay;
        const double x1 = i < 0 ? 0.5 * (i + 1) * kGallery : 0.5 * (i + 1) * kBay;
        for (int k = 0; k < 2; ++k) tile(i + k + 2, x0, x1, 0.5 * k * kGallery, 0.5 * (k + 1) * kGallery);
    }
}

void add_side(MeshBuilder& b, const Side& side, bool has_stair) {
    b.place(side.placement);
    add_shell(b, side);
    add_steps(b, side);
    add_floor(b, side);
    add_vault(b, -kGallery, 0.0);
    for (const Storey& storey : {kLower, kUpper}) {
        use_stone(b);
        b.add_box({-kWall, storey.spring, -kWall}, {kWall, storey.top, kWall});  // the corner's pier
    }
    for (int i = 0; i < side.bays; ++i) {
        b.place(side.placement.moved({kBay * i, 0, 0}));
        for (const Storey& storey : {kLower, kUpper}) {
            add_column(b, storey);
            add_arch(b, storey);
        }
        add_vault(b, 0.0, kBay);
        if (!has_stair || i != side.bays / 2) add_balustrade(b, 0.36, kBay - 0.36, kUpperFloor);
        use_stone(b);
        b.add_box({-0.28, 0.0, kGallery - 0.16}, {0.28, kLower.spring - 0.2, kGallery});  // pilaster
        b.add_box({-0.36, kLower.spring - 0.2, kGallery - 0.24}, {0.36, kLower.spring, kGallery});
        add_panel(b, 0.5 * kBay, 0.55, i % 2 == 0 ? 0.0 : 1.2, 2.5);
        add_panel(b, 0.5 * kBay, 0.5, kUpperFloor + 0.9, kUpperFloor + 2.5);
    }
    b.place({});
}

/// The court's floor: squares of one metre with a border.
void add_court(MeshBuilder& b) {
    const int columns = static_cast<int>(2.0 * kHalfLength) - 2,
              rows = static_cast<int>(2.0 * kHalfWidth) - 2;
    const double x0 = -0.5 * columns, z0 = -0.5 * rows;
    for (int i = 0; i < columns; ++i) {
        for (int k = 0; k < rows; ++k) {
            if ((i + k) % 2 == 0)
                b.use_object("dark tiles", {});
            else
                b.use_object("light tiles", {});
            b.add_quad({x0 + i, kCourt, z0 + k}, {x0 + i, kCourt, z0 + k + 1},
                       {x0 + i + 1, kCourt, z0 + k + 1}, {x0 + i + 1, kCourt, z0 + k});
        }
    }
    b.use_object("gallery floor", {});
    for (const double s : {-1.0, 1.0}) {
        b.add_quad({-kHalfLength, kCourt, s * kHalfWidth}, {kHalfLength, kCourt, s * kHalfWidth},
                   {kHalfLength, kCourt, -s * z0}, {-kHalfLength, kCourt, -s * z0});
        b.add_quad({s * kHalfLength, kCourt, -z0}, {s * kHalfLength, kCourt, z0}, {-s * x0, kCourt, z0},
                   {-s * x0, kCourt, -z0});
    }
}

/// A straight flight from the court to the upper gallery at x = -kHalfLength, on two slanting stringers.
void add_stair(MeshBuilder& b) {
    constexpr int kSteps = 30;
    constexpr double kTread = 0.29, kHalf = 1.1;
    const double rise = (kUpperFloor - kCourt) / kSteps, end = -kHalfLength + 0.35;
    const double start = end + kTread * kSteps;
    use_marble(b);
    for (int i = 0; i < kSteps; ++i) {
        const double x = start - kTread * i, y = kCourt + rise * i;
        b.add_box({x - kTread - 0.04, y + rise - 0.06, -kHalf}, {x, y + rise, kHalf});
        b.add_quad({x - 0.04, y, -kHalf}, {x - 0.04, y, kHalf}, {x - 0.04, y + rise, kHalf},
                   {x - 0.04, y + rise, -kHalf});
    }
    const DVec3 slope(end - start, kUpperFloor - kCourt, 0.0);
    for (const double z : {-kHalf, kHalf}) {
        use_stone(b);
        b.add_beam({start, kCourt, z}, {end, kUpperFloor, z}, 0.16, 0.55);
        use_bronze(b);
        b.add_tube(DVec3(start, kCourt + 1.1, z), DVec3(start, kCourt + 1.1, z) + slope, 0.035, 0.035, 8,
                   true);
        for (int i = 0; i <= kSteps; ++i) {
            const DVec3 foot = DVec3(start, kCourt + 0.25, z) + slope * (i / static_cast<double>(kSteps));
            b.add_tube(foot, foot + DVec3(0, 0.85, 0), 0.014, 0.014, 5);
        }
        use_marble(b);
        b.add_box({start - 0.1, kCourt, z - 0.2}, {start + 0.3, kCourt + 1.2, z + 0.2});
        b.add_sphere({start + 0.1, kCourt + 1.38, z}, 0.2, 14, 8);
    }
}

/// King-post trusses over the court, open to the sky, with purlins along it.
void add_roof_timber(MeshBuilder& b) {
    const double span = kHalfWidth + 0.2, ridge = kEaves + 2.4;
    use_wood(b);
    for (int i = 0; i <= kLongBays; ++i) {
        const double x = std::clamp(kBay * i - kHalfLength, 0.5 - kHalfLength, kHalfLength - 0.5);
        b.add_box({x - 0.11, kEaves, -span}, {x + 0.11, kEaves + 0.3, span});
        b.add_box({x - 0.09, kEaves + 0.3, -0.1}, {x + 0.09, ridge, 0.1});
        for (const double s : {-1.0, 1.0}) {
            b.add_beam({x, kEaves + 0.3, s * span}, {x, ridge, 0}, 0.18, 0.22, {0, 1, 0});
            b.add_beam({x, kEaves + 0.5, 0}, {x, kEaves + 1.3, s * 0.55 * span}, 0.14, 0.16);
        }
    }
    for (const double v : {0.0, 0.33, 0.66, 1.0}) {
        for (const double s : {-1.0, 1.0}) {
            if (v == 1.0 && s < 0.0) continue;
            const double y = kEaves + 0.48 + v * (ridge - kEaves - 0.3), z = s * span * (1.0 - v);
            b.add_box({-kHalfLength, y - 0.08, z - 0.07}, {kHalfLength, y + 0.08, z + 0.07});
        }
    }
}

void add_curtains(MeshBuilder& b, Rng& rng) {
    struct Cloth {
        const char* name;
        Vec3 color;
    };
    const Cloth cloths[] = {{"red cloth", {0.55f, 0.04f, 0.04f}},
                            {"green cloth", {0.05f, 0.26f, 0.10f}},
                            {"blue cloth", {0.05f, 0.10f, 0.38f}}};
    const std::array<Side, 4> sides = court_sides();
    for (const size_t side : {size_t{0}, size_t{2}}) {
        for (int i = 0; i < 4; ++i) {
            const Cloth& cloth = cloths[(static_cast<size_t>(i) + side) % 3];
            b.place(sides[side].placement.moved({kBay * (2 * i + 1), 0, 0}));
            b.use_object(cloth.name, cloth.color);
            add_curtain(b, kBay, kLower.spring, rng);
        }
    }
    b.place({});
}

}  // namespace

void make_atrium(const SceneOptions&, Scene& scene, Task& task) {
    Rng rng(1);
    MeshBuilder b(scene.mesh);
    const std::array<Side, 4> sides = court_sides();
    for (size_t i = 0; i < sides.size() && !task.stopped(); ++i) add_side(b, sides[i], i == 3);
    add_court(b);
    add_stair(b);
    add_roof_timber(b);
    add_curtains(b, rng);
    for (const double x : {-6.0, 0.0, 6.0}) {
        for (const double s : {-1.0, 1.0}) {
            add_vase(b, {x, kCourt, s * (kHalfWidth - 1.4)}, rng);
            add_lantern(b, {x, kEaves, s * 1.9}, 4.6);
        }
    }
    add_fountain(b, {3.0, kCourt, 0.0});
    scene.camera = Camera{.eye = {10.9f, 1.7f, 2.5f}, .target = {-4.0f, 3.5f, -0.4f}, .fov = 66.0f};
}

}  // namespace boxwood
