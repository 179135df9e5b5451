#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/box.h"
#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Whether a ray can hit anything: finite origin, finite direction that is not zero, 0 <= t_min <= t_max.
bool is_valid(const Ray& ray);

/// A ray prepared for box tests, in double: differences and products of floats neither overflow nor underflow
/// there, and 1/d is infinite only for d = 0.
class RaySlabs {
public:
    explicit RaySlabs(const Ray& ray)
        : near_origin_(ray.origin),
          far_origin_(ray.origin),
          inverse_(1.0 / DVec3(ray.direction)),
          padded_inverse_(inverse_ * kPad),
          t_min_(static_cast<double>(ray.t_min)) {
        for (int axis = 0; axis < 3; ++axis) negative_[axis] = std::signbit(ray.direction[axis]) ? 1 : 0;
    }

    bool is_negative(int axis) const { return negative_[axis] != 0; }

    /// From here on every box counts as larger by `margin` on each side.
    void widen(double margin) {
        for (int axis = 0; axis < 3; ++axis) {
            near_origin_[axis] += is_negative(axis) ? -margin : margin;
            far_origin_[axis] -= is_negative(axis) ? -margin : margin;
        }
    }

    /// Whether the ray may meet the closed box at a parameter of at most `limit`; then `entry` is a lower
    /// bound of the parameters inside the box, but for a factor of at most 1 + 2 gamma_3.
    ///
    /// With u = 2^-53, a computed plane parameter (plane - o) * inverse carries three roundings: the
    /// difference, the inverse, the product; so it is exact * (1 + e) with |e| <= gamma_3 = 3u / (1 - 3u).
    /// Far planes are multiplied by kPad = 1 + 8u >= (1 + 2 gamma_3)(1 + u), so that near <= far holds
    /// whenever it does exactly: all parameters that count are >= 0, since t_min is. Ize, "Robust BVH Ray
    /// Traversal", JCGT 2(2), 2013, section 3. A NaN (origin on the plane of a face that the ray is parallel
    /// to) keeps the other bound: the ray is inside.
    bool meets(const Vec3& lower, const Vec3& upper, double limit, double& entry) const {
        const Vec3* const planes[2] = {&lower, &upper};
        double t0 = t_min_, t1 = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const double near_plane = static_cast<double>((*planes[negative_[axis]])[axis]);
            const double far_plane = static_cast<double>((*planes[1 - negative_[axis]])[axis]);
            const double near = (near_plane - near_origin_[axis]) * inverse_[axis];
            const double far = (far_plane - far_origin_[axis]) * padded_inverse_[axis];
            t0 = near > t0 ? near : t0;
            t1 = far < t1 ? far : t1;
        }
        entry = t0;
        return t0 <= t1;
    }

    static constexpr double kPad = 1.0 + 8.0 * 0x1p-53;

private:
    DVec3 near_origin_, far_origin_;
    DVec3 inverse_, padded_inverse_;
    double t_min_;
    uint32_t negative_[3];  ///< 1 where the direction's sign bit is set
};

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
    bool is_negative(int axis) const { return slabs_.is_negative(axis); }
    bool meets(const Vec3& lower, const Vec3& upper, double& entry) const {
        return slabs_.meets(lower, upper, limit_, entry);
    }
    /// Whether a box with this entry can hold a hit that is as near as the best one.
    bool is_open(double entry) const { return entry <= limit_; }

    /// Tests a triangle and keeps it if it is hit in range, and nearer than the best one or as near with a
    /// lower index.
    template <class Counter>
    void test(const Triangle& triangle, uint32_t prim, Counter& count) {
        count.test_primitive();
        if (const Decision decision = decide(triangle); decision != Decision::Miss) {
            if (decision == Decision::ExactHit) count.decide_exactly();
            if (!keep_if_nearer(triangle, prim)) count.decide_exactly();
        }
    }
    /// Whether the triangle is hit in range; leaves the best hit as it is.
    template <class Counter>
    bool occludes(const Triangle& triangle, Counter& count) const {
        count.test_primitive();
        return decide(triangle) != Decision::Miss && is_in_range(triangle);
    }
    Hit hit(const Mesh& mesh) const;

private:
    enum class Decision { Miss, Hit, ExactHit };

    /// Filter of the exact test. Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1),
    /// 2013, in double: vertices relative to the origin are sheared so that the ray is the z axis; U, V, W
    /// are the edge functions, whose signs decide.
    ///
    /// Bound, u = 2^-53, with m = max|x|,|y| of the sheared vertices + max|z|: a difference a - o is off by
    /// u|a - o|, the slope s = d_x/d_z by u|s|, |s| <= 1, so x = a_x - s a_z is off by at most u|a_x| +
    /// 3u|a_z| + u|x| + O(u^2), where |a_x| <= |x| + |a_z|: at most u (2|x| + 4|a_z|) <= 4u m. A product of
    /// two such numbers is then off by at most 2 m 4u m + u m^2, the difference of two by 18u m^2 + 2u m^2,
    /// in all 20u m^2 + O(u^2) < 2.3e-15 m^2; computed m^2 is off by a few u. kEdgeBound = 3e-15 covers all.
    Decision decide(const Triangle& triangle) const {
        const DVec3 a = DVec3(triangle.a) - origin_, b = DVec3(triangle.b) - origin_,
                    c = DVec3(triangle.c) - origin_;
        const double ax = a[kx_] - shear_x_ * a[kz_], ay = a[ky_] - shear_y_ * a[kz_];
        const double bx = b[kx_] - shear_x_ * b[kz_], by = b[ky_] - shear_y_ * b[kz_];
        const double cx = c[kx_] - shear_x_ * c[kz_], cy = c[ky_] - shear_y_ * c[kz_];
        const double m =
            std::max({std::abs(ax), std::abs(ay), std::abs(bx), std::abs(by), std::abs(cx), std::abs(cy)}) +
            std::max({std::abs(a[kz_]), std::abs(b[kz_]), std::abs(c[kz_])});
        const double bound = kEdgeBound * m * m;
        const double u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        const double least = std::min({u, v, w}), greatest = std::max({u, v, w});
        if (least < -bound && greatest > bound) return Decision::Miss;
        if (least > bound || greatest < -bound) return Decision::Hit;
        return decide_exactly(triangle) ? Decision::ExactHit : Decision::Miss;
    }
    bool decide_exactly(const Triangle& triangle) const;
    bool is_in_range(const Triangle& triangle) const;
    /// False if it took exact arithmetic.
    bool keep_if_nearer(const Triangle& triangle, uint32_t prim);

    static constexpr double kEdgeBound = 3e-15;

    Ray ray_;
    RaySlabs slabs_;
    DVec3 origin_;
    int kx_, ky_, kz_;
    double shear_x_, shear_y_;
    double limit_;              // no hit beyond it counts: upper bound of the best t, padded
    double t_lower_, t_upper_;  // of the best hit
    Triangle best_{};
    uint32_t prim_ = kNoIndex;
};

/// Fast: float arithmetic. The same shear and edge functions with the sum's sign for the zero cases; t has a
/// relative error of some units of 2^-24. Wrong answers occur only where a ray passes within rounding of an
/// edge or two hits are within rounding of each other.
template <>
class ClosestHit<Mode::Fast> : public StoppableSearch {
public:
    explicit ClosestHit(const Ray& ray);

    /// The float test may report a hit that misses the triangle by kMargin times the distance of its far
    /// vertices, so that much is added to every box, and brute force and every structure see the same hits.
    void enter_scene(const Vec3& lower, const Vec3& upper) {
        const DVec3 origin(ray_.origin);
        const DVec3 reach = glm::max(glm::abs(DVec3(lower) - origin), glm::abs(DVec3(upper) - origin));
        slabs_.widen(kMargin * std::max({reach.x, reach.y, reach.z}));
    }
    bool is_negative(int axis) const { return slabs_.is_negative(axis); }
    bool meets(const Vec3& lower, const Vec3& upper, double& entry) const {
        return slabs_.meets(lower, upper, limit_, entry);
    }
    bool is_open(double entry) const { return entry <= limit_; }

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
    Hit hit(const Mesh&) const { return hit_; }

private:
    /// t of the hit; NaN for a miss.
    float intersect(const Triangle& triangle) const {
        const Vec3 a = triangle.a - ray_.origin, b = triangle.b - ray_.origin, c = triangle.c - ray_.origin;
        const float ax = a[kx_] - shear_x_ * a[kz_], ay = a[ky_] - shear_y_ * a[kz_];
        const float bx = b[kx_] - shear_x_ * b[kz_], by = b[ky_] - shear_y_ * b[kz_];
        const float cx = c[kx_] - shear_x_ * c[kz_], cy = c[ky_] - shear_y_ * c[kz_];
        const float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) {
            return std::numeric_limits<float>::quiet_NaN();
        }
        // A zero sum divides to NaN or infinity, which no range test passes but an infinite t_max: NaN then.
        const float sum = u + v + w;
        if (sum == 0.0f) return std::numeric_limits<float>::quiet_NaN();
        return (u * a[kz_] + v * b[kz_] + w * c[kz_]) * inverse_z_ / sum;
    }

    static constexpr double kPad = 1.0 + 0x1p-20;  ///< 16 units of 2^-24: covers the error of t
    /// 64 units of 2^-24: by the derivation above an edge function is off by 20 u X m, X the largest |x|,
    /// |y|, which is a distance of 20 u m X / |edge| from the edge, where X <= 3 |edge| for a ray that passes
    /// so close.
    static constexpr double kMargin = 0x1p-18;

    Ray ray_;
    RaySlabs slabs_;
    int kx_, ky_, kz_;
    float shear_x_, shear_y_, inverse_z_;
    double limit_;
    Hit hit_;
};

}  // namespace boxwood
