#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/box.h"
#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/scene/mesh.h"
#include "core/structure/filter.h"

namespace boxwood {

/// Whether a ray can hit anything: finite origin, finite direction that is not zero, 0 <= t_min <= t_max.
bool is_valid(const Ray& ray);

/// Tells a search that takes long for one ray to end early: its answer is then thrown away unread.
class StoppableSearch {
public:
    void watch(const Task& task) { task_ = &task; }
    bool stopped() const { return task_ != nullptr && task_->stopped(); }

private:
    const Task* task_ = nullptr;
};

/// The search for the nearest hit of one ray: box tests, triangle tests and the best hit so far.
template <Mode mode>
class ClosestHit;

/// Exact: hit or miss, and the order of hits, are those of exact arithmetic on the input floats; ties go to
/// the lower primitive. The reported t is the exact one, rounded once to nearest.
template <>
class ClosestHit<Mode::Exact> : public StoppableSearch {
public:
    explicit ClosestHit(const Ray& ray);

    /// To be called once before the first box test, with the box of all primitives.
    void enter_scene(const Vec3&, const Vec3&) {}
    /// What a structure whose regions are no boxes decides by; its own bounds stand there.
    const Ray& ray() const { return ray_; }
    const RaySlabs& slabs() const { return slabs_; }
    /// Every region counts as larger by so much along each axis.
    double margin() const { return 0.0; }
    bool is_negative(int axis) const { return slabs_.is_negative(axis); }
    bool meets(const Vec3& lower, const Vec3& upper, double& entry) const {
        return slabs_.meets(lower, upper, limit_, entry);
    }
    /// Whether a box with this entry can hold a hit that is as near as the best one.
    bool is_open(double entry) const { return entry <= limit_; }
    /// Upper bound of the entries that are open.
    double limit() const { return limit_; }

    /// Tests a triangle and keeps it if it is hit in range, and nearer than the best one or as near with a
    /// lower index.
    template <class Counter>
    void test(const Triangle& triangle, uint32_t prim, Counter& count) {
        count.test_primitive();
        if (is_on_triangle(triangle, count) && !keep_if_nearer(triangle, prim)) count.decide_exactly();
    }
    /// Whether the triangle is hit in range; leaves the best hit as it is.
    template <class Counter>
    bool occludes(const Triangle& triangle, Counter& count) const {
        count.test_primitive();
        return is_on_triangle(triangle, count) && is_in_range(triangle);
    }
    Hit hit(const Mesh& mesh) const;

private:
    /// Whether the ray's line hits the triangle.
    template <class Counter>
    bool is_on_triangle(const Triangle& triangle, Counter& count) const {
        const EdgeFilter<FilterBounds>::Functions functions = edges_.functions(triangle);
        switch (edges_.decide(functions)) {
            case EdgeFilter<FilterBounds>::Answer::Miss:
                return false;
            case EdgeFilter<FilterBounds>::Answer::Hit:
                return true;
            case EdgeFilter<FilterBounds>::Answer::Unknown:
                break;
        }
        count.decide_exactly();
        return decide_exactly(triangle, functions);
    }
    bool decide_exactly(const Triangle& triangle, const EdgeFilter<FilterBounds>::Functions& functions) const;
    bool is_in_range(const Triangle& triangle) const;
    /// False if it took exact arithmetic.
    bool keep_if_nearer(const Triangle& triangle, uint32_t prim);

    Ray ray_;
    RaySlabs slabs_;
    EdgeFilter<FilterBounds> edges_;
    double limit_;              // no hit beyond it counts: upper bound of the best t, padded
    double t_lower_, t_upper_;  // of the best hit
    Triangle best_{};
    uint32_t prim_ = kNoIndex;
};

/// Fast: float arithmetic for the shear, whose results are multiplied and summed in double, where products of
/// two floats are exact. So what is hit is the triangle of the rounded vertices; wrong answers occur only
/// where a ray passes within rounding of an edge or two hits are within rounding of each other.
template <>
class ClosestHit<Mode::Fast> : public StoppableSearch {
public:
    explicit ClosestHit(const Ray& ray);

    /// A hit that is reported may miss the triangle by kMargin times the distance of its farthest vertex, so
    /// that much is added to every box, and brute force and every structure see the same hits.
    ///
    /// u = 2^-24, R the largest distance along an axis of the origin to a corner of the scene's box. A hit is
    /// a convex combination of the rounded x = a_x - s a_z that is 0 (likewise y); q is the same combination
    /// of the triangle's true vertices, p the ray's point at the reported t. Difference a_x, slope, product
    /// and last difference of x round by at most uR + uR / 2 + uR + 2uR (|s| <= 1, and |s| = 1 is exact), a_z
    /// is the one that t is made of, and t is rounded to float by uR: p and q are at most 5.5 uR apart in x
    /// and y, 2 uR in z. Every set of boxes that contains the triangle has one with q, which the ray meets,
    /// when widened, at t. The roundings in double are of order 2^-29 of that, underflow in x is below
    /// 2^-148.
    static constexpr double kMargin = 5.5 * 0x1p-24 * (1.0 + 0x1p-20);
    void enter_scene(const Vec3& lower, const Vec3& upper) {
        const DVec3 origin(ray_.origin);
        const DVec3 reach = glm::max(glm::abs(DVec3(lower) - origin), glm::abs(DVec3(upper) - origin));
        margin_ = kMargin * std::max({reach.x, reach.y, reach.z}) + 0x1p-148;
        slabs_.widen(margin_);
    }
    const Ray& ray() const { return ray_; }
    const RaySlabs& slabs() const { return slabs_; }
    double margin() const { return margin_; }
    bool is_negative(int axis) const { return slabs_.is_negative(axis); }
    bool meets(const Vec3& lower, const Vec3& upper, double& entry) const {
        return slabs_.meets(lower, upper, limit_, entry);
    }
    bool is_open(double entry) const { return entry <= limit_; }
    /// Upper bound of the entries that are open.
    double limit() const { return limit_; }

    template <class Counter>
    void test(const Triangle& triangle, uint32_t prim, Counter& count) {
        count.test_primitive();
        const float t = intersect(triangle);
        if (t >= ray_.t_min && t <= ray_.t_max && (t < hit_.t || (t == hit_.t && prim < hit_.prim))) {
            hit_ = {t, prim};
            limit_ = static_cast<double>(t) * kPad;
        }
    }
    template <class Counter>
    bool occludes(const Triangle& triangle, Counter& count) const {
        count.test_primitive();
        const float t = intersect(triangle);
        return t >= ray_.t_min && t <= ray_.t_max;
    }
    /// t is that of the triangle's plane in double, no farther than the triangle: the search's own t, which
    /// decides what is nearest, carries the shear's roundings.
    Hit hit(const Mesh& mesh) const;
    /// t of the best hit as the search compares it; infinity for none.
    float searched_t() const { return hit_.t; }

private:
    /// t of the hit; NaN for a miss.
    float intersect(const Triangle& triangle) const {
        const Vec3 a = triangle.a - ray_.origin, b = triangle.b - ray_.origin, c = triangle.c - ray_.origin;
        const float ax = a[kx_] - shear_x_ * a[kz_], ay = a[ky_] - shear_y_ * a[kz_];
        const float bx = b[kx_] - shear_x_ * b[kz_], by = b[ky_] - shear_y_ * b[kz_];
        const float cx = c[kx_] - shear_x_ * c[kz_], cy = c[ky_] - shear_y_ * c[kz_];
        const double u = product(cx, by) - product(cy, bx), v = product(ax, cy) - product(ay, cx),
                     w = product(bx, ay) - product(by, ax);
        if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) {
            return std::numeric_limits<float>::quiet_NaN();
        }
        // A zero sum divides to NaN or infinity, which no range test passes but an infinite t_max: NaN then.
        const double sum = (u + v + w) * double(ray_.direction[kz_]);
        if (sum == 0.0) return std::numeric_limits<float>::quiet_NaN();
        return static_cast<float>((u * double(a[kz_]) + v * double(b[kz_]) + w * double(c[kz_])) / sum);
    }
    /// Exact.
    static double product(float a, float b) { return double(a) * double(b); }

    static constexpr double kPad =
        1.0 + 0x1p-48;  ///< the widened box is met at t but for roundings in double

    Ray ray_;
    RaySlabs slabs_;
    int kx_, ky_, kz_;
    float shear_x_, shear_y_;
    double margin_ = 0.0;  ///< see enter_scene
    double limit_;
    Hit hit_;
};

}  // namespace boxwood
