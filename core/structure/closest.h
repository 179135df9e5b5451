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

    Decision decide(const Triangle& triangle) const {
        switch (edges_.decide(triangle)) {
            case EdgeFilter<FilterBounds>::Answer::Miss:
                return Decision::Miss;
            case EdgeFilter<FilterBounds>::Answer::Hit:
                return Decision::Hit;
            case EdgeFilter<FilterBounds>::Answer::Unknown:
                break;
        }
        return decide_exactly(triangle) ? Decision::ExactHit : Decision::Miss;
    }
    bool decide_exactly(const Triangle& triangle) const;
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
