#include <array>
#include <cmath>

#include "core/scene/generate/built_in.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood {
namespace {

/// The outside mirror of a car as patches of smooth surfaces, in metres: x to the outside, y up, the glass
/// looks along z. Each patch is cut into a number of strips that grows with `detail`, as CAD programs cut by
/// chord error: many where it bends, few along straight lines.
class CarMirror {
public:
    CarMirror(Mesh& mesh, double detail) : b_(mesh), detail_(detail) {}

    void build() {
        add_housing();
        add_rim();
        add_glass();
        add_lens();
        add_arm();
        add_foot();
        add_bosses();
    }

private:
    /// Strips of a patch that has `count` at detail 1.
    int strips(int count) const { return static_cast<int>(std::lround(count * detail_)); }

    static double angle_of(double u) { return u < 1.0 ? 2.0 * kPi * u : 0.0; }

    /// Outline of the housing at angle u, of size 1 at its rim: rounder above than below.
    static DVec3 outline(double u) {
        const double c = std::cos(angle_of(u)), s = std::sin(angle_of(u));
        const double power = 2.0 / 2.7;
        const double x = std::copysign(std::pow(std::abs(c), power), c);
        const double y = std::copysign(std::pow(std::abs(s), power), s);
        return {0.125 * x * (1.0 - 0.06 * y), 0.082 * y * (y < 0.0 ? 0.86 : 1.0), 0.0};
    }
    /// The housing's skin, from the rim (v = 0) to its nose (v = 1); `inset` metres below the surface.
    static DVec3 skin(double u, double v, double inset) {
        const double t = std::sin(0.5 * kPi * v);  // strips crowd at the nose, where it bends most
        const double size = v == 1.0 ? 0.0 : std::pow(1.0 - std::pow(t, 2.4), 1.0 / 2.1);
        const DVec3 edge = outline(u);
        const DVec3 p(edge.x * size + 0.035 * t * t, edge.y * size + 0.006 * t, -0.105 * t);
        return p * (1.0 - 8.0 * inset);
    }

    void add_housing() {
        b_.use_object("paint", {0.55f, 0.06f, 0.05f});
        b_.add_surface(strips(240), strips(100), [](double u, double v) { return skin(u, v, 0.0); });
        b_.use_object("inner shell", {0.10f, 0.10f, 0.11f});
        b_.add_surface(strips(150), strips(40), [](double u, double v) { return skin(u, v, 0.006); });
    }

    /// The rolled edge between both skins: long strips across a small radius.
    void add_rim() {
        b_.use_object("paint", {});
        b_.add_surface(strips(240), strips(9), [](double u, double v) {
            const DVec3 outer = skin(u, 0.0, 0.0), inner = skin(u, 0.0, 0.006);
            const double angle = kPi * v;
            const DVec3 middle = 0.5 * (outer + inner), half = 0.5 * (outer - inner);
            return middle + half * std::cos(angle) + DVec3(0, 0, glm::length(half) * std::sin(angle));
        });
    }

    void add_glass() {
        b_.use_object("glass", {0.62f, 0.72f, 0.78f});
        b_.add_surface(strips(150), strips(16), [](double u, double v) {  // slightly convex
            const DVec3 p = 0.93 * v * skin(u, 0.0, 0.006);
            return DVec3(p.x, p.y, -0.012 - 0.35 * (p.x * p.x + p.y * p.y));
        });
        b_.use_object("inner shell", {});
        b_.add_surface(strips(150), strips(6), [](double u, double v) {  // its frame
            const double angle = kPi * v;
            const DVec3 p = (0.945 - 0.02 * std::cos(angle)) * skin(u, 0.0, 0.006);
            return DVec3(p.x, p.y, -0.014 - 0.35 * (p.x * p.x + p.y * p.y) + 0.004 * std::sin(angle));
        });
    }

    /// The turn signal in the outer side: upright ribs, each a few thin strips.
    void add_lens() {
        b_.use_object("turn signal", {0.85f, 0.45f, 0.08f});
        const int ribs = 48, columns = strips(6);
        for (int rib = 0; rib < ribs; ++rib) {
            b_.add_surface(columns, strips(4), [&](double u, double v) {
                const double along = 0.1 + 0.45 * (rib + u) / ribs;
                const double bulge = 0.0014 * std::sin(kPi * u) + 0.0006;
                const DVec3 low = skin(0.955, along, 0.0), high = skin(0.998, along, 0.0);
                return low + v * (high - low) + DVec3(bulge + 0.002 * std::sin(kPi * v), 0, -0.3 * bulge);
            });
        }
    }

    /// From the housing to the door, where it is wide.
    void add_arm() {
        b_.use_object("black plastic", {0.05f, 0.05f, 0.055f});
        b_.add_surface(strips(90), strips(44), [](double u, double v) {
            const double flare = 1.0 + 0.8 * v * v * v * v;
            const DVec3 middle(-0.075 - 0.1 * v, -0.052 - 0.045 * std::sin(0.5 * kPi * v),
                               -0.045 - 0.012 * v);
            const double c = std::cos(angle_of(u)), s = std::sin(angle_of(u));
            return middle + DVec3(0.012 * s * (1.0 - v), 0.014 * flare * s, 0.03 * flare * c);
        });
    }

    /// On the door: a rounded triangle, its face flat, its edge a fillet.
    void add_foot() {
        const auto edge = [](double u) {
            const double angle = angle_of(u);
            const double r = 0.056 + 0.012 * std::cos(3.0 * angle);
            return DVec3(-0.178, -0.095 + r * std::sin(angle), -0.05 + 1.25 * r * std::cos(angle));
        };
        b_.use_object("black plastic", {});
        b_.add_surface(strips(150), strips(8), [&](double u, double v) {
            const DVec3 out = edge(u) - DVec3(-0.178, -0.095, -0.05);
            const double angle = 0.5 * kPi * v;
            return edge(u) - out * (0.09 * (1.0 - std::cos(angle))) + DVec3(0.006 * std::sin(angle), 0, 0);
        });
        b_.add_surface(strips(150), 1, [&](double u, double v) {
            const DVec3 middle(-0.172, -0.095, -0.05);
            const DVec3 out = edge(u) - DVec3(-0.178, -0.095, -0.05);
            return middle + (1.0 - v) * 0.91 * out;
        });
    }

    /// Screw bosses inside, seen beside the glass.
    void add_bosses() {
        b_.use_object("inner shell", {});
        constexpr ProfilePoint kBoss[] = {{0.009, 0.0},   {0.007, 0.004}, {0.006, 0.022}, {0.0055, 0.026},
                                          {0.003, 0.026}, {0.003, 0.012}, {0.0, 0.012}};
        for (int i = 0; i < 6; ++i) {
            const double angle = kPi * (i + 0.5) / 3.0;
            b_.add_turned({0.06 * std::cos(angle), 0.035 * std::sin(angle), -0.06}, {0, 0, 1}, kBoss,
                          strips(40));
        }
    }

    MeshBuilder b_;
    double detail_;
};

void make_mirror(double detail, Scene& scene) {
    CarMirror(scene.mesh, detail).build();
    scene.camera = Camera{.eye = {0.30f, 0.15f, 0.33f}, .target = {-0.03f, -0.025f, -0.045f}, .fov = 38.0f};
}

}  // namespace

void make_mirror_low(const SceneOptions&, Scene& scene, Task&) { make_mirror(1.0, scene); }
void make_mirror_high(const SceneOptions&, Scene& scene, Task&) { make_mirror(1.98, scene); }

}  // namespace boxwood
