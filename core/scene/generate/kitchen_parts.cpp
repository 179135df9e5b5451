#include "core/scene/generate/kitchen_parts.h"

#include <algorithm>
#include <cmath>

namespace boxwood::kitchen {

void use_enamel(MeshBuilder& b) { b.use_object("enamel", {0.46f, 0.58f, 0.52f}); }
void use_steel(MeshBuilder& b) { b.use_object("steel", {0.55f, 0.57f, 0.60f}); }
void use_oak(MeshBuilder& b) { b.use_object("oak", {0.48f, 0.27f, 0.12f}); }
void use_china(MeshBuilder& b) { b.use_object("china", {0.86f, 0.85f, 0.80f}); }

Placement turned(const Placement& placement, const DVec3& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto image = [&](const DVec3& e) {
        const DVec3 r = c * e + s * glm::cross(axis, e) + (1.0 - c) * glm::dot(axis, e) * axis;
        return r.x * placement.x_axis + r.y * placement.y_axis + r.z * placement.z_axis;
    };
    return {placement.origin, image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1})};
}

void add_rounded_box(MeshBuilder& b, const DVec3& lower, const DVec3& upper, double radius, int steps) {
    // Each face is a face of a cube blown up to a sphere, pulled apart in the middle.
    const int columns = 2 * steps + 1;
    const DVec3 inner_lower = lower + radius, inner_upper = upper - radius;
    const auto cube = [&](int i) {  // -1 to 1, 0 twice
        return i <= steps ? -1.0 + static_cast<double>(i) / steps
                          : static_cast<double>(i - 1 - steps) / steps;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            b.add_surface(columns, columns, [&](double u, double v) {
                const int i = static_cast<int>(std::lround(u * columns)),
                          k = static_cast<int>(std::lround(v * columns));
                DVec3 direction, corner;
                const int a = (axis + 1) % 3, c = (axis + 2) % 3;
                direction[axis] = side;
                direction[a] = std::tan(0.25 * kPi * cube(i));
                direction[c] = std::tan(0.25 * kPi * cube(k));
                corner[axis] = side < 0.0 ? inner_lower[axis] : inner_upper[axis];
                corner[a] = i <= steps ? inner_lower[a] : inner_upper[a];
                corner[c] = k <= steps ? inner_lower[c] : inner_upper[c];
                return corner + radius * glm::normalize(direction);
            });
        }
    }
}

void add_pipe(MeshBuilder& b, const std::function<DVec3(double u)>& path, const DVec3& normal, double radius,
              int along, int around) {
    constexpr double kStep = 1e-4;
    b.add_surface(along, around, [&](double u, double v) {
        const DVec3 tangent = glm::normalize(path(u + kStep) - path(u - kStep));
        const DVec3 side = glm::cross(tangent, normal);
        const double angle = v < 1.0 ? 2.0 * kPi * v : 0.0;
        return path(u) + radius * (std::cos(angle) * side + std::sin(angle) * normal);
    });
}

std::vector<ProfilePoint> smooth(std::span<const ProfilePoint> points, int steps) {
    std::vector<ProfilePoint> curve;
    const size_t last = points.size() - 1;
    for (size_t i = 0; i < last; ++i) {
        const ProfilePoint &p = points[i == 0 ? 0 : i - 1], &q = points[i], &r = points[i + 1],
                           &s = points[std::min(i + 2, last)];
        for (int step = 0; step < steps; ++step) {
            const double t = static_cast<double>(step) / steps;
            const auto at = [&](double a, double x, double y, double z) {
                return x + 0.5 * t *
                               (y - a + t * (2.0 * a - 5.0 * x + 4.0 * y - z + t * (3.0 * (x - y) + z - a)));
            };
            curve.push_back({std::max(0.0, at(p.radius, q.radius, r.radius, s.radius)),
                             at(p.height, q.height, r.height, s.height)});
        }
    }
    curve.push_back(points[last]);
    return curve;
}

void add_front(MeshBuilder& b, double width, double height) {
    constexpr double kThick = 0.022;
    // Inset from the edge, and height over the back: bevel, frame, ogee, raised panel.
    constexpr double kProfile[][2] = {{0.0, 0.0},      {0.0, 0.017},   {0.002, 0.020}, {0.005, kThick},
                                      {0.055, kThick}, {0.058, 0.020}, {0.060, 0.016}, {0.063, 0.012},
                                      {0.068, 0.010},  {0.080, 0.010}, {0.086, 0.011}, {0.094, 0.014},
                                      {0.104, 0.018},  {0.108, 0.019}};
    const auto corner = [&](size_t k, size_t i) {
        const double inset = kProfile[k][0], z = kProfile[k][1];
        return DVec3(i == 0 || i == 3 ? inset : width - inset, i < 2 ? inset : height - inset, z);
    };
    constexpr size_t kLast = std::size(kProfile) - 1;
    for (size_t k = 0; k < kLast; ++k)
        for (size_t i = 0; i < 4; ++i)
            b.add_quad(corner(k, i), corner(k, (i + 1) % 4), corner(k + 1, (i + 1) % 4), corner(k + 1, i));
    b.add_quad(corner(kLast, 0), corner(kLast, 1), corner(kLast, 2), corner(kLast, 3));
    b.add_quad(corner(0, 3), corner(0, 2), corner(0, 1), corner(0, 0));
}

void add_knob(MeshBuilder& b, const DVec3& at) {
    constexpr ProfilePoint kProfile[] = {{0.012, 0.0},   {0.007, 0.006}, {0.006, 0.014}, {0.014, 0.022},
                                         {0.016, 0.028}, {0.011, 0.033}, {0.0, 0.035}};
    b.add_turned(at, {0, 0, 1}, smooth(kProfile, 2), 12);
}

void add_plate(MeshBuilder& b, const DVec3& at, const DVec3& axis, double radius) {
    const double r = radius;
    const ProfilePoint profile[] = {{0.0, 0.002},      {0.55 * r, 0.002}, {0.60 * r, 0.0},
                                    {0.68 * r, 0.006}, {r, 0.020},        {0.99 * r, 0.024},
                                    {0.66 * r, 0.011}, {0.55 * r, 0.007}, {0.0, 0.006}};
    b.add_turned(at, axis, profile, 28);
}

void add_cup(MeshBuilder& b, const DVec3& at, double handle_angle) {
    constexpr ProfilePoint kProfile[] = {{0.0, 0.004},   {0.022, 0.004}, {0.026, 0.0},   {0.030, 0.006},
                                         {0.038, 0.04},  {0.041, 0.088}, {0.039, 0.090}, {0.036, 0.05},
                                         {0.024, 0.010}, {0.0, 0.008}};
    b.add_turned(at, {0, 1, 0}, kProfile, 16);
    const DVec3 out(std::cos(handle_angle), 0.0, std::sin(handle_angle));
    add_pipe(
        b,
        [&](double u) {
            const double angle = kPi * (0.5 - u);
            return at + DVec3(0, 0.05, 0) + (0.036 + 0.026 * std::cos(angle)) * out +
                   DVec3(0, 0.028 * std::sin(angle), 0);
        },
        {-out.z, 0.0, out.x}, 0.005, 8, 5);
}

void add_bowl(MeshBuilder& b, const DVec3& at, double radius) {
    const double r = radius;
    const ProfilePoint profile[] = {
        {0.0, 0.01},  {0.42 * r, 0.01},     {0.45 * r, 0.0},      {0.48 * r, 0.012}, {0.78 * r, 0.2 * r},
        {r, 0.5 * r}, {0.97 * r, 0.51 * r}, {0.74 * r, 0.24 * r}, {0.4 * r, 0.025},  {0.0, 0.02}};
    b.add_turned(at, {0, 1, 0}, smooth(profile, 2), 28);
}

void add_bottle(MeshBuilder& b, const DVec3& at) {
    constexpr ProfilePoint kProfile[] = {{0.0, 0.012},   {0.03, 0.004},  {0.036, 0.004}, {0.038, 0.02},
                                         {0.038, 0.18},  {0.034, 0.205}, {0.016, 0.235}, {0.014, 0.29},
                                         {0.017, 0.295}, {0.016, 0.31},  {0.0, 0.312}};
    b.add_turned(at, {0, 1, 0}, smooth(kProfile, 2), 18);
}

void add_jar(MeshBuilder& b, const DVec3& at, double height) {
    const double h = height, r = 0.045;
    const ProfilePoint profile[] = {{0.0, 0.002},         {0.9 * r, 0.002},    {r, 0.012},
                                    {r, 0.75 * h},        {0.8 * r, 0.84 * h}, {0.86 * r, 0.86 * h},
                                    {0.88 * r, 0.97 * h}, {0.8 * r, h},        {0.0, h}};
    b.add_turned(at, {0, 1, 0}, smooth(profile, 2), 14);
}

void add_pot(MeshBuilder& b, const DVec3& at, double radius, double height) {
    const double r = radius, h = height;
    const ProfilePoint body[] = {{0.0, 0.0},    {0.9 * r, 0.0}, {r, 0.015},          {r, 0.5 * h},
                                 {r, 0.97 * h}, {1.04 * r, h},  {0.97 * r, 0.96 * h}};
    b.add_turned(at, {0, 1, 0}, smooth(body, 2), 28);
    const ProfilePoint lid[] = {{1.02 * r, h},        {0.9 * r, h + 0.012}, {0.5 * r, h + 0.03},
                                {0.1 * r, h + 0.036}, {0.07 * r, h + 0.05}, {0.16 * r, h + 0.062},
                                {0.1 * r, h + 0.074}, {0.0, h + 0.076}};
    b.add_turned(at, {0, 1, 0}, smooth(lid, 2), 28);
    for (const double side : {-1.0, 1.0}) {
        add_pipe(
            b,
            [&](double u) {
                const double angle = kPi * (u - 0.5);
                return at +
                       DVec3(side * (r - 0.004 + 0.035 * std::cos(angle)), 0.75 * h, 0.05 * std::sin(angle));
            },
            {0, 1, 0}, 0.007, 10, 6);
    }
}

void add_kettle(MeshBuilder& b, const DVec3& at) {
    constexpr ProfilePoint kBody[] = {{0.0, 0.0},     {0.085, 0.0},  {0.1, 0.02},    {0.1, 0.06},
                                      {0.075, 0.13},  {0.045, 0.15}, {0.044, 0.155}, {0.02, 0.165},
                                      {0.012, 0.175}, {0.017, 0.19}, {0.0, 0.198}};
    b.add_turned(at, {0, 1, 0}, smooth(kBody, 2), 28);
    add_pipe(
        b, [&](double u) { return at + DVec3(0.085 + 0.075 * u, 0.06 + 0.08 * u * u + 0.015 * u, 0.0); },
        {0, 0, 1}, 0.013, 12, 12);
    add_pipe(
        b,
        [&](double u) {
            const double angle = kPi * (0.02 + 0.96 * u);
            return at + DVec3(-0.075 * std::cos(angle), 0.125 + 0.12 * std::sin(angle), 0.0);
        },
        {0, 0, 1}, 0.008, 16, 7);
}

void add_apple(MeshBuilder& b, const DVec3& at, double radius) {
    std::vector<ProfilePoint> profile;
    constexpr int kSteps = 10;
    for (int i = 0; i <= kSteps; ++i) {  // a cardioid, drawn out
        const double angle = kPi * i / kSteps;
        const bool is_pole = i == 0 || i == kSteps;
        const double r = radius * (0.92 + 0.12 * std::sin(angle));
        const double dent = 0.28 * radius * std::pow(std::abs(std::cos(angle)), 12.0);
        profile.push_back({is_pole ? 0.0 : r * std::sin(angle),
                           radius - (r - dent) * std::cos(angle) * (i < kSteps / 2 ? 0.9 : 1.0)});
    }
    b.add_turned(at, {0, 1, 0}, profile, 12);
}

}  // namespace boxwood::kitchen
