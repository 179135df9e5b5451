#include "core/scene/generate/mesh_builder.h"

#include <cmath>

#include "core/base/assert.h"

namespace boxwood {
namespace {

/// Two directions perpendicular to `axis` and to each other.
void perpendicular(const DVec3& axis, DVec3& x, DVec3& y) {
    const DVec3 helper = std::abs(axis.y) < 0.9 * glm::length(axis) ? DVec3(0, 1, 0) : DVec3(1, 0, 0);
    x = glm::normalize(glm::cross(helper, axis));
    y = glm::normalize(glm::cross(axis, x));
}

}  // namespace

void MeshBuilder::use_object(const std::string& name, const Vec3& base_color) {
    for (object_ = 0; object_ < mesh_.objects.size(); ++object_)
        if (mesh_.objects[object_].name == name) return;
    mesh_.objects.push_back({name, base_color});
}

uint32_t MeshBuilder::add_vertex(const DVec3& local) {
    mesh_.positions.push_back(Vec3(placement_(local)));
    return static_cast<uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::add_indexed(uint32_t a, uint32_t b, uint32_t c) {
    BOXWOOD_ASSERT(object_ < mesh_.objects.size());
    const Vec3 &p = mesh_.positions[a], &q = mesh_.positions[b], &r = mesh_.positions[c];
    if (p == q || q == r || r == p) return;
    mesh_.triangles.push_back(UVec3(a, b, c));
    mesh_.object.push_back(object_);
}

void MeshBuilder::add_triangle(const DVec3& a, const DVec3& b, const DVec3& c) {
    const uint32_t first = add_vertex(a);
    add_vertex(b);
    add_vertex(c);
    add_indexed(first, first + 1, first + 2);
}

void MeshBuilder::add_quad(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& d) {
    const uint32_t first = add_vertex(a);
    add_vertex(b);
    add_vertex(c);
    add_vertex(d);
    add_indexed(first, first + 1, first + 2);
    add_indexed(first, first + 2, first + 3);
}

void MeshBuilder::add_box(const DVec3& lower, const DVec3& upper) {
    const DVec3 size = upper - lower;
    add_beam({lower.x, lower.y + 0.5 * size.y, lower.z + 0.5 * size.z},
             {upper.x, lower.y + 0.5 * size.y, lower.z + 0.5 * size.z}, size.z, size.y);
}

void MeshBuilder::add_beam(const DVec3& from, const DVec3& to, double width, double height, const DVec3& up) {
    const DVec3 along = glm::normalize(to - from);
    const DVec3 side = 0.5 * width * glm::normalize(glm::cross(along, up));
    const DVec3 top = 0.5 * height * glm::normalize(glm::cross(side, along));
    const uint32_t v = add_vertex(from - side - top);
    add_vertex(from + side - top);
    add_vertex(from + side + top);
    add_vertex(from - side + top);
    add_vertex(to - side - top);
    add_vertex(to + side - top);
    add_vertex(to + side + top);
    add_vertex(to - side + top);
    constexpr uint32_t kFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (const auto& face : kFaces) {
        add_indexed(v + face[0], v + face[1], v + face[2]);
        add_indexed(v + face[0], v + face[2], v + face[3]);
    }
}

void MeshBuilder::add_surface(int columns, int rows, const std::function<DVec3(double u, double v)>& point) {
    const auto first = static_cast<uint32_t>(mesh_.positions.size());
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            add_vertex(point(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    const auto stride = static_cast<uint32_t>(columns) + 1;
    for (uint32_t j = 0; j < static_cast<uint32_t>(rows); ++j) {
        for (uint32_t i = 0; i + 1 < stride; ++i) {
            const uint32_t v = first + j * stride + i;
            add_indexed(v, v + 1, v + stride + 1);
            add_indexed(v, v + stride + 1, v + stride);
        }
    }
}

void MeshBuilder::add_turned(const DVec3& base, const DVec3& axis, std::span<const ProfilePoint> profile,
                             int segments) {
    const DVec3 up = glm::normalize(axis);
    DVec3 x, y;
    perpendicular(up, x, y);
    const auto first = static_cast<uint32_t>(mesh_.positions.size());
    for (const ProfilePoint& p : profile) {
        for (int i = 0; i < segments; ++i) {
            const double angle = 2.0 * kPi * i / segments;
            add_vertex(base + up * p.height + p.radius * (std::cos(angle) * x + std::sin(angle) * y));
        }
    }
    const auto ring = static_cast<uint32_t>(segments);
    for (uint32_t j = 0; j + 1 < profile.size(); ++j) {
        for (uint32_t i = 0; i < ring; ++i) {
            const uint32_t a = first + j * ring + i, b = first + j * ring + (i + 1) % ring;
            add_indexed(a, b, b + ring);
            add_indexed(a, b + ring, a + ring);
        }
    }
}

void MeshBuilder::add_tube(const DVec3& from, const DVec3& to, double r0, double r1, int segments,
                           bool caps) {
    const double length = glm::length(to - from);
    const ProfilePoint profile[] = {{0.0, 0.0}, {r0, 0.0}, {r1, length}, {0.0, length}};
    add_turned(from, to - from, caps ? std::span(profile) : std::span(profile).subspan(1, 2), segments);
}

void MeshBuilder::add_sphere(const DVec3& center, double radius, int segments, int rings) {
    std::vector<ProfilePoint> profile;
    for (int i = 0; i <= rings; ++i) {
        const double angle = kPi * i / rings;
        const bool pole = i == 0 || i == rings;
        profile.push_back({pole ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle)});
    }
    add_turned(center, {0.0, 1.0, 0.0}, profile, segments);
}

void MeshBuilder::add_prism(std::span<const glm::dvec2> polygon, double z0, double z1) {
    const auto n = static_cast<uint32_t>(polygon.size());
    const auto first = static_cast<uint32_t>(mesh_.positions.size());
    for (const double z : {z0, z1})
        for (const glm::dvec2& p : polygon) add_vertex({p.x, p.y, z});
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = first + i, b = first + (i + 1) % n;
        add_indexed(a, b, b + n);
        add_indexed(a, b + n, a + n);
    }
    for (uint32_t i = 1; i + 1 < n; ++i) {
        add_indexed(first, first + i + 1, first + i);
        add_indexed(first + n, first + n + i, first + n + i + 1);
    }
}

void MeshBuilder::add_moulding(std::span<const glm::dvec2> profile, double x0, double x1) {
    const auto first = static_cast<uint32_t>(mesh_.positions.size());
    for (const glm::dvec2& p : profile) {
        add_vertex({x0, p.x, p.y});
        add_vertex({x1, p.x, p.y});
    }
    for (uint32_t i = 0; i + 1 < profile.size(); ++i) {
        const uint32_t v = first + 2 * i;
        add_indexed(v, v + 1, v + 3);
        add_indexed(v, v + 3, v + 2);
    }
}

}  // namespace boxwood
